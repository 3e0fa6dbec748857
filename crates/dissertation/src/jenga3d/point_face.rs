//! When a moving point passes through a moving triangle from its front (section 4.4.1, appendix 1.1).

use glam::DVec3;

use super::cubic::Cubic;
use super::face::{distance_to_plane, normal};

/// A straight way that a particle goes while t goes from 0 to 1 (Eq. 4.8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// Where it is at t = 0, m.
    pub start: DVec3,
    /// How far it goes, m (Eq. 4.8b).
    pub step: DVec3,
}

impl Way {
    /// From one place to another.
    #[inline]
    pub fn between(start: DVec3, end: DVec3) -> Self {
        Self { start, step: end - start } // Eq. 4.8b
    }

    /// Where it is at t, m.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.start + self.step * t // Eq. 4.8a
    }
}

/// A point in a triangle at some time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointFaceHit {
    /// When, 0 to 1.
    pub t: f64,
    /// Unit normal of the face, outwards.
    pub normal: DVec3,
    /// Shares of the corners in the point; their sum is 1 (Eq. 4.14b).
    pub weights: [f64; 3],
}

/// The distance of the point to the plane of the face as a function of time (Eq. 4.10): positive in front, scaled by the normal.
///
/// Appendix 1.1, with the second and third corner exchanged as in [`normal`].
#[inline]
pub fn distance(point: &Way, face: &[Way; 3]) -> Cubic {
    let [f1, f3, f2] = face;
    let (a1, a2, a3) = (f2.start - f1.start, f3.start - f1.start, point.start - f1.start);
    let (d1, d2, d3) = (f2.step - f1.step, f3.step - f1.step, point.step - f1.step);
    let (c1, c2) = (d1.cross(d2), a1.cross(a2));
    let c3 = d1.cross(a2) + a1.cross(d2);
    Cubic { a: d3.dot(c1), b: a3.dot(c1) + d3.dot(c3), c: a3.dot(c3) + d3.dot(c2), d: a3.dot(c2) }
}

/// Whether the point is in front of the plane at the start and behind it at the end: the plane test of section 4.4.1, which does not see a
/// point that goes through and comes back within the step.
#[inline]
pub fn passes_plane(point: &Way, face: &[Way; 3]) -> bool {
    let [f1, f2, f3] = face;
    let side = |t: f64| distance_to_plane(point.at(t), f1.at(t), normal(f1.at(t), f2.at(t), f3.at(t)));
    side(0.0) > 0.0 && side(1.0) < 0.0
}

/// The first time at which the point passes from the front to the back within the triangle, which counts as larger by `tolerance` (m) on
/// every side; `distance` is [`distance()`].
pub fn first_hit(distance: &Cubic, point: &Way, face: &[Way; 3], tolerance: f64) -> Option<PointFaceHit> {
    distance.crossings().as_slice().iter().filter(|root| root.falls).find_map(|root| {
        let [f1, f2, f3] = face.map(|way| way.at(root.t));
        let p = point.at(root.t);
        let out = normal(f1, f2, f3);
        let size = out.length();
        // An edge crossed with the normal points out of the triangle: clockwise corners turn the order round.
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

/// Shares of the corners in a point of their plane (Eq. 4.15 and 4.16).
///
/// With a on the way from p1 to b on the opposite side, `mu_a` is how far a is along p1-b and `mu_b` how far b is along p2-p3. Eq. 4.15
/// measures `mu_b` from p3, which Eq. 4.16 would turn into the weight of the wrong corner: a contact at p2 would load p3.
pub fn weights(a: DVec3, p1: DVec3, p2: DVec3, p3: DVec3) -> [f64; 3] {
    // As ratios of areas, which need no b and hold where a is p1: mu_a (1 - mu_b) and mu_a mu_b are the shares of p2 and p3.
    let whole = normal(p1, p2, p3);
    let size = whole.length_squared();
    let w2 = normal(p1, a, p3).dot(whole) / size; // Eq. 4.16
    let w3 = normal(p1, p2, a).dot(whole) / size; // Eq. 4.16
    [1.0 - w2 - w3, w2, w3]
}
