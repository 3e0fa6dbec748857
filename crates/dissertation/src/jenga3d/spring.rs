//! Springs: pairs of particles that want to be a certain distance apart (sections 4.1.1 and 4.2.2).

use glam::DVec3;

use super::particle::State;

/// A damped spring between two particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Index of one particle.
    pub p1: u32,
    /// Index of the other.
    pub p2: u32,
    /// Length without force, m.
    pub rest_length: f64,
    /// Force per stretch, N/m.
    pub stiffness: f64,
    /// Force per rate of stretch, N s/m.
    pub damping: f64,
    /// Whether it is one of the twelve edges of its block (section 4.2.3).
    pub edge: bool,
}

impl Spring {
    /// The force on `p2`, N; that on `p1` is its opposite. None for a spring of no length, which has no direction.
    ///
    /// The stiffness has a minus here: with the signs of Eq. 4.1 and 4.2b as printed, a stretched spring would stretch further, while the
    /// damping of Eq. 4.3a is right as it is.
    pub fn force(&self, p1: &State, p2: &State) -> DVec3 {
        let apart = p2.position - p1.position; // Eq. 4.3b
        let closing = p2.velocity - p1.velocity; // Eq. 4.3b
        let length = apart.length();
        if length == 0.0 {
            return DVec3::ZERO;
        }
        let pull = -self.stiffness * (length - self.rest_length); // Eq. 4.1
        let drag = -self.damping * closing.dot(apart) / length; // Eq. 4.3a
        apart * ((pull + drag) / length) // Eq. 4.2a
    }

    /// Its length among the states of all particles, m.
    pub fn length(&self, states: &[State]) -> f64 {
        states[self.p1 as usize].position.distance(states[self.p2 as usize].position)
    }

    /// Energy stored, J.
    pub fn energy(&self, p1: &State, p2: &State) -> f64 {
        let stretch = p1.position.distance(p2.position) - self.rest_length;
        0.5 * self.stiffness * stretch * stretch
    }
}
