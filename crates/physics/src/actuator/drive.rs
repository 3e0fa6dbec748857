//! Drive: controls the velocity of a body with limited force.

use glam::{DMat3, DVec3};

use crate::actuator::limits;
use crate::actuator::work::Work;
use crate::body::{Bodies, BodyForce, Shapes};
use crate::input::Drive;

/// Response time of a drive, substeps.
const RESPONSE_SUBSTEPS: f64 = 20.0;

/// Controller of a drive between two syncs.
#[derive(Debug, Clone)]
pub struct DriveController {
    body: usize,
    velocity: DVec3,
    mass: f64,
    inertia: DMat3,
    max_force: f64,
    max_torque: f64,
    /// Work on the body.
    pub work: Work,
}

impl DriveController {
    /// Controller for the bodies of a cluster.
    pub fn new(drive: &Drive, shapes: &Shapes, bodies: &Bodies) -> Self {
        let i = drive.body.index();
        let max_force = drive.max_force.min(limits::max_force(shapes, i));
        Self {
            body: i,
            velocity: drive.velocity,
            mass: shapes.mass[i],
            inertia: bodies.inertia(shapes, i),
            max_force,
            max_torque: (max_force * shapes.radius[i]).min(limits::max_torque(shapes, i)),
            work: Work::default(),
        }
    }

    /// Index in the cluster of the driven body.
    pub fn body(&self) -> usize {
        self.body
    }

    /// Force in a substep of `h` (s) on the body with velocity `v` (m/s) and spin `w` (rad/s).
    pub fn force(&mut self, h: f64, (v, w): (DVec3, DVec3)) -> BodyForce {
        let rate = 1.0 / (RESPONSE_SUBSTEPS * h);
        let force = (self.mass * rate * (self.velocity - v)).clamp_length_max(self.max_force);
        let torque = (self.inertia * w * -rate).clamp_length_max(self.max_torque);
        let force = BodyForce { force, arm: DVec3::ZERO, torque };
        self.work.add(h, force, (v, w));
        force
    }
}
