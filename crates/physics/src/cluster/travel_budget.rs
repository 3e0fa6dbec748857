//! Budgets of travel and rotation that limit how far a body moves before its next sync.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::collision::cached_pair::{CachedPair, relative_speed};
use crate::collision::manifold::Manifold;
use crate::constants::{
    DEVIATION_SHARE, FREE_SYNC_ROTATION, GAP_ERROR, MIN_SYNC_ROTATION, MIN_TRAVEL_BUDGET, SPIN_SYNC_TIME, SYNC_ROTATION,
};

/// Speed below which a body counts as quiet, m/s.
const QUIET_SPEED: f64 = 1e-4;
/// Speed from which two bodies count as moving against each other, m/s.
const MIN_PAIR_SPEED: f64 = 1e-9;
/// Travel budget over the travel that the speed predicts.
const SPEED_ALLOWANCE: f64 = 1.25;
/// Travel budget over the travel that the acceleration predicts.
const ACCELERATION_ALLOWANCE: f64 = 1.5;

/// Speed that the points of each body may soon have, m/s: the largest of its own and those of its
/// neighbours up to the second. A body that is hit moves off with the speed of the one that hit it.
pub fn predict_speeds(shapes: &Shapes, bodies: &Bodies, manifolds: &[Manifold]) -> Vec<f64> {
    let mut speeds: Vec<f64> = (0..bodies.len()).map(|i| bodies.max_point_speed(shapes, i)).collect();
    for _ in 0..2 {
        let before = speeds.clone();
        for manifold in manifolds {
            if manifold.a == FLOOR {
                continue;
            }
            let (a, b) = (manifold.a as usize, manifold.b as usize);
            speeds[a] = speeds[a].max(before[b]);
            speeds[b] = speeds[b].max(before[a]);
        }
    }
    speeds
}

/// Returns true if a body with this speed (m/s) counts as quiet.
pub fn is_quiet(speed: f64) -> bool {
    speed < QUIET_SPEED
}

/// Travel budget of a body for `time` (s), m: the travel that `speed` (m/s) and acceleration
/// predict, within the remaining margin.
pub fn travel_budget(shapes: &Shapes, bodies: &Bodies, i: usize, speed: f64, time: f64) -> f64 {
    let expected = SPEED_ALLOWANCE * speed * time
        + ACCELERATION_ALLOWANCE * 0.5 * bodies.acceleration[i] * time * time
        + MIN_TRAVEL_BUDGET;
    expected.min(remaining_margin(shapes, bodies, i))
}

/// Budgets of the bodies of a pair, which keep its last test valid.
#[derive(Debug, Clone, Copy)]
pub struct PairBudgets {
    /// Time in which the pair, in uniform motion, uses up the travel that is left to it less the
    /// deviation of both, s.
    time: f64,
    /// Deviation of each body from uniform motion, m.
    pub deviation: f64,
}

impl PairBudgets {
    /// Budgets of a pair.
    pub fn new(shapes: &Shapes, bodies: &Bodies, cached: &CachedPair) -> Self {
        let left = cached.remaining(shapes, bodies).max(MIN_TRAVEL_BUDGET);
        let deviation = DEVIATION_SHARE * left;
        let speed = relative_speed(shapes, bodies, cached.pair).max(MIN_PAIR_SPEED);
        Self { time: (left - 2.0 * deviation) / speed, deviation: deviation.max(MIN_TRAVEL_BUDGET) }
    }

    /// Travel of a body of the pair with this speed (m/s), m.
    pub fn travel(&self, speed: f64) -> f64 {
        speed * self.time + self.deviation
    }
}

/// Travel until a body leaves its detection margin, m.
pub fn remaining_margin(shapes: &Shapes, bodies: &Bodies, i: usize) -> f64 {
    (bodies.margin[i] - bodies.travel_since(shapes, i, bodies.detection_pose[i])).max(MIN_TRAVEL_BUDGET)
}

/// Rotation budget of a body, rad. A fast spinning body has a larger one, for its contacts are
/// impacts, whose depth far exceeds the error of the gaps: r w sqrt(m / k) against r angle² / 2. A
/// small or stiff body has a smaller one for the same reason.
pub fn rotation_budget(shapes: &Shapes, bodies: &Bodies, i: usize, has_contacts: bool) -> f64 {
    if has_contacts {
        let spin = bodies.spin[i].length();
        let shallow = (2.0 * GAP_ERROR * spin * (shapes.mass[i] / shapes.spring.stiffness).sqrt()).sqrt();
        (spin * SPIN_SYNC_TIME).clamp(SYNC_ROTATION, FREE_SYNC_ROTATION).min(shallow.max(MIN_SYNC_ROTATION))
    } else {
        FREE_SYNC_ROTATION
    }
}
