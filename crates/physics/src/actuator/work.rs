//! Work of hand and drives on the bodies.

use glam::DVec3;

use crate::body::BodyForce;

/// Work of a controller during a batch.
///
/// A force changes the velocity of a substep into that of the next, so its power is the mean of
/// those at both: otherwise the work would not be the change of the energy.
#[derive(Debug, Clone, Copy, Default)]
pub struct Work {
    /// Work so far, J.
    done: f64,
    /// Force in the last substep.
    last: BodyForce,
}

impl Work {
    /// Adds a substep of `h` (s) that begins with this twist (m/s, rad/s), in which `force` acts.
    pub fn add(&mut self, h: f64, force: BodyForce, twist: (DVec3, DVec3)) {
        self.done += 0.5 * h * (self.last.power(twist) + force.power(twist));
        self.last = force;
    }

    /// Returns the work (J) of the batch, after whose last substep of `h` (s) the body has this
    /// twist.
    pub fn at_end(&self, h: f64, twist: (DVec3, DVec3)) -> f64 {
        self.done + 0.5 * h * self.last.power(twist)
    }
}
