//! Boxes of particles, edges, faces and blocks, updated as particles change (sections 4.4.3 and
//! 5.3).

use super::block::{CORNERS, EDGE_CORNERS, EDGES, FACE_CORNERS, FACES};
use super::bounds::{Bounds, BoundsArray};
use super::particle::State;

/// Masks of the faces at each corner.
const FACES_OF: [u16; CORNERS] = {
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

/// Masks of the edges at each corner.
const EDGES_OF: [u16; CORNERS] = {
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

/// Boxes of the parts of one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockBoxes {
    /// Boxes of its corners.
    pub corners: BoundsArray<CORNERS>,
    /// Boxes of its edges.
    pub edges: BoundsArray<EDGES>,
    /// Boxes of its faces.
    pub faces: BoundsArray<FACES>,
}

impl BlockBoxes {
    /// Creates the boxes of a block with these current and next states.
    pub fn new(curr: &[State], next: &[State]) -> Self {
        let corners: BoundsArray<CORNERS> = BoundsArray::new(|i| Bounds::of_path(curr[i].position, next[i].position));
        let edges = BoundsArray::new(|n| enclose(&corners, &EDGE_CORNERS[n]));
        let faces = BoundsArray::new(|n| enclose(&corners, &FACE_CORNERS[n]));
        Self { corners, edges, faces }
    }

    /// Returns the box of the whole block.
    pub fn block(&self) -> Bounds {
        enclose(&self.corners, &[0, 1, 2, 3, 4, 5, 6, 7])
    }

    /// Updates the boxes after a change of one corner.
    pub fn update_corner(&mut self, corner: usize, curr: &State, next: &State) {
        self.corners.set(corner, Bounds::of_path(curr.position, next.position));
        for (n, ends) in EDGE_CORNERS.iter().enumerate() {
            if EDGES_OF[corner] >> n & 1 == 1 {
                self.edges.set(n, enclose(&self.corners, ends));
            }
        }
        for (n, corners) in FACE_CORNERS.iter().enumerate() {
            if FACES_OF[corner] >> n & 1 == 1 {
                self.faces.set(n, enclose(&self.corners, corners));
            }
        }
    }
}

/// Returns the box of some corners.
fn enclose<const N: usize>(corners: &BoundsArray<CORNERS>, indices: &[usize; N]) -> Bounds {
    indices[1..].iter().fold(corners.get(indices[0]), |all, &c| all.union(corners.get(c)))
}
