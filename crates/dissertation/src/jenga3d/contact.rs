//! A contact between two blocks, or a block and the floor (sections 4.5 and 4.6, appendix 2.6).

use glam::DVec3;

use super::particle::{Particle, State};

/// What touches what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A particle and the floor.
    ParticleFloor,
    /// A particle and a face: their indices.
    ParticleFace(u32, u32),
    /// Two edges: the indices of their springs.
    EdgeEdge(u32, u32),
}

/// A contact of up to four particles. Those of the side that the normal points to have positive weights, whose sum is 1; those of the other
/// side negative ones, whose sum is -1, or none for the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// What touches.
    pub kind: Kind,
    /// The blocks, that which the normal points to first; [`FLOOR`] for the floor.
    pub blocks: [u32; 2],
    /// Indices of the particles.
    pub particles: [u32; 4],
    /// Their weights; the unused ones are zero (Eq. 4.14a, 4.16).
    pub weights: [f64; 4],
    /// Unit normal.
    pub normal: DVec3,
    /// Force along the normal, N: the impulse over the time of the step that it came from.
    pub normal_force: f64,
}

/// In place of a block: the floor.
pub const FLOOR: u32 = u32::MAX;

impl Contact {
    /// The particles with their weights.
    #[inline]
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.particles.iter().zip(self.weights).filter(|(_, w)| *w != 0.0).map(|(&p, w)| (p as usize, w))
    }

    /// Weighted sum of something of the particles: with velocities, that of the one side relative to the other (Eq. 2.8, 4.14a).
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

    /// Inverse of the mass that the contact point presents to an impulse, 1/kg: an impulse moves each particle by its weight over its mass,
    /// and the point by the weighted sum of that. Particles of fixed blocks count as infinitely heavy.
    #[inline]
    pub fn inverse_mass(&self, particles: &[Particle], moves: impl Fn(u32) -> bool) -> f64 {
        self.parts().filter(|(p, _)| moves(particles[*p].block)).map(|(p, w)| w * w / particles[p].mass).sum()
    }

    /// Relative velocity, m/s.
    pub fn velocity(&self, states: &[State]) -> DVec3 {
        self.relative(|p| states[p].velocity)
    }
}
