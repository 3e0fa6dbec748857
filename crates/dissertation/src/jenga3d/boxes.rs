//! The boxes of all particles, edges, faces and blocks, kept up as particles change (sections 4.4.3 and 5.3).

use super::block::{CORNERS, EDGE_CORNERS, EDGES, FACE_CORNERS, FACES};
use super::bounds::{Bounds, BoundsOf};
use super::particle::State;

/// Faces that each corner of a block is a corner of, as bits.
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

/// Edges that end at each corner, as bits.
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

/// The boxes of the parts of one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockBoxes {
    /// Of its corners.
    pub corners: BoundsOf<CORNERS>,
    /// Of its edges.
    pub edges: BoundsOf<EDGES>,
    /// Of its faces.
    pub faces: BoundsOf<FACES>,
}

impl BlockBoxes {
    /// Around a block whose eight states are these.
    pub fn new(curr: &[State], next: &[State]) -> Self {
        let corners: BoundsOf<CORNERS> = BoundsOf::new(|i| Bounds::of_way(curr[i].position, next[i].position));
        let edges = BoundsOf::new(|n| around(&corners, &EDGE_CORNERS[n]));
        let faces = BoundsOf::new(|n| around(&corners, &FACE_CORNERS[n]));
        Self { corners, edges, faces }
    }

    /// Around the whole block.
    pub fn block(&self) -> Bounds {
        around(&self.corners, &[0, 1, 2, 3, 4, 5, 6, 7])
    }

    /// Brings the boxes up to date after one corner has changed.
    pub fn renew_corner(&mut self, corner: usize, curr: &State, next: &State) {
        self.corners.set(corner, Bounds::of_way(curr.position, next.position));
        for (n, ends) in EDGE_CORNERS.iter().enumerate() {
            if EDGES_OF[corner] >> n & 1 == 1 {
                self.edges.set(n, around(&self.corners, ends));
            }
        }
        for (n, corners) in FACE_CORNERS.iter().enumerate() {
            if FACES_OF[corner] >> n & 1 == 1 {
                self.faces.set(n, around(&self.corners, corners));
            }
        }
    }
}

/// Around some corners.
fn around<const N: usize>(corners: &BoundsOf<CORNERS>, which: &[usize; N]) -> Bounds {
    which[1..].iter().fold(corners.get(which[0]), |all, &c| all.with(corners.get(c)))
}
