//! Blocks: eight particles, twenty-eight springs and twelve faces (section 4.2.5).

use glam::DVec3;
use teeter_scene::Block as SceneBlock;

use super::constants::Constants;
use super::face::Face;
use super::model::Model;
use super::particle::{Particle, State};
use super::spring::Spring;

/// Particles of a block.
pub const CORNERS: usize = 8;
/// Springs of a block: every pair of its particles.
pub const SPRINGS: usize = 28;
/// Springs of a block that are edges; they come first among its springs.
pub const EDGES: usize = 12;
/// Faces of a block: two triangles a side.
pub const FACES: usize = 12;

/// Corners of a block at the ends of each edge. Bit 0, 1 and 2 of a corner's number say on which side it is along x, y and z.
pub const EDGE_CORNERS: [[usize; 2]; EDGES] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// The four corners of each side, clockwise as seen from outside: -x, +x, -y, +y, -z, +z.
const SIDES: [[usize; 4]; 6] = [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];

/// Corners of each face: a side a, b, c, d becomes a, b, c and c, d, a, of which the first two sides are edges (Figure 4.6).
pub const FACE_CORNERS: [[usize; 3]; FACES] = {
    let mut faces = [[0; 3]; FACES];
    let mut side = 0;
    while side < 6 {
        let [a, b, c, d] = SIDES[side];
        faces[2 * side] = [a, b, c];
        faces[2 * side + 1] = [c, d, a];
        side += 1;
    }
    faces
};

/// A block: where its parts begin in the lists of the model, in which they lie one after the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// First of its [`CORNERS`] particles.
    pub particles: u32,
    /// First of its [`SPRINGS`] springs, the edges before the others.
    pub springs: u32,
    /// First of its [`FACES`] faces.
    pub faces: u32,
    /// Whether it takes part; a disabled block is a fixed one (section 4.7).
    pub active: bool,
}

impl Block {
    /// Indices of its particles.
    pub fn corners(&self) -> std::ops::Range<usize> {
        let first = self.particles as usize;
        first..first + CORNERS
    }

    /// Its centre, m: the mean of its corners.
    pub fn centre(&self, states: &[State]) -> DVec3 {
        states[self.corners()].iter().map(|s| s.position).sum::<DVec3>() / CORNERS as f64
    }

    /// Velocity of its centre, m/s.
    pub fn velocity(&self, states: &[State]) -> DVec3 {
        states[self.corners()].iter().map(|s| s.velocity).sum::<DVec3>() / CORNERS as f64
    }
}

/// Adds a block to the lists, at rest, raised by `lift` (m): `CreateBlock` of section 4.2.5.
///
/// Each particle has an eighth of the mass, which puts the radius of gyration at half the edge where a uniform block has it at 0.29 of
/// the edge: the method's blocks are harder to turn than real ones, three times so about every axis.
pub fn create_block(model: &mut Model, curr: &mut Vec<State>, block: &SceneBlock, lift: f64, constants: &Constants) {
    let (first_particle, first_spring, first_face) = (model.particles.len(), model.springs.len(), model.faces.len());
    let index = model.blocks.len() as u32;
    let (sin, cos) = (libm::sin(block.yaw), libm::cos(block.yaw));
    let centre = DVec3::from(block.pos) + lift * DVec3::Z;
    for corner in 0..CORNERS {
        let side = |axis: usize| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 } * block.size[axis];
        let (x, y, z) = (side(0), side(1), side(2));
        let position = centre + DVec3::new(cos * x - sin * y, sin * x + cos * y, z);
        model.particles.push(Particle { mass: block.mass / CORNERS as f64, block: index });
        curr.push(State { position, ..State::default() });
    }
    let mut pairs: Vec<[usize; 2]> = EDGE_CORNERS.to_vec();
    let others =
        (0..CORNERS).flat_map(|a| (a + 1..CORNERS).map(move |b| [a, b])).filter(|pair| !EDGE_CORNERS.contains(pair));
    pairs.extend(others);
    for (n, [a, b]) in pairs.into_iter().enumerate() {
        let (p1, p2) = (first_particle + a, first_particle + b);
        model.springs.push(Spring {
            p1: p1 as u32,
            p2: p2 as u32,
            rest_length: curr[p1].position.distance(curr[p2].position),
            stiffness: constants.stiffness,
            damping: constants.damping,
            edge: n < EDGES,
        });
    }
    for corners in FACE_CORNERS {
        let [p1, p2, p3] = corners.map(|c| (first_particle + c) as u32);
        model.faces.push(Face { p1, p2, p3 });
    }
    model.blocks.push(Block {
        particles: first_particle as u32,
        springs: first_spring as u32,
        faces: first_face as u32,
        active: true,
    });
}
