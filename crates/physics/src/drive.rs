//! A drive: gives a body a velocity, with limited force.

use glam::{DMat3, DVec3};

use crate::body::{Bodies, Shapes};
use crate::form::Push;
use crate::input::Drive;

/// Substeps in which a drive takes away all but 1/e of the difference in velocity.
const RESPONSE: f64 = 20.0;

/// A drive between two syncs.
#[derive(Debug, Clone)]
pub struct Servo {
    row: usize,
    velocity: DVec3,
    mass: f64,
    inertia: DMat3,
    max_force: f64,
    max_torque: f64,
}

impl Servo {
    pub fn new(drive: &Drive, shapes: &Shapes, bodies: &Bodies) -> Self {
        let i = drive.body.index();
        Self {
            row: i,
            velocity: drive.velocity,
            mass: shapes.mass[i],
            inertia: bodies.inertia(shapes, i),
            max_force: drive.max_force,
            max_torque: drive.max_force * shapes.radius[i],
        }
    }

    /// Index of the body driven.
    pub fn body(&self) -> usize {
        self.row
    }

    /// What it does in a substep of `h` (s) to a body of this velocity and spin.
    pub fn force(&self, h: f64, (v, w): (DVec3, DVec3)) -> Push {
        let rate = 1.0 / (RESPONSE * h);
        let force = (self.mass * rate * (self.velocity - v)).clamp_length_max(self.max_force);
        let torque = (self.inertia * w * -rate).clamp_length_max(self.max_torque);
        Push { force, arm: DVec3::ZERO, torque }
    }
}
