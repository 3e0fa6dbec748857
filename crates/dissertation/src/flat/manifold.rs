//! Contact manifold of two rectangles.

use glam::DVec2;

use super::axes;
use super::body::Body;

/// Contact point of two bodies.
///
/// ```
/// use teeter_dissertation::flat::body::Body;
/// use teeter_dissertation::flat::manifold::points;
/// use teeter_dissertation::flat::scene::stack;
///
/// let blocks = stack(2, 0.0).iter().map(Body::new).collect::<Vec<_>>();
/// let points = points(&blocks[1], &blocks[0], 1e-6);
/// assert_eq!(points.len(), 2);
/// assert_eq!(points[0].normal, glam::DVec2::Y); // from the lower block to the upper one
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Position, m.
    pub position: DVec2,
    /// Unit normal, from the second body to the first.
    pub normal: DVec2,
    /// True where the normal rotates with the first body, false where it rotates with the second.
    pub of_first: bool,
    /// Penetration, m; negative for a gap.
    pub depth: f64,
}

/// Returns the contact points of two bodies at most `margin` (m) apart along the axis of maximum
/// separation: at most two, the ends of the overlap of their facing sides.
pub fn points(a: &Body, b: &Body, margin: f64) -> Vec<Point> {
    let (axis, gap) = axes::max_separation(a, b);
    if gap > margin {
        return Vec::new();
    }
    let normal = axes::normal(a, b);
    // The side of the body that the axis belongs to is the reference. The other body contributes
    // the side that faces it best.
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
    // Clip to the extent of the reference side.
    for (origin, inwards) in [(from, along), (to, -along)] {
        let (s, t) = ((p - origin).dot(inwards), (q - origin).dot(inwards));
        match (s < 0.0, t < 0.0) {
            (true, true) => return Vec::new(),
            (true, false) => p += (q - p) * (s / (s - t)),
            (false, true) => q += (p - q) * (t / (t - s)),
            (false, false) => {}
        }
    }
    let point = |position: DVec2| Point { position, normal, of_first: axis < 2, depth: (from - position).dot(out) };
    [p, q].map(point).into_iter().filter(|p| p.depth >= -margin).collect()
}
