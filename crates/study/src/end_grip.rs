//! Grip of a hand on the end of a block.

use glam::{DQuat, DVec3};
use teeter_physics::{BodyId, Hand, Pose, World};

/// Hold on the middle of a block's end face, for a path along the block's own length.
///
/// A level pull would lift a block that leans with its tower against its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndGrip {
    body: BodyId,
    /// Grasped point in the block's frame, m.
    anchor: DVec3,
    /// Outward normal of the face, a unit vector of the world.
    pub axis: DVec3,
    /// Grasped point, m.
    pub point: DVec3,
    /// Edge length along the axis, m.
    pub length: f64,
    orientation: DQuat,
}

impl EndGrip {
    /// Grip on the face of `body` whose normal is nearest to `axis`.
    pub fn new(world: &World, body: BodyId, axis: DVec3) -> Self {
        let Pose { position, orientation } = world.pose(body);
        let end = end_normal(orientation.inverse() * axis);
        let length = world.size(body).dot(end.abs());
        let anchor = end * (0.5 * length);
        Self { body, anchor, axis: orientation * end, point: position + orientation * anchor, length, orientation }
    }

    /// Hand that slides the block and has not moved yet.
    pub fn hand(&self) -> Hand {
        Hand::slide(self.body, self.anchor, self.point, self.orientation)
    }
}

/// Normal of the face nearest to a direction of the block's frame.
fn end_normal(direction: DVec3) -> DVec3 {
    DVec3::from(std::array::from_fn::<f64, 3, _>(|k| {
        if direction[k].abs() == direction.abs().max_element() { direction[k].signum() } else { 0.0 }
    }))
}
