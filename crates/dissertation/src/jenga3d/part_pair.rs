//! Parts of two blocks that collide: a face with a corner, and an edge with an edge.

use super::block::{CORNERS, EDGE_CORNERS, EDGES, FACE_CORNERS};
use super::bounds::Bounds;
use super::boxes::{self, CORNERS_OF_EDGE, CORNERS_OF_FACE, CornerBoxes, EDGES_OF_CORNER};
use super::contact::{Contact, Kind};
use super::cubic::Cubic;
use super::edge_edge;
use super::field::Field;
use super::path::Path;
use super::point_face::{self, MovingPlane};

/// Number of edges, as of faces, of a block.
pub const OUTER_PARTS: usize = 12;

/// Kind of parts of two blocks. The outer loop iterates over those of one block, the inner loop
/// over those of the other. Blocks and parts are given with the outer one first.
pub trait PartPair {
    /// Masks of the corners of each outer part.
    const OUTER_CORNERS: [u8; OUTER_PARTS];
    /// Paths of an outer part.
    type Outer;

    /// Returns a mask of the inner parts that have one of these corners, a mask.
    fn inner_of(corners: u8) -> u16;

    /// Number of inner parts of a block.
    const INNER_PARTS: usize;

    /// Returns the box of an outer part.
    fn outer_box(corners: &CornerBoxes, part: usize) -> Bounds;

    /// Returns the box of an inner part.
    fn inner_box(corners: &CornerBoxes, part: usize) -> Bounds;

    /// Paths of an outer part, from those of the corners of its block.
    fn outer(corners: &[Path; CORNERS], part: usize) -> Self::Outer;

    /// Distance of an inner part from an outer one as a function of time, from the paths of the
    /// corners of its block.
    fn distance(outer: &Self::Outer, corners: &[Path; CORNERS], part: usize) -> Cubic;

    /// Contact of two parts, if their distance has a root where they meet.
    fn contact(field: &Field, blocks: [usize; 2], parts: [usize; 2], distance: &Cubic) -> Option<Contact>;
}

/// Face of the outer block and corner of the inner one.
pub struct FaceCorner;

/// Particles of a face.
fn face(field: &Field, block: usize, part: usize) -> [usize; 3] {
    let first = field.model.blocks[block].particles as usize;
    FACE_CORNERS[part].map(|c| first + c)
}

impl PartPair for FaceCorner {
    const OUTER_CORNERS: [u8; OUTER_PARTS] = CORNERS_OF_FACE;
    const INNER_PARTS: usize = CORNERS;
    type Outer = MovingPlane;

    #[inline]
    fn inner_of(corners: u8) -> u16 {
        u16::from(corners)
    }

    #[inline]
    fn outer_box(corners: &CornerBoxes, part: usize) -> Bounds {
        boxes::of_face(corners, part)
    }

    #[inline]
    fn inner_box(corners: &CornerBoxes, part: usize) -> Bounds {
        corners[part]
    }

    #[inline]
    fn outer(corners: &[Path; CORNERS], part: usize) -> MovingPlane {
        MovingPlane::new(&FACE_CORNERS[part].map(|c| corners[c]))
    }

    #[inline]
    fn distance(outer: &MovingPlane, corners: &[Path; CORNERS], part: usize) -> Cubic {
        outer.distance(&corners[part])
    }

    fn contact(field: &Field, blocks: [usize; 2], parts: [usize; 2], distance: &Cubic) -> Option<Contact> {
        let particle = field.model.blocks[blocks[1]].particles as usize + parts[1];
        let face = face(field, blocks[0], parts[0]);
        let (point, corners) = (field.path(particle), face.map(|p| field.path(p)));
        let hit = point_face::first_hit(distance, &point, &corners, field.constants.tolerance)?;
        let [w1, w2, w3] = hit.weights;
        Some(Contact {
            kind: Kind::ParticleFace(particle as u32, field.model.blocks[blocks[0]].faces + parts[0] as u32),
            blocks: [blocks[1] as u32, blocks[0] as u32],
            particles: [particle as u32, face[0] as u32, face[1] as u32, face[2] as u32],
            weights: [1.0, -w1, -w2, -w3],
            normal: hit.normal,
            normal_force: 0.0,
        })
    }
}

/// Edges of both blocks.
pub struct EdgeEdge;

/// Particles of an edge.
#[inline]
fn edge(field: &Field, block: usize, part: usize) -> [usize; 2] {
    let first = field.model.blocks[block].particles as usize;
    EDGE_CORNERS[part].map(|c| first + c)
}

impl PartPair for EdgeEdge {
    const OUTER_CORNERS: [u8; OUTER_PARTS] = CORNERS_OF_EDGE;
    const INNER_PARTS: usize = EDGES;
    type Outer = [Path; 2];

    #[inline]
    fn inner_of(corners: u8) -> u16 {
        (0..CORNERS).fold(0, |edges, n| if corners >> n & 1 == 1 { edges | EDGES_OF_CORNER[n] } else { edges })
    }

    #[inline]
    fn outer_box(corners: &CornerBoxes, part: usize) -> Bounds {
        boxes::of_edge(corners, part)
    }

    #[inline]
    fn inner_box(corners: &CornerBoxes, part: usize) -> Bounds {
        boxes::of_edge(corners, part)
    }

    #[inline]
    fn outer(corners: &[Path; CORNERS], part: usize) -> [Path; 2] {
        EDGE_CORNERS[part].map(|c| corners[c])
    }

    #[inline]
    fn distance(outer: &[Path; 2], corners: &[Path; CORNERS], part: usize) -> Cubic {
        edge_edge::distance(outer, &EDGE_CORNERS[part].map(|c| corners[c]))
    }

    fn contact(field: &Field, blocks: [usize; 2], parts: [usize; 2], distance: &Cubic) -> Option<Contact> {
        let ends = [0, 1].map(|k| edge(field, blocks[k], parts[k]));
        let [first, second] = ends.map(|ends| ends.map(|p| field.path(p)));
        let hit = edge_edge::first_hit(distance, &first, &second, field.constants.tolerance)?;
        let [spring_a, spring_b] = [0, 1].map(|k| field.model.blocks[blocks[k]].springs + parts[k] as u32);
        let [a, b] = ends.map(|ends| ends.map(|p| p as u32));
        Some(Contact {
            kind: Kind::EdgeEdge(spring_a, spring_b),
            blocks: [blocks[1] as u32, blocks[0] as u32],
            particles: [b[0], b[1], a[0], a[1]],
            weights: [1.0 - hit.mu_2, hit.mu_2, hit.mu_1 - 1.0, -hit.mu_1],
            normal: hit.normal,
            normal_force: 0.0,
        })
    }
}
