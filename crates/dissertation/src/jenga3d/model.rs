//! Lists of a scene of springs (section 4.2): constant properties, as opposed to states.

use super::block::Block;
use super::face::Face;
use super::particle::{Particle, State};
use super::spring::Spring;

/// Particles, springs, faces and blocks, in order of creation.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let model = Jenga3D::new(&scene, Constants::default()).expect("a valid scene").model;
/// assert_eq!((model.particles.len(), model.springs.len(), model.faces.len()), (8, 28, 12));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Model {
    /// Particles.
    pub particles: Vec<Particle>,
    /// Springs.
    pub springs: Vec<Spring>,
    /// Faces.
    pub faces: Vec<Face>,
    /// Blocks.
    pub blocks: Vec<Block>,
}

impl Model {
    /// Kinetic energy plus energy of the springs, J.
    pub fn energy(&self, states: &[State]) -> f64 {
        let motion: f64 =
            self.particles.iter().zip(states).map(|(p, s)| 0.5 * p.mass * s.velocity.length_squared()).sum();
        let springs: f64 = self.springs.iter().map(|s| s.energy(&states[s.p1 as usize], &states[s.p2 as usize])).sum();
        motion + springs
    }
}
