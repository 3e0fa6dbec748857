//! Springs between pairs of particles (sections 4.1.1 and 4.2.2).

use glam::DVec3;

use super::particle::State;

/// Damped spring between two particles.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::particle::State;
/// use teeter_dissertation::jenga3d::spring::Spring;
///
/// let spring = Spring { p1: 0, p2: 1, rest_length: 1.0, stiffness: 10.0, damping: 0.0, edge: true };
/// let (a, b) = (State::default(), State { position: 1.5 * DVec3::X, ..State::default() });
/// assert_eq!(spring.force(&a, &b), -5.0 * DVec3::X); // pulls b back
/// assert_eq!(spring.energy(&a, &b), 1.25);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Index of the first particle.
    pub p1: u32,
    /// Index of the second particle.
    pub p2: u32,
    /// Rest length, m.
    pub rest_length: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// True for the twelve edges of a block (section 4.2.3).
    pub edge: bool,
}

impl Spring {
    /// Force on `p2`, N; the force on `p1` is its opposite. A spring of length zero has no
    /// direction and no force.
    ///
    /// The stiffness has a minus here. With the printed signs of Eq. 4.1 and 4.2b a stretched
    /// spring would stretch further; the damping of Eq. 4.3a is right as printed.
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

    /// Length in the states of all particles, m.
    pub fn length(&self, states: &[State]) -> f64 {
        states[self.p1 as usize].position.distance(states[self.p2 as usize].position)
    }

    /// Potential energy, J.
    pub fn energy(&self, p1: &State, p2: &State) -> f64 {
        let elongation = p1.position.distance(p2.position) - self.rest_length;
        0.5 * self.stiffness * elongation * elongation
    }
}
