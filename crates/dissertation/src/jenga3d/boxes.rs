//! Boxes of particles, edges, faces and blocks, updated as particles change (sections 4.4.3 and
//! 5.3). Those of edges and faces follow from those of the corners, which are all that a step
//! keeps.

use super::block::{CORNERS, EDGE_CORNERS, EDGES, FACE_CORNERS, FACES};
use super::bounds::Bounds;
use super::particle::State;

/// Masks of the corners of each face.
pub const CORNERS_OF_FACE: [u8; FACES] = {
    let mut of = [0; FACES];
    let mut face = 0;
    while face < FACES {
        let [a, b, c] = FACE_CORNERS[face];
        of[face] = 1 << a | 1 << b | 1 << c;
        face += 1;
    }
    of
};

/// Masks of the corners of each edge.
pub const CORNERS_OF_EDGE: [u8; EDGES] = {
    let mut of = [0; EDGES];
    let mut edge = 0;
    while edge < EDGES {
        let [a, b] = EDGE_CORNERS[edge];
        of[edge] = 1 << a | 1 << b;
        edge += 1;
    }
    of
};

/// Masks of the edges at each corner.
pub const EDGES_OF_CORNER: [u16; CORNERS] = {
    let mut of = [0; CORNERS];
    let mut edge = 0;
    while edge < EDGES {
        let [a, b] = EDGE_CORNERS[edge];
        of[a] |= 1 << edge;
        of[b] |= 1 << edge;
        edge += 1;
    }
    of
};

/// Boxes of the corners of one block.
pub type CornerBoxes = [Bounds; CORNERS];

/// Updates the boxes of some corners, a mask, to these current and next states.
pub fn update(boxes: &mut CornerBoxes, corners: u8, curr: &[State], next: &[State]) {
    for (n, corner) in boxes.iter_mut().enumerate().filter(|(n, _)| corners >> n & 1 == 1) {
        *corner = Bounds::of_path(curr[n].position, next[n].position);
    }
}

/// Returns the box of a face.
#[inline]
pub fn of_face(corners: &CornerBoxes, face: usize) -> Bounds {
    let [a, b, c] = FACE_CORNERS[face];
    corners[a].union(corners[b]).union(corners[c])
}

/// Returns the box of an edge.
#[inline]
pub fn of_edge(corners: &CornerBoxes, edge: usize) -> Bounds {
    let [a, b] = EDGE_CORNERS[edge];
    corners[a].union(corners[b])
}

/// Returns the box of a whole block.
pub fn of_block(corners: &CornerBoxes) -> Bounds {
    corners[1..].iter().fold(corners[0], |all, corner| all.union(*corner))
}

/// Reference boxes of the parts of one block.
#[derive(Debug, Clone, PartialEq)]
pub struct PartBoxes {
    /// Boxes of its corners.
    pub corners: CornerBoxes,
    /// Boxes of its edges.
    pub edges: [Bounds; EDGES],
    /// Boxes of its faces.
    pub faces: [Bounds; FACES],
}

impl PartBoxes {
    /// Boxes of all space.
    pub fn all() -> Self {
        Self { corners: [Bounds::ALL; CORNERS], edges: [Bounds::ALL; EDGES], faces: [Bounds::ALL; FACES] }
    }

    /// Creates the boxes of a block, enlarged on every side by `margin`, m.
    pub fn enlarged(corners: &CornerBoxes, margin: f64) -> Self {
        let corners = corners.map(|corner| corner.enlarged(margin));
        Self {
            edges: std::array::from_fn(|n| of_edge(&corners, n)),
            faces: std::array::from_fn(|n| of_face(&corners, n)),
            corners,
        }
    }

    /// Returns true if the boxes of some corners of the block, a mask, lie within these. Where
    /// those of all corners do, those of edges and faces do as well.
    pub fn enclose(&self, boxes: &CornerBoxes, corners: u8) -> bool {
        let inside = |n: usize| self.corners[n].encloses(&boxes[n]);
        (0..CORNERS).filter(|n| corners >> n & 1 == 1).all(inside)
    }
}
