//! How far each body may get before its next sync.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::constants::{FREE_SYNC_TURN, LEAST_BOUND, SPIN_SYNC_TIME, SYNC_TURN};
use crate::manifold::Manifold;

/// Speed below which a body counts as quiet, m/s.
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

/// Whether nothing is going on at this speed, m/s.
pub fn quiet(speed: f64) -> bool {
    speed < QUIET_SPEED
}

/// How far a point of a body may get in `time` (s) when it is at `speed` (m/s) soon: what that and its acceleration suggest, and never
/// out of its margin.
pub fn travel(shapes: &Shapes, bodies: &Bodies, i: usize, speed: f64, time: f64) -> f64 {
    let expected = SPEED_ALLOWANCE * speed * time
        + ACCELERATION_ALLOWANCE * 0.5 * bodies.acceleration[i] * time * time
        + LEAST_BOUND;
    expected.min(room(shapes, bodies, i))
}

/// How far a point of a body may get before it is out of its margin, m.
pub fn room(shapes: &Shapes, bodies: &Bodies, i: usize) -> f64 {
    (bodies.margin[i] - bodies.travel(shapes, i, bodies.detected[i])).max(LEAST_BOUND)
}

/// How far a body may turn before the gaps of its points must be measured again, rad: one that spins fast is granted more, for
/// its contacts are impacts and far deeper than the error of its gaps.
pub fn turn(bodies: &Bodies, i: usize, touching: bool) -> f64 {
    if touching { (bodies.spin[i].length() * SPIN_SYNC_TIME).clamp(SYNC_TURN, FREE_SYNC_TURN) } else { FREE_SYNC_TURN }
}
