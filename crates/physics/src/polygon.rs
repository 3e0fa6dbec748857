//! Convex polygons in a plane of contact.

use arrayvec::ArrayVec;

use crate::manifold::MAX_POINTS;

/// A corner: place in the plane (m) and separation from it (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    pub u: f64,
    pub v: f64,
    pub gap: f64,
}

/// A polygon of at most eight corners.
pub type Polygon = ArrayVec<Corner, MAX_POINTS>;

/// Clips a convex polygon to |u| <= hu, |v| <= hv (Sutherland and Hodgman 1974).
pub fn clip(corners: &[Corner; 4], hu: f64, hv: f64) -> Polygon {
    let mut polygon: Polygon = corners.iter().copied().collect();
    for side in [(1.0, 0.0, hu), (-1.0, 0.0, hu), (0.0, 1.0, hv), (0.0, -1.0, hv)] {
        let inside = |c: &Corner| side.2 - (side.0 * c.u + side.1 * c.v);
        let mut next = Polygon::new();
        for (i, to) in polygon.iter().enumerate() {
            let from = &polygon[(i + polygon.len() - 1) % polygon.len()];
            let (d0, d1) = (inside(from), inside(to));
            if (d0 >= 0.0) != (d1 >= 0.0) {
                let t = d0 / (d0 - d1);
                next.push(Corner {
                    u: from.u + t * (to.u - from.u),
                    v: from.v + t * (to.v - from.v),
                    gap: from.gap + t * (to.gap - from.gap),
                });
            }
            if d1 >= 0.0 {
                next.push(*to);
            }
        }
        polygon = next;
        if polygon.is_empty() {
            break;
        }
    }
    polygon
}

/// Leaves out each corner that is closer than `distance` to the one before it.
pub fn merge(polygon: &mut Polygon, distance: f64) {
    let near = |p: &Corner, q: &Corner| (p.u - q.u) * (p.u - q.u) + (p.v - q.v) * (p.v - q.v) < distance * distance;
    let mut kept = Polygon::new();
    for corner in polygon.iter() {
        if !kept.last().is_some_and(|last| near(corner, last)) {
            kept.push(*corner);
        }
    }
    *polygon = kept;
    while polygon.len() > 1 && near(&polygon[0], &polygon[polygon.len() - 1]) {
        polygon.pop();
    }
}

/// Area, centroid and the share of each corner: half of the two triangles of the fan around the centroid that meet in it.
/// A polygon without area is shared evenly.
pub fn shares(polygon: &[Corner]) -> (f64, [f64; 2], [f64; MAX_POINTS]) {
    let n = polygon.len();
    let inv = 1.0 / n as f64;
    let mean = [polygon.iter().map(|c| c.u).sum::<f64>() * inv, polygon.iter().map(|c| c.v).sum::<f64>() * inv];
    // twice the triangle (o, p, q)
    let cross = |o: [f64; 2], p: &Corner, q: &Corner| (p.u - o[0]) * (q.v - o[1]) - (p.v - o[1]) * (q.u - o[0]);
    let (mut twice, mut moment) = (0.0, [0.0; 2]);
    for i in 0..n {
        let (p, q) = (&polygon[i], &polygon[(i + 1) % n]);
        let c = cross(mean, p, q);
        twice += c;
        moment[0] += c * (p.u + q.u + mean[0]) / 3.0;
        moment[1] += c * (p.v + q.v + mean[1]) / 3.0;
    }
    // a sliver thinner than a micrometre has no centroid worth the name
    let extent = polygon.iter().map(|c| (c.u - mean[0]).abs() + (c.v - mean[1]).abs()).fold(0.0, f64::max);
    if twice.abs() < 1e-6 * extent || n < 3 {
        return (0.0, mean, [inv; MAX_POINTS]);
    }
    let centroid = [moment[0] / twice, moment[1] / twice];
    let mut shares = [0.0; MAX_POINTS];
    for (i, share) in shares.iter_mut().enumerate().take(n) {
        let before = cross(centroid, &polygon[(i + n - 1) % n], &polygon[i]);
        let after = cross(centroid, &polygon[i], &polygon[(i + 1) % n]);
        *share = 0.5 * (before + after) / twice;
    }
    (0.5 * twice.abs(), centroid, shares)
}
