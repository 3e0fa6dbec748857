//! A ray, and what it meets.

use glam::{IVec3, Vec3};

/// Half-line. The direction need not have unit length; distances along the ray are multiples of it.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Start, m.
    pub origin: Vec3,
    /// Direction.
    pub direction: Vec3,
}

impl Ray {
    /// Returns the point at a distance along the ray, m.
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + distance * self.direction
    }
}

/// Point at which a ray enters a shape, in the shape's own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Distance along the ray.
    pub distance: f32,
    /// Outward normal; not of unit length.
    pub normal: Vec3,
    /// Part of the surface, a sign an axis: a face has one, an edge two and a corner three.
    pub part: IVec3,
}
