//! How long the next batch of substeps may be and how far each body may get in it.

use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::constants::{FREE_SYNC_TURN, LEAST_BOUND, QUIET_SYNC_TIME, SPIN_SYNC_TIME, SYNC_TIME, SYNC_TURN};
use crate::manifold::Manifold;

/// Speed below which a whole world counts as quiet, m/s.
const QUIET_SPEED: f64 = 1e-4;
/// By how much a body is granted more travel than its speed says.
const SPEED_ALLOWANCE: f64 = 1.25;
/// By how much a body is granted more travel than its acceleration says.
const ACCELERATION_ALLOWANCE: f64 = 1.5;

/// Fastest that a point of each body may be soon, m/s: its own speed or that of what it touches, to the second neighbour. A body
/// that is hit moves off with the speed of the one that hit it.
pub fn speeds(shapes: &Shapes, bodies: &Bodies, manifolds: &[Manifold]) -> Vec<f64> {
    let mut speeds: Vec<f64> = (0..bodies.len()).map(|i| bodies.point_speed(shapes, i)).collect();
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

/// Longest time to the next sync, s.
pub fn longest(speeds: &[f64], calm: bool) -> f64 {
    if calm && speeds.iter().all(|&s| s < QUIET_SPEED) { QUIET_SYNC_TIME } else { SYNC_TIME }
}

/// How far a point of each body may get in `time` (s): what its speed and acceleration suggest, and never out of its margin.
pub fn travel(shapes: &Shapes, bodies: &Bodies, speeds: &[f64], time: f64) -> Vec<f64> {
    (0..bodies.len())
        .map(|i| {
            let expected =
                SPEED_ALLOWANCE * speeds[i] * time + ACCELERATION_ALLOWANCE * 0.5 * bodies.acceleration[i] * time * time + LEAST_BOUND;
            let room = bodies.margin[i] - bodies.travel(shapes, i, bodies.detected[i]);
            expected.min(room.max(LEAST_BOUND))
        })
        .collect()
}

/// How far a body may turn before the gaps of its points must be measured again, rad: one that spins fast is granted more, for
/// its contacts are impacts and far deeper than the error of its gaps.
pub fn turn(bodies: &Bodies, i: usize, touching: bool) -> f64 {
    if touching { (bodies.spin[i].length() * SPIN_SYNC_TIME).clamp(SYNC_TURN, FREE_SYNC_TURN) } else { FREE_SYNC_TURN }
}

/// Weight of each body, N.
pub fn weights(shapes: &Shapes, gravity: DVec3) -> Vec<(DVec3, DVec3)> {
    shapes.mass.iter().map(|&m| (m * gravity, DVec3::ZERO)).collect()
}
