//! Collision of two moving edges (section 4.4.2, appendix 1.2).

use glam::DVec3;

use super::cubic::Cubic;
use super::path::Path;

/// Sine of the angle below which two edges count as parallel. They then touch along a line, whose
/// ends other pairs detect.
const PARALLEL: f64 = 1e-6;

/// Crossing of two edges.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::edge_edge::{distance, first_hit};
/// use teeter_dissertation::jenga3d::path::Path;
///
/// let (x, y, down) = (0.5 * DVec3::X, 0.5 * DVec3::Y, -DVec3::Z);
/// let lower = [-x, x].map(|end| Path::between(end, end));
/// let upper = [-y, y].map(|end| Path::between(end - 0.25 * down, end + 0.75 * down));
/// let hit = first_hit(&distance(&lower, &upper), &lower, &upper, 0.0).expect("they cross");
/// assert_eq!((hit.t, hit.normal, hit.mu_1, hit.mu_2), (0.25, DVec3::Z, 0.5, 0.5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeEdgeHit {
    /// Time of the crossing, 0 to 1.
    pub t: f64,
    /// Unit normal to both edges, from the first to the second before the crossing.
    pub normal: DVec3,
    /// Position along the first edge, 0 to 1.
    pub mu_1: f64,
    /// Position along the second edge, 0 to 1.
    pub mu_2: f64,
}

/// Distance of the second line from the first along their common normal as a function of time,
/// scaled by that normal (Eq. 4.11).
///
/// Appendix 1.2 has p3 - p1 where Eq. 4.11a has p1 - p3. Every coefficient has exactly one of these
/// as a factor, so all change sign together and the roots are the same.
#[inline]
pub fn distance(first: &[Path; 2], second: &[Path; 2]) -> Cubic {
    let ([p1, p2], [p3, p4]) = (first, second);
    let (a1, a2, a3) = (p2.start - p1.start, p4.start - p3.start, p3.start - p1.start);
    let (d1, d2, d3) = (p2.step - p1.step, p4.step - p3.step, p3.step - p1.step);
    let (c1, c2) = (d1.cross(d2), a1.cross(a2));
    let c3 = d1.cross(a2) + a1.cross(d2);
    Cubic { a: d3.dot(c1), b: a3.dot(c1) + d3.dot(c3), c: a3.dot(c3) + d3.dot(c2), d: a3.dot(c2) }
}

/// Returns the first crossing of the edges, each extended by `tolerance` (m) at both ends;
/// `distance` is [`distance()`].
pub fn first_hit(distance: &Cubic, first: &[Path; 2], second: &[Path; 2], tolerance: f64) -> Option<EdgeEdgeHit> {
    distance.crossings().as_slice().iter().find_map(|root| {
        let ([p1, p2], [p3, p4]) = (first.map(|path| path.at(root.t)), second.map(|path| path.at(root.t)));
        let (along_1, along_2) = (p2 - p1, p4 - p3);
        let across = along_1.cross(along_2);
        let size = across.length();
        let (length_1, length_2) = (along_1.length(), along_2.length());
        if size.is_nan() || size <= PARALLEL * length_1 * length_2 {
            return None;
        }
        // Eq. 4.12: p1 + mu_1 along_1 = p3 + mu_2 along_2. A cross product eliminates one unknown
        // each.
        let apart = p3 - p1;
        let mu_1 = apart.cross(along_2).dot(across) / (size * size);
        let mu_2 = apart.cross(along_1).dot(across) / (size * size);
        let within = |mu: f64, length: f64| mu >= -tolerance / length && mu <= 1.0 + tolerance / length;
        if !(within(mu_1, length_1) && within(mu_2, length_2)) {
            return None;
        }
        let clamp = |mu: f64| mu.clamp(0.0, 1.0);
        let normal = if root.descending { across / size } else { -across / size };
        Some(EdgeEdgeHit { t: root.t, normal, mu_1: clamp(mu_1), mu_2: clamp(mu_2) })
    })
}
