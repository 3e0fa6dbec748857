//! Particles, which alone have mass and move (section 4.2.1).
//!
//! Integrators take whole lists of states (section 4.3.2), so the current and the next states of
//! all particles are two lists; particle `i` owns entry `i` of each.

use glam::DVec3;

/// State of a particle.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::particle::State;
///
/// let state = State { position: DVec3::Z, ..State::default() };
/// assert_eq!(state.velocity, DVec3::ZERO);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct State {
    /// Position, m.
    pub position: DVec3,
    /// Velocity, m/s.
    pub velocity: DVec3,
    /// Sum of the forces, N.
    pub force: DVec3,
}

/// States of all particles at one time, in the order of the particles.
pub type StateList = Vec<State>;

/// Point mass.
///
/// ```
/// use teeter_dissertation::jenga3d::particle::Particle;
///
/// let particle = Particle { mass: 0.0196 / 8.0, block: 0 };
/// assert_eq!(8.0 * particle.mass, 0.0196);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Mass, kg.
    pub mass: f64,
    /// Index of its block.
    pub block: u32,
}
