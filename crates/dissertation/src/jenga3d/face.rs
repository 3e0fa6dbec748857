//! Faces: triangles of particles (section 4.2.4).

use glam::DVec3;

/// A triangle, its corners clockwise as seen from outside; the sides p1-p2 and p2-p3 are edges of the block, p3-p1 is a diagonal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// First corner, an index of a particle.
    pub p1: u32,
    /// Second corner.
    pub p2: u32,
    /// Third corner.
    pub p3: u32,
}

impl Face {
    /// The corners in order.
    pub fn corners(&self) -> [u32; 3] {
        [self.p1, self.p2, self.p3]
    }
}

/// A vector out of the front of a triangle, of twice its area, m² (Eq. 4.6).
///
/// The printed order of the factors points outwards for corners that are clockwise in left-handed axes; these axes are right-handed.
pub fn normal(p1: DVec3, p2: DVec3, p3: DVec3) -> DVec3 {
    (p3 - p1).cross(p2 - p1) // Eq. 4.6
}

/// How far a point is in front of a plane, times the length of the normal (Eq. 4.7); negative behind it.
pub fn distance_to_plane(point: DVec3, on_face: DVec3, normal: DVec3) -> f64 {
    (point - on_face).dot(normal) // Eq. 4.7
}
