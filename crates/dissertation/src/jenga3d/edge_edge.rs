//! When two moving edges cross (section 4.4.2, appendix 1.2).

use glam::DVec3;

use super::cubic::Cubic;
use super::point_face::Way;

/// Sine of the angle below which two edges count as parallel: they then meet along a line, whose ends other pairs find.
const PARALLEL: f64 = 1e-6;

/// Two edges that cross at some time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeEdgeHit {
    /// When, 0 to 1.
    pub t: f64,
    /// Unit normal to both edges, from the first to the second as they lay before.
    pub normal: DVec3,
    /// How far along the first edge, 0 to 1.
    pub mu_1: f64,
    /// How far along the second.
    pub mu_2: f64,
}

/// How far the second line is from the first along their common normal, as a function of time, scaled by that normal (Eq. 4.11).
///
/// Appendix 1.2 takes p3 - p1 where Eq. 4.11a has p1 - p3. Every coefficient has exactly one of these as a factor, so all change their
/// sign together: the two have the same roots.
#[inline]
pub fn distance(first: &[Way; 2], second: &[Way; 2]) -> Cubic {
    let ([p1, p2], [p3, p4]) = (first, second);
    let (a1, a2, a3) = (p2.start - p1.start, p4.start - p3.start, p3.start - p1.start);
    let (d1, d2, d3) = (p2.step - p1.step, p4.step - p3.step, p3.step - p1.step);
    let (c1, c2) = (d1.cross(d2), a1.cross(a2));
    let c3 = d1.cross(a2) + a1.cross(d2);
    Cubic { a: d3.dot(c1), b: a3.dot(c1) + d3.dot(c3), c: a3.dot(c3) + d3.dot(c2), d: a3.dot(c2) }
}

/// The first time at which the edges cross, each counting as longer by `tolerance` (m) at both ends; `distance` is [`distance()`].
pub fn first_hit(distance: &Cubic, first: &[Way; 2], second: &[Way; 2], tolerance: f64) -> Option<EdgeEdgeHit> {
    distance.crossings().as_slice().iter().find_map(|root| {
        let ([p1, p2], [p3, p4]) = (first.map(|way| way.at(root.t)), second.map(|way| way.at(root.t)));
        let (along_1, along_2) = (p2 - p1, p4 - p3);
        let across = along_1.cross(along_2);
        let size = across.length();
        let (long_1, long_2) = (along_1.length(), along_2.length());
        if size.is_nan() || size <= PARALLEL * long_1 * long_2 {
            return None;
        }
        // Eq. 4.12: p1 + mu_1 along_1 = p3 + mu_2 along_2, each solved by a product that the other unknown drops out of.
        let apart = p3 - p1;
        let mu_1 = apart.cross(along_2).dot(across) / (size * size);
        let mu_2 = apart.cross(along_1).dot(across) / (size * size);
        let within = |mu: f64, long: f64| mu >= -tolerance / long && mu <= 1.0 + tolerance / long;
        if !(within(mu_1, long_1) && within(mu_2, long_2)) {
            return None;
        }
        let clamp = |mu: f64| mu.clamp(0.0, 1.0);
        let normal = if root.falls { across / size } else { -across / size };
        Some(EdgeEdgeHit { t: root.t, normal, mu_1: clamp(mu_1), mu_2: clamp(mu_2) })
    })
}
