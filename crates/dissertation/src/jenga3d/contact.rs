//! Contacts between two blocks, or a block and the floor (sections 4.5 and 4.6, appendix 2.6).

use glam::DVec3;

use super::particle::{Particle, State};

/// Kind of a contact.
///
/// ```
/// use teeter_dissertation::jenga3d::contact::Kind;
///
/// assert!(Kind::ParticleFloor < Kind::ParticleFace(0, 0)); // kinds sort
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Particle and floor.
    ParticleFloor,
    /// Particle and face, by index.
    ParticleFace(u32, u32),
    /// Two edges, by the indices of their springs.
    EdgeEdge(u32, u32),
}

/// Contact of up to four particles.
///
/// Particles on the side that the normal points to have positive weights of sum 1. Those on the
/// other side have negative weights of sum -1, or none for the floor.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::contact::{Contact, FLOOR, Kind};
/// use teeter_dissertation::jenga3d::particle::State;
///
/// let contact = Contact {
///     kind: Kind::ParticleFloor,
///     blocks: [0, FLOOR],
///     particles: [1, 0, 0, 0],
///     weights: [1.0, 0.0, 0.0, 0.0],
///     normal: DVec3::Z,
///     normal_force: 0.0,
/// };
/// let falling = State { velocity: -DVec3::Z, ..State::default() };
/// assert_eq!(contact.velocity(&[State::default(), falling]), -DVec3::Z);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Kind of the contact.
    pub kind: Kind,
    /// Indices of the blocks, first the one that the normal points to; [`FLOOR`] for the floor.
    pub blocks: [u32; 2],
    /// Indices of the particles.
    pub particles: [u32; 4],
    /// Weights of the particles, zero for unused entries (Eq. 4.14a, 4.16).
    pub weights: [f64; 4],
    /// Unit normal.
    pub normal: DVec3,
    /// Normal force, N: the impulse over the time of its step.
    pub normal_force: f64,
}

/// Index of the floor in the list of blocks of a contact.
pub const FLOOR: u32 = u32::MAX;

impl Contact {
    /// Returns the particles with their weights.
    #[inline]
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.particles.iter().zip(self.weights).filter(|(_, w)| *w != 0.0).map(|(&p, w)| (p as usize, w))
    }

    /// Weighted sum of a vector over the particles. For velocities this is the velocity of one side
    /// relative to the other (Eq. 2.8, 4.14a).
    #[inline]
    pub fn relative(&self, of: impl Fn(usize) -> DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for (p, w) in self.particles.iter().zip(self.weights) {
            if w != 0.0 {
                sum += w * of(*p as usize);
            }
        }
        sum
    }

    /// Inverse mass of the contact point, 1/kg.
    ///
    /// An impulse changes the velocity of each particle by its weight over its mass, and that of
    /// the point by the weighted sum. Particles of blocks for which `moves` is false have infinite
    /// mass.
    #[inline]
    pub fn inverse_mass(&self, particles: &[Particle], moves: impl Fn(u32) -> bool) -> f64 {
        self.parts().filter(|(p, _)| moves(particles[*p].block)).map(|(p, w)| w * w / particles[p].mass).sum()
    }

    /// Relative velocity, m/s.
    pub fn velocity(&self, states: &[State]) -> DVec3 {
        self.relative(|p| states[p].velocity)
    }
}
