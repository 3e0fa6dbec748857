//! Position and orientation of a body, and how fast they change.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Numbers a body in [`crate::World::poses`]: position (3), orientation (x, y, z, w).
pub const POSE_STRIDE: usize = 7;

/// Position and orientation of a body.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_physics::Pose;
///
/// let pose = Pose { position: DVec3::new(0.0, 0.0, 0.009), orientation: DQuat::IDENTITY };
/// let corner = pose.transform_point(DVec3::new(0.04, 0.0, 0.009));
/// assert_eq!(corner, DVec3::new(0.04, 0.0, 0.018));
/// assert_eq!(pose.inverse_transform_point(corner), DVec3::new(0.04, 0.0, 0.009));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Centre, m.
    pub position: DVec3,
    /// Unit quaternion from the body's frame to the world.
    pub orientation: DQuat,
}

impl Pose {
    /// Reads a pose of [`POSE_STRIDE`] numbers, as [`crate::World::poses`] has them.
    ///
    /// # Panics
    /// When the slice is shorter.
    pub fn from_slice(numbers: &[f64]) -> Self {
        Self { position: DVec3::from_slice(numbers), orientation: DQuat::from_slice(&numbers[3..]) }
    }

    /// Returns the world position of a point of the body's frame, m.
    pub fn transform_point(&self, local: DVec3) -> DVec3 {
        self.position + self.orientation * local
    }

    /// Returns the position in the body's frame of a point of the world, m.
    pub fn inverse_transform_point(&self, world: DVec3) -> DVec3 {
        self.orientation.inverse() * (world - self.position)
    }
}

/// Velocity and spin of a body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::Twist;
///
/// let twist = Twist { spin: DVec3::Z * 2.0, ..Twist::ZERO };
/// assert_eq!(twist.velocity_at(DVec3::X), DVec3::Y * 2.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// Velocity of the centre, m/s.
    pub velocity: DVec3,
    /// Angular velocity in the world, rad/s.
    pub spin: DVec3,
}

impl Twist {
    /// A body at rest.
    pub const ZERO: Self = Self { velocity: DVec3::ZERO, spin: DVec3::ZERO };

    /// Pure translation, m/s.
    pub const fn linear(velocity: DVec3) -> Self {
        Self { velocity, spin: DVec3::ZERO }
    }

    /// Pure rotation about the centre, rad/s.
    pub const fn angular(spin: DVec3) -> Self {
        Self { velocity: DVec3::ZERO, spin }
    }

    /// Returns the velocity of a body's point at `arm` (m, world axes) from its centre, m/s.
    pub fn velocity_at(&self, arm: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(arm)
    }
}
