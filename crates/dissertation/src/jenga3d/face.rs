//! Faces: triangles of particles (section 4.2.4).

use glam::DVec3;

/// Triangle, its corners clockwise as seen from outside. The sides p1-p2 and p2-p3 are edges of the
/// block, p3-p1 is a diagonal.
///
/// ```
/// use teeter_dissertation::jenga3d::face::Face;
///
/// assert_eq!(Face { p1: 0, p2: 2, p3: 6 }.corners(), [0, 2, 6]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// Index of the particle at the first corner.
    pub p1: u32,
    /// Index of the particle at the second corner.
    pub p2: u32,
    /// Index of the particle at the third corner.
    pub p3: u32,
}

impl Face {
    /// Indices of the corners in order.
    pub fn corners(&self) -> [u32; 3] {
        [self.p1, self.p2, self.p3]
    }
}

/// Vector out of the front of a triangle with twice its area as length, m² (Eq. 4.6).
///
/// The printed order of the factors is for left-handed axes; these axes are right-handed.
pub fn normal(p1: DVec3, p2: DVec3, p3: DVec3) -> DVec3 {
    (p3 - p1).cross(p2 - p1) // Eq. 4.6
}

/// Distance of a point in front of a plane, scaled by the length of the normal (Eq. 4.7); negative
/// behind the plane.
pub fn distance_to_plane(point: DVec3, on_face: DVec3, normal: DVec3) -> f64 {
    (point - on_face).dot(normal) // Eq. 4.7
}
