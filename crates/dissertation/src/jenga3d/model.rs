//! The lists that make up a scene of springs (section 4.2): what there is, as opposed to where it is.

use super::block::Block;
use super::face::Face;
use super::particle::{Particle, State};
use super::spring::Spring;

/// All particles, springs, faces and blocks, in order of creation.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Model {
    /// The particles.
    pub particles: Vec<Particle>,
    /// The springs.
    pub springs: Vec<Spring>,
    /// The faces.
    pub faces: Vec<Face>,
    /// The blocks.
    pub blocks: Vec<Block>,
}

impl Model {
    /// Energy of motion and of the springs, J.
    pub fn energy(&self, states: &[State]) -> f64 {
        let motion: f64 =
            self.particles.iter().zip(states).map(|(p, s)| 0.5 * p.mass * s.velocity.length_squared()).sum();
        let springs: f64 = self.springs.iter().map(|s| s.energy(&states[s.p1 as usize], &states[s.p2 as usize])).sum();
        motion + springs
    }
}
