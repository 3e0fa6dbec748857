//! The contact points of two rectangles that touch or nearly do.

use glam::DVec2;

use super::axes;
use super::body::Body;

/// A point where two bodies touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Place, m.
    pub place: DVec2,
    /// Unit normal, from the second body to the first.
    pub normal: DVec2,
    /// Whether the normal turns with the first body; it turns with the second otherwise.
    pub of_first: bool,
    /// How deep the bodies are inside each other there, m; negative for a gap.
    pub depth: f64,
}

/// The points of two bodies no more than `margin` (m) apart along their widest axis: at most two, the ends of what their facing sides share.
pub fn points(a: &Body, b: &Body, margin: f64) -> Vec<Point> {
    let (axis, gap) = axes::widest(a, b);
    if gap > margin {
        return Vec::new();
    }
    let normal = axes::normal(a, b);
    // The axis belongs to one body, whose side is the reference; of the other the side that faces it most.
    let (reference, other, out) = if axis < 2 { (a, b, -normal) } else { (b, a, normal) };
    let side_of = |body: &Body, direction: DVec2| {
        let c = body.corners();
        let outwards = |n: usize| -(c[(n + 1) % 4] - c[n]).perp().normalize().dot(direction);
        let n = (1..4).fold(0, |best, n| if outwards(n) > outwards(best) { n } else { best });
        [c[n], c[(n + 1) % 4]]
    };
    let [from, to] = side_of(reference, out);
    let [mut p, mut q] = side_of(other, -out);
    let along = (to - from).normalize();
    // Cut to the reference side's extent.
    for (origin, inwards) in [(from, along), (to, -along)] {
        let (s, t) = ((p - origin).dot(inwards), (q - origin).dot(inwards));
        match (s < 0.0, t < 0.0) {
            (true, true) => return Vec::new(),
            (true, false) => p += (q - p) * (s / (s - t)),
            (false, true) => q += (p - q) * (t / (t - s)),
            (false, false) => {}
        }
    }
    let point = |place: DVec2| Point { place, normal, of_first: axis < 2, depth: (from - place).dot(out) };
    [p, q].map(point).into_iter().filter(|p| p.depth >= -margin).collect()
}
