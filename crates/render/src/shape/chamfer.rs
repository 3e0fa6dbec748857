//! A box with chamfered edges and corners: 13 pairs of parallel planes.

use glam::{IVec3, Vec3};

use super::span::Span;
use crate::ray::{Entry, Ray};

/// Planes of the edges, with the signs of one of each pair.
const EDGES: [IVec3; 6] = [
    IVec3::new(1, 1, 0),
    IVec3::new(1, -1, 0),
    IVec3::new(1, 0, 1),
    IVec3::new(1, 0, -1),
    IVec3::new(0, 1, 1),
    IVec3::new(0, 1, -1),
];
/// Planes of the corners.
const CORNERS: [IVec3; 4] = [IVec3::new(1, 1, 1), IVec3::new(1, 1, -1), IVec3::new(1, -1, 1), IVec3::new(1, -1, -1)];

/// Returns the point at which a ray enters. `span` is its part within the box of half edges `half`.
pub fn entry(half: Vec3, width: f32, ray: &Ray, mut span: Span) -> Option<Entry> {
    let planes = EDGES.iter().map(|part| (part, width)).chain(CORNERS.iter().map(|part| (part, 2.0 * width)));
    for (&part, cut) in planes {
        let normal = part.as_vec3();
        let bound = half.dot(normal.abs()) - cut;
        span.clip(part, ray.origin.dot(normal), ray.direction.dot(normal), bound)?;
    }
    span.entry()
}
