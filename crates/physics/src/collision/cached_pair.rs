//! Pairs that are near each other, as they were at their last test.
//!
//! A test holds until the two bodies have moved against each other by more than its limit. What
//! counts is how far one has moved as seen from the other: blocks that fall or topple together
//! hardly move so, however fast they are.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR, Shapes, rotation_between};
use crate::collision::manifold::key;
use crate::collision::pair_status::PairStatus;
use crate::constants::{MARGIN_SHARE, MARGIN_TIME, MIN_REACH_SHARE, REACH_RANGE};

/// Pair that is near, as it was at its last test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CachedPair {
    /// Lower and higher body; the floor counts as lowest.
    pub pair: [u32; 2],
    /// Separation up to which the test gave a manifold, m.
    pub reach: f64,
    /// Travel against each other for which the test holds, m.
    pub limit: f64,
    /// Centre (m) and orientation of the higher body in the frame of the lower one at the test.
    pub pose: (DVec3, DQuat),
}

impl CachedPair {
    /// Pair that has just been tested with a reach (m); none where it is apart.
    pub fn new(bodies: &Bodies, pair: [u32; 2], reach: f64, status: PairStatus) -> Option<Self> {
        let limit = match status {
            PairStatus::Apart => return None,
            PairStatus::Near(travel) => travel,
            PairStatus::Touching(travel) => travel.min(reach),
        };
        Some(Self { pair, reach, limit, pose: relative_pose(bodies, pair) })
    }

    /// Key of the pair, by which pairs are sorted.
    pub fn key(&self) -> (u32, u32) {
        key(self.pair[0], self.pair[1])
    }

    /// Travel that is left until the pair is tested again, m.
    pub fn remaining(&self, shapes: &Shapes, bodies: &Bodies) -> f64 {
        self.limit - self.travel(shapes, bodies)
    }

    /// Returns true if the pair is to be tested again: it has moved, or its reach would now be much
    /// larger or smaller.
    pub fn is_due(&self, shapes: &Shapes, bodies: &Bodies) -> bool {
        let now = reach(shapes, bodies, self.pair);
        self.travel(shapes, bodies) > MARGIN_SHARE * self.limit
            || self.reach < MIN_REACH_SHARE * now
            || MIN_REACH_SHARE * self.reach > now
    }

    /// Upper bound of the travel of the higher body's points as seen from the lower one since the
    /// last test, m.
    fn travel(&self, shapes: &Shapes, bodies: &Bodies) -> f64 {
        let (center, orientation) = relative_pose(bodies, self.pair);
        (center - self.pose.0).length()
            + rotation_between(self.pose.1, orientation).length() * shapes.radius[self.pair[1] as usize]
    }
}

/// Separation up to which two bodies get a manifold, m: what they travel against each other in
/// [`MARGIN_TIME`].
pub fn reach(shapes: &Shapes, bodies: &Bodies, pair: [u32; 2]) -> f64 {
    (relative_speed(shapes, bodies, pair) * MARGIN_TIME).clamp(REACH_RANGE.0, REACH_RANGE.1)
}

/// Upper bound of the speed of the second body's points as seen from the first, which may be the
/// floor, m/s.
pub fn relative_speed(shapes: &Shapes, bodies: &Bodies, pair: [u32; 2]) -> f64 {
    let [a, b] = pair.map(|i| i as usize);
    if pair[0] == FLOOR {
        return bodies.max_point_speed(shapes, b);
    }
    let offset = bodies.position[b] - bodies.position[a];
    let velocity = bodies.velocity[b] - bodies.velocity[a] - bodies.spin[a].cross(offset);
    velocity.length() + (bodies.spin[b] - bodies.spin[a]).length() * shapes.radius[b]
}

/// Centre (m) and orientation of the higher body of a pair in the frame of the lower one.
fn relative_pose(bodies: &Bodies, pair: [u32; 2]) -> (DVec3, DQuat) {
    let [low, high] = pair.map(|i| i as usize);
    if pair[0] == FLOOR {
        return (bodies.position[high], bodies.orientation[high]);
    }
    let inverse = bodies.orientation[low].conjugate();
    (inverse * (bodies.position[high] - bodies.position[low]), inverse * bodies.orientation[high])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::rotated;
    use teeter_scene::{TowerOptions, tower};

    fn two_blocks() -> (Shapes, Bodies) {
        let scene = tower(&TowerOptions { rows: 1, ..TowerOptions::default() }).unwrap();
        (Shapes::new(&scene), Bodies::new(&scene))
    }

    fn cached(bodies: &Bodies, limit: f64) -> CachedPair {
        CachedPair::new(bodies, [0, 1], REACH_RANGE.0, PairStatus::Touching(limit)).unwrap()
    }

    #[test]
    fn bodies_that_move_as_one_do_not_move_against_each_other() {
        let (shapes, mut bodies) = two_blocks();
        let pair = cached(&bodies, 1e-5);
        let (turn, pivot, shift) = (DVec3::new(0.3, -0.2, 0.9), DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, -2.0, 3.0));
        let rotation = rotated(DQuat::IDENTITY, turn);
        let (velocity, spin) = (DVec3::new(3.0, 1.0, -2.0), DVec3::new(5.0, -4.0, 3.0));
        for i in 0..2 {
            bodies.position[i] = pivot + rotation * (bodies.position[i] - pivot) + shift;
            bodies.orientation[i] = rotation * bodies.orientation[i];
            bodies.velocity[i] = velocity + spin.cross(bodies.position[i] - pivot);
            bodies.spin[i] = spin;
        }
        assert!((pair.remaining(&shapes, &bodies) - pair.limit).abs() < 1e-12);
        assert!(relative_speed(&shapes, &bodies, [0, 1]) < 1e-12);
        assert!(!pair.is_due(&shapes, &bodies));
    }

    #[test]
    fn a_pair_is_due_after_its_share_of_the_limit_and_where_its_reach_would_change() {
        let (shapes, mut bodies) = two_blocks();
        let pair = cached(&bodies, 1e-5);
        let start = bodies.position[1];
        for (share, is_due) in [(0.69, false), (0.71, true)] {
            bodies.position[1] = start + DVec3::X * (share * pair.limit);
            assert_eq!(pair.is_due(&shapes, &bodies), is_due, "{share}");
        }
        bodies.position[1] = start;
        let speed = REACH_RANGE.0 / MARGIN_TIME;
        for (factor, is_due) in [(1.9, false), (2.1, true)] {
            bodies.velocity[0].x = factor * speed;
            assert_eq!(pair.is_due(&shapes, &bodies), is_due, "{factor}");
        }
        let fast = CachedPair { reach: REACH_RANGE.1, ..pair };
        bodies.velocity[0].x = 0.0;
        assert!(fast.is_due(&shapes, &bodies), "a reach far beyond what rest needs");
    }

    #[test]
    fn a_turn_counts_at_the_corners() {
        let (shapes, mut bodies) = two_blocks();
        let pair = cached(&bodies, 1.0);
        bodies.orientation[1] = rotated(bodies.orientation[1], DVec3::new(0.0, 0.0, 1e-4));
        let travel = pair.limit - pair.remaining(&shapes, &bodies);
        assert!((travel - 1e-4 * shapes.radius[1]).abs() < 1e-10, "{travel}");
    }
}
