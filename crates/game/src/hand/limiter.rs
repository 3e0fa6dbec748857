//! Limited target of the hand between the grasped point and the goal that the player has set.
//!
//! A hand that jumped would throw blocks. The target moves at a limited speed and stays near the
//! grasped point, so the force of the hand's spring builds up while a block sticks and the target
//! does not run away from it.

use glam::{DQuat, DVec3, DVec4};
use serde::{Deserialize, Serialize};

use crate::orientation::angle_between;

/// Largest rate of the orientation, rad/s.
const MAX_SPIN: f64 = 3.0;

/// Goal of the hand and limits of its target.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::{LimitedGoal, TargetLimiter};
///
/// // the target stays within its lead of the grasped point
/// let mut limiter = TargetLimiter::new(DVec3::ZERO, DQuat::IDENTITY);
/// let (position, orientation) = (DVec3::X, None);
/// let goal = LimitedGoal { position, orientation, max_speed: 10.0, max_lead: 0.03 };
/// limiter.advance(&goal, DVec3::ZERO, false, 0.02);
/// assert!((limiter.position().x - 0.03).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedGoal {
    /// Position wanted for the grasped point, m.
    pub position: DVec3,
    /// Orientation wanted for the block; none leaves it free.
    pub orientation: Option<DQuat>,
    /// Largest speed of the target, m/s.
    pub max_speed: f64,
    /// Largest distance of the target ahead of the grasped point, m.
    pub max_lead: f64,
}

/// Target of the hand's spring.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::{LimitedGoal, TargetLimiter};
///
/// let mut limiter = TargetLimiter::new(DVec3::ZERO, DQuat::IDENTITY);
/// let (position, orientation) = (DVec3::X, None);
/// let goal = LimitedGoal { position, orientation, max_speed: 0.5, max_lead: 0.03 };
/// limiter.advance(&goal, DVec3::ZERO, false, 0.02);
/// assert!((limiter.position().x - 0.01).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TargetLimiter {
    position: DVec3,
    orientation: DQuat,
}

impl TargetLimiter {
    /// A target at the grasped point, with the block's own orientation.
    pub fn new(position: DVec3, orientation: DQuat) -> Self {
        Self { position, orientation }
    }

    /// Advances by `dt` (s) towards a goal. `point` is the grasped point (m); `is_saturated` is
    /// true when the hand gives all its force.
    pub fn advance(&mut self, goal: &LimitedGoal, point: DVec3, is_saturated: bool, dt: f64) {
        let lead = self.position.distance(point);
        let displacement = goal.position - self.position;
        let travel = goal.max_speed * dt;
        self.position += if displacement.length() > travel { with_length(displacement, travel) } else { displacement };
        // A lead beyond that of the full force would only throw the block when it comes loose.
        let max_lead = if is_saturated { goal.max_lead.min(lead) } else { goal.max_lead };
        let ahead = self.position - point;
        if ahead.length() > max_lead {
            self.position = point + with_length(ahead, max_lead);
        }
        if let Some(orientation) = goal.orientation {
            self.orientation = rotated_towards(self.orientation, orientation, MAX_SPIN * dt);
        }
    }

    /// Position of the target, m.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Orientation of the target.
    pub fn orientation(&self) -> DQuat {
        self.orientation
    }
}

fn with_length(vector: DVec3, length: f64) -> DVec3 {
    vector * (length / vector.length())
}

/// Rotates `from` towards `to` by at most `limit` (rad), in the shorter direction.
fn rotated_towards(from: DQuat, to: DQuat, limit: f64) -> DQuat {
    let near = if from.dot(to) < 0.0 { -to } else { to };
    let angle = angle_between(from, near);
    if angle <= limit {
        return near;
    }
    let (a, b) = (libm::sin(0.5 * angle - 0.5 * limit), libm::sin(0.5 * limit));
    let mixed: DVec4 = a * DVec4::from(from) + b * DVec4::from(near);
    DQuat::from_vec4(mixed / mixed.length())
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 60.0;
    const GOAL: LimitedGoal = LimitedGoal { position: DVec3::X, orientation: None, max_speed: 0.25, max_lead: 0.012 };

    fn at_origin() -> TargetLimiter {
        TargetLimiter::new(DVec3::ZERO, DQuat::IDENTITY)
    }

    #[test]
    fn the_target_moves_at_its_speed_and_no_faster_and_arrives_exactly() {
        let mut limiter = at_origin();
        let goal = LimitedGoal { position: DVec3::X * 0.01, max_lead: 1.0, ..GOAL };
        limiter.advance(&goal, DVec3::ZERO, false, DT);
        assert!((limiter.position().x - 0.25 * DT).abs() < 5e-13);
        for _ in 0..10 {
            limiter.advance(&goal, DVec3::ZERO, false, DT);
        }
        assert_eq!(limiter.position(), goal.position);
    }

    #[test]
    fn the_target_stays_near_a_point_that_sticks() {
        let mut limiter = at_origin();
        for _ in 0..60 {
            limiter.advance(&GOAL, DVec3::ZERO, false, DT);
        }
        assert!((limiter.position().x - 0.012).abs() < 5e-10);
    }

    #[test]
    fn the_target_gains_no_lead_while_the_force_is_spent_and_follows_when_the_point_comes_loose() {
        let mut limiter = at_origin();
        limiter.advance(&GOAL, DVec3::ZERO, false, DT);
        let lead = limiter.position().x;
        for _ in 0..10 {
            limiter.advance(&GOAL, DVec3::ZERO, true, DT);
        }
        assert!((limiter.position().x - lead).abs() < 5e-13);
        limiter.advance(&GOAL, DVec3::X * 0.02, true, DT);
        assert!(limiter.position().x - 0.02 <= lead + 1e-12);
    }

    #[test]
    fn a_rotation_takes_the_shorter_direction_by_the_limit_and_ends_at_its_goal() {
        let rotation = |axis: DVec3, angle: f64| {
            let (sin, cos) = libm::sincos(0.5 * angle);
            DQuat::from_vec4((axis.normalize() * sin).extend(cos))
        };
        let from = rotation(DVec3::new(1.0, 2.0, 3.0), 0.7);
        let to = rotation(DVec3::new(-1.0, 0.5, 2.0), 2.1);
        let whole = angle_between(from, to);
        for limit in [0.05, 0.3, 5.0] {
            for goal in [to, -to] {
                let turned = rotated_towards(from, goal, limit);
                assert!((angle_between(from, turned) - limit.min(whole)).abs() < 1e-6);
                // Both parts add up to the whole.
                assert!((angle_between(turned, to) - (whole - limit.min(whole))).abs() < 1e-6);
            }
        }
    }
}
