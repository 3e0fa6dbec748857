//! Particles: the only thing that has mass and moves (section 4.2.1).
//!
//! The current and the next states of all particles lie in two lists, because integrators take whole lists of states (section 4.3.2):
//! particle `i` owns entry `i` of each.

use glam::DVec3;

/// What of a particle changes with time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct State {
    /// Position, m.
    pub position: DVec3,
    /// Velocity, m/s.
    pub velocity: DVec3,
    /// Sum of the forces on it, N.
    pub force: DVec3,
}

/// States of all particles at one time, in the order of the particles.
pub type StateList = Vec<State>;

/// A point with mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Mass, kg.
    pub mass: f64,
    /// Index of the block that it is a corner of.
    pub block: u32,
}
