//! Blocks: eight particles, twenty-eight springs and twelve faces (section 4.2.5).

use std::ops::Range;

use glam::DVec3;

use super::particle::State;

/// Number of particles of a block.
pub const CORNERS: usize = 8;
/// Number of springs of a block: every pair of its particles.
pub const SPRINGS: usize = 28;
/// Number of springs of a block that are edges; they come first among its springs.
pub const EDGES: usize = 12;
/// Number of faces of a block: two triangles a side.
pub const FACES: usize = 12;

/// Corners at the ends of each edge. Bits 0, 1 and 2 of a corner's number are its sides along x, y
/// and z.
pub const EDGE_CORNERS: [[usize; 2]; EDGES] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Corners at the ends of each spring: the edges, then all other pairs in ascending order.
pub const SPRING_CORNERS: [[usize; 2]; SPRINGS] = {
    let mut springs = [[0; 2]; SPRINGS];
    let mut count = 0;
    while count < EDGES {
        springs[count] = EDGE_CORNERS[count];
        count += 1;
    }
    let mut a = 0;
    while a < CORNERS {
        let mut b = a + 1;
        while b < CORNERS {
            if (a ^ b).count_ones() > 1 {
                springs[count] = [a, b];
                count += 1;
            }
            b += 1;
        }
        a += 1;
    }
    springs
};

/// Corners of each side, clockwise as seen from outside: -x, +x, -y, +y, -z, +z.
const SIDES: [[usize; 4]; 6] = [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];

/// Corners of each face. A side a, b, c, d becomes a, b, c and c, d, a, whose first two sides are
/// edges (Figure 4.6).
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

/// Block: indices of its first parts in the lists of the model, where they are contiguous.
///
/// ```
/// use teeter_dissertation::jenga3d::block::{Block, CORNERS};
///
/// let block = Block { particles: 8, springs: 28, faces: 12, active: true };
/// assert_eq!(block.corners().len(), CORNERS);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Index of the first of its [`CORNERS`] particles.
    pub particles: u32,
    /// Index of the first of its [`SPRINGS`] springs, edges before the others.
    pub springs: u32,
    /// Index of the first of its [`FACES`] faces.
    pub faces: u32,
    /// True unless the block is disabled, which fixes it (section 4.7).
    pub active: bool,
}

impl Block {
    /// Indices of its particles.
    pub fn corners(&self) -> Range<usize> {
        let first = self.particles as usize;
        first..first + CORNERS
    }

    /// Position of its centre, m: the mean of its corners.
    pub fn centre(&self, states: &[State]) -> DVec3 {
        states[self.corners()].iter().map(|s| s.position).sum::<DVec3>() / CORNERS as f64
    }

    /// Velocity of its centre, m/s.
    pub fn velocity(&self, states: &[State]) -> DVec3 {
        states[self.corners()].iter().map(|s| s.velocity).sum::<DVec3>() / CORNERS as f64
    }
}
