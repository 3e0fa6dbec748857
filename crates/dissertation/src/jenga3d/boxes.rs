//! Boxes of particles, edges, faces and blocks, updated as particles change (sections 4.4.3 and
//! 5.3).

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

/// Masks of the faces at each corner.
const FACES_OF_CORNER: [u16; CORNERS] = {
    let mut of = [0; CORNERS];
    let mut face = 0;
    while face < FACES {
        let [a, b, c] = FACE_CORNERS[face];
        of[a] |= 1 << face;
        of[b] |= 1 << face;
        of[c] |= 1 << face;
        face += 1;
    }
    of
};

/// Boxes of the parts of one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockBoxes {
    /// Boxes of its corners.
    pub corners: [Bounds; CORNERS],
    /// Boxes of its edges.
    pub edges: [Bounds; EDGES],
    /// Boxes of its faces.
    pub faces: [Bounds; FACES],
}

impl BlockBoxes {
    /// Boxes of all space.
    pub const ALL: Self =
        Self { corners: [Bounds::ALL; CORNERS], edges: [Bounds::ALL; EDGES], faces: [Bounds::ALL; FACES] };

    /// Returns the box of the whole block.
    pub fn block(&self) -> Bounds {
        enclose(&self.corners, [0, 1, 2, 3, 4, 5, 6, 7])
    }

    /// Returns the boxes enlarged on every side by `margin`, m.
    pub fn enlarged(&self, margin: f64) -> Self {
        Self {
            corners: self.corners.map(|part| part.enlarged(margin)),
            edges: self.edges.map(|part| part.enlarged(margin)),
            faces: self.faces.map(|part| part.enlarged(margin)),
        }
    }

    /// Returns true if the boxes of some corners of another, a mask, lie within these. Where those
    /// of all corners do, those of edges and faces do as well.
    pub fn enclose(&self, other: &Self, corners: u8) -> bool {
        let inside = |n: usize| self.corners[n].encloses(&other.corners[n]);
        (0..CORNERS).filter(|n| corners >> n & 1 == 1).all(inside)
    }

    /// Updates the boxes after a change of some corners, a mask.
    #[inline(never)]
    pub fn update_corners(&mut self, changed: u8, curr: &[State], next: &[State]) {
        for (n, corner) in self.corners.iter_mut().enumerate().filter(|(n, _)| changed >> n & 1 == 1) {
            *corner = Bounds::of_path(curr[n].position, next[n].position);
        }
        let (mut edges, mut faces) = (0u16, 0u16);
        for n in (0..CORNERS).filter(|n| changed >> n & 1 == 1) {
            edges |= EDGES_OF_CORNER[n];
            faces |= FACES_OF_CORNER[n];
        }
        while edges != 0 {
            let n = edges.trailing_zeros() as usize;
            edges &= edges - 1;
            self.edges[n] = enclose(&self.corners, EDGE_CORNERS[n]);
        }
        while faces != 0 {
            let n = faces.trailing_zeros() as usize;
            faces &= faces - 1;
            self.faces[n] = enclose(&self.corners, FACE_CORNERS[n]);
        }
    }
}

/// Returns the box of some corners.
#[inline]
fn enclose<const N: usize>(corners: &[Bounds; CORNERS], indices: [usize; N]) -> Bounds {
    indices[1..].iter().fold(corners[indices[0]], |all, &c| all.union(corners[c]))
}
