//! Collision of a moving point with the front of a moving triangle (section 4.4.1, appendix 1.1).

use glam::DVec3;

use super::cubic::Cubic;
use super::face::{distance_to_plane, normal};
use super::path::Path;

/// Passage of a point through a triangle.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::path::Path;
/// use teeter_dissertation::jenga3d::point_face::{distance, first_hit};
///
/// // Clockwise from above.
/// let face = [DVec3::ZERO, DVec3::Y, DVec3::X].map(|corner| Path::between(corner, corner));
/// let point = Path::between(DVec3::new(0.25, 0.25, 0.5), DVec3::new(0.25, 0.25, -0.5));
/// let hit = first_hit(&distance(&point, &face), &point, &face, 0.0).expect("it passes");
/// assert_eq!((hit.t, hit.normal, hit.weights), (0.5, DVec3::Z, [0.5, 0.25, 0.25]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointFaceHit {
    /// Time of the passage, 0 to 1.
    pub t: f64,
    /// Outward unit normal of the face.
    pub normal: DVec3,
    /// Weights of the corners, of sum 1 (Eq. 4.14b).
    pub weights: [f64; 3],
}

/// Normal of a moving face as a function of time, c2 + c3 t + c1 t² (appendix 1.1), and the path of
/// its first corner: what the distances of all points from its plane have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingPlane {
    origin: Path,
    c1: DVec3,
    c2: DVec3,
    c3: DVec3,
}

impl MovingPlane {
    /// Plane of a face.
    ///
    /// Appendix 1.1, with the second and third corner exchanged as in [`normal`].
    #[inline]
    pub fn new(face: &[Path; 3]) -> Self {
        let [f1, f3, f2] = face;
        let (a1, a2) = (f2.start - f1.start, f3.start - f1.start);
        let (d1, d2) = (f2.step - f1.step, f3.step - f1.step);
        let (c1, c2) = (d1.cross(d2), a1.cross(a2));
        Self { origin: *f1, c1, c2, c3: d1.cross(a2) + a1.cross(d2) }
    }

    /// Distance of a point as a function of time (Eq. 4.10): positive in front, scaled by the
    /// normal.
    #[inline]
    pub fn distance(&self, point: &Path) -> Cubic {
        let Self { origin, c1, c2, c3 } = *self;
        let (a3, d3) = (point.start - origin.start, point.step - origin.step);
        Cubic { a: d3.dot(c1), b: a3.dot(c1) + d3.dot(c3), c: a3.dot(c3) + d3.dot(c2), d: a3.dot(c2) }
    }
}

/// Distance of the point from the plane of the face as a function of time (Eq. 4.10): positive in
/// front, scaled by the normal.
#[inline]
pub fn distance(point: &Path, face: &[Path; 3]) -> Cubic {
    MovingPlane::new(face).distance(point)
}

/// Returns true if the point is in front of the plane at the start and behind it at the end.
///
/// The plane test of section 4.4.1 misses a point that passes and returns within the step.
#[inline]
pub fn passes_plane(point: &Path, face: &[Path; 3]) -> bool {
    let [f1, f2, f3] = face;
    let side = |t: f64| distance_to_plane(point.at(t), f1.at(t), normal(f1.at(t), f2.at(t), f3.at(t)));
    side(0.0) > 0.0 && side(1.0) < 0.0
}

/// Returns the first passage of the point from the front to the back of the triangle, enlarged by
/// `tolerance` (m) on every side; `distance` is [`distance()`].
pub fn first_hit(distance: &Cubic, point: &Path, face: &[Path; 3], tolerance: f64) -> Option<PointFaceHit> {
    distance.crossings().as_slice().iter().filter(|root| root.descending).find_map(|root| {
        let [f1, f2, f3] = face.map(|path| path.at(root.t));
        let p = point.at(root.t);
        let out = normal(f1, f2, f3);
        let size = out.length();
        // The normal crossed with an edge points out of the triangle, because its corners are
        // clockwise.
        let beyond = |from: DVec3, to: DVec3| {
            let side = out.cross(to - from);
            distance_to_plane(p, from, side) > tolerance * side.length()
        };
        if size.is_nan() || size <= 0.0 || beyond(f1, f2) || beyond(f2, f3) || beyond(f3, f1) {
            return None;
        }
        Some(PointFaceHit { t: root.t, normal: out / size, weights: weights(p, f1, f2, f3) })
    })
}

/// Weights of the corners in a point of their plane (Eq. 4.15 and 4.16).
///
/// The line from p1 through a ends in b on the opposite side. `mu_a` is the position of a along
/// p1-b and `mu_b` that of b along p2-p3. Eq. 4.15 measures `mu_b` from p3, so Eq. 4.16 would swap
/// the weights of p2 and p3.
pub fn weights(a: DVec3, p1: DVec3, p2: DVec3, p3: DVec3) -> [f64; 3] {
    // Ratios of areas need no b and hold where a is p1: mu_a (1 - mu_b) and mu_a mu_b are the
    // weights of p2 and p3.
    let whole = normal(p1, p2, p3);
    let size = whole.length_squared();
    let w2 = normal(p1, a, p3).dot(whole) / size; // Eq. 4.16
    let w3 = normal(p1, p2, a).dot(whole) / size; // Eq. 4.16
    [1.0 - w2 - w3, w2, w3]
}
