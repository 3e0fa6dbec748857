//! Convex polygons in a plane of contact: clipping, and the patch of contact that a polygon bounds.

use arrayvec::ArrayVec;

/// Most corners of a polygon: a quadrilateral clipped by a rectangle has eight.
pub const MAX_CORNERS: usize = 8;

/// Corner of a polygon: coordinates in the plane, and separation from it, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    pub u: f64,
    pub v: f64,
    pub gap: f64,
}

/// Polygon of at most [`MAX_CORNERS`] corners.
pub type Polygon = ArrayVec<Corner, MAX_CORNERS>;

/// Clips a convex polygon to |u| <= hu, |v| <= hv (Sutherland and Hodgman 1974).
pub fn clip(corners: &[Corner; 4], hu: f64, hv: f64) -> Polygon {
    let mut polygon: Polygon = corners.iter().copied().collect();
    for side in [(1.0, 0.0, hu), (-1.0, 0.0, hu), (0.0, 1.0, hv), (0.0, -1.0, hv)] {
        let inside = |c: &Corner| side.2 - (side.0 * c.u + side.1 * c.v);
        let mut next = Polygon::new();
        let mut from = polygon[polygon.len() - 1];
        for to in &polygon {
            let (d0, d1) = (inside(&from), inside(to));
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
            from = *to;
        }
        polygon = next;
        if polygon.is_empty() {
            break;
        }
    }
    polygon
}

/// Removes each corner that is closer than `distance` (m) to the corner before it.
pub fn merge(polygon: &mut Polygon, distance: f64) {
    let near = |p: &Corner, q: &Corner| (p.u - q.u) * (p.u - q.u) + (p.v - q.v) * (p.v - q.v) < distance * distance;
    let mut merged = Polygon::new();
    for corner in polygon.iter() {
        if !merged.last().is_some_and(|last| near(corner, last)) {
            merged.push(*corner);
        }
    }
    *polygon = merged;
    while polygon.len() > 1 && near(&polygon[0], &polygon[polygon.len() - 1]) {
        polygon.pop();
    }
}

/// Patch of contact: a uniform pressure over a polygon, represented by forces at its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Area, m².
    pub area: f64,
    /// Centroid, m.
    pub centroid: [f64; 2],
    /// Share of each corner in the force: half of the two triangles of the centroid fan that meet
    /// in it.
    pub shares: [f64; MAX_CORNERS],
    /// Torsional friction of a uniform pressure over that of the forces at the corners: friction
    /// acts at the corners' arms times this ratio.
    pub torsion_ratio: f64,
}

/// Torsion ratio of a patch without area: the ends of a line are twice as far from its middle as
/// its points are on average.
pub const LINE_TORSION_RATIO: f64 = 0.5;

impl Patch {
    /// Patch of a convex polygon. One without area has equal shares.
    pub fn new(polygon: &[Corner]) -> Self {
        let n = polygon.len();
        let next = |i: usize| if i + 1 == n { 0 } else { i + 1 };
        let inv = 1.0 / n as f64;
        let mean = [polygon.iter().map(|c| c.u).sum::<f64>() * inv, polygon.iter().map(|c| c.v).sum::<f64>() * inv];
        let (mut twice, mut moment) = (0.0, [0.0; 2]);
        for i in 0..n {
            let (p, q) = (&polygon[i], &polygon[next(i)]);
            let c = twice_area(mean, p, q);
            twice += c;
            moment[0] += c * (p.u + q.u + mean[0]) / 3.0;
            moment[1] += c * (p.v + q.v + mean[1]) / 3.0;
        }
        // The centroid of a sliver thinner than a micrometre is lost in rounding.
        let extent = polygon.iter().map(|c| (c.u - mean[0]).abs() + (c.v - mean[1]).abs()).fold(0.0, f64::max);
        if twice.abs() < 1e-6 * extent || n < 3 {
            let shares = [inv; MAX_CORNERS];
            return Self { area: 0.0, centroid: mean, shares, torsion_ratio: LINE_TORSION_RATIO };
        }
        let centroid = [moment[0] / twice, moment[1] / twice];
        // Distance of each corner from the centroid, and twice the triangle from it to the next
        // corner.
        let mut corners = [(0.0, 0.0); MAX_CORNERS];
        for (i, c) in polygon.iter().enumerate() {
            let distance =
                ((c.u - centroid[0]) * (c.u - centroid[0]) + (c.v - centroid[1]) * (c.v - centroid[1])).sqrt();
            corners[i] = (distance, twice_area(centroid, c, &polygon[next(i)]));
        }
        let mut shares = [0.0; MAX_CORNERS];
        let (mut integral, mut at_corners) = (0.0, 0.0);
        let mut before = corners[n - 1].1;
        for (i, share) in shares.iter_mut().enumerate().take(n) {
            let (here, after) = (&polygon[i], &polygon[next(i)]);
            let (distance, triangle) = corners[i];
            *share = 0.5 * (before + triangle) / twice;
            let length = ((after.u - here.u) * (after.u - here.u) + (after.v - here.v) * (after.v - here.v)).sqrt();
            integral += distance_integral(triangle.abs(), length, distance, corners[next(i)].0);
            at_corners += *share * distance;
            before = triangle;
        }
        let area = 0.5 * twice.abs();
        Self { area, centroid, shares, torsion_ratio: integral / area / at_corners }
    }
}

/// Twice the signed area of the triangle (o, p, q), m².
fn twice_area(o: [f64; 2], p: &Corner, q: &Corner) -> f64 {
    (p.u - o[0]) * (q.v - o[1]) - (p.v - o[1]) * (q.u - o[0])
}

/// Integral over a triangle of the distance from one of its corners, m³. Arguments are twice the
/// area (m²), the length of the opposite side (m), and the distances of that side's ends (m).
///
/// With h the height over that side, and a and b the angles of its ends off the height, the
/// integral is h³/6 [sec t tan t + asinh tan t] from a to b. The difference of the two asinh is
/// taken in one call.
fn distance_integral(twice: f64, length: f64, from: f64, to: f64) -> f64 {
    let height = twice / length;
    // A triangle this thin counts as a line.
    if height < 1e-9 * length {
        return 0.0;
    }
    // Coordinates of the ends along the side, from the foot of the height.
    let end = (to * to - from * from + length * length) / (2.0 * length);
    let start = end - length;
    let tangent = (end * from - start * to) / (height * height);
    height / 6.0 * (end * to - start * from + height * height * libm::asinh(tangent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon(points: impl IntoIterator<Item = (f64, f64)>) -> Polygon {
        points.into_iter().map(|(u, v)| Corner { u, v, gap: 0.0 }).collect()
    }

    fn rectangle(a: f64, b: f64) -> Polygon {
        polygon([(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)])
    }

    /// Torsion ratio of a rectangle: its mean distance d/6 + a²/(12 b) asinh(b/a) + b²/(12 a)
    /// asinh(a/b) over half its diagonal d.
    #[test]
    fn torsion_ratios_of_squares_blocks_and_strips() {
        let closed = |a: f64, b: f64| {
            let d = (a * a + b * b).sqrt();
            (d / 6.0 + a * a / (12.0 * b) * libm::asinh(b / a) + b * b / (12.0 * a) * libm::asinh(a / b)) / (d / 2.0)
        };
        for (a, b) in [(0.0268, 0.0268), (0.0268, 0.018), (0.081, 0.0268), (0.081, 0.018), (0.081, 1e-4)] {
            let ratio = Patch::new(&rectangle(a, b)).torsion_ratio;
            assert!((ratio - closed(a, b)).abs() < 1e-9, "{a} x {b}: {ratio} instead of {}", closed(a, b));
        }
        assert!((Patch::new(&rectangle(1.0, 1.0)).torsion_ratio - 0.5411).abs() < 1e-4);
        assert!((Patch::new(&rectangle(1.0, 1e-5)).torsion_ratio - LINE_TORSION_RATIO).abs() < 1e-4);
        assert!(Patch::new(&rectangle(1.0, 0.0)).torsion_ratio == LINE_TORSION_RATIO);
    }

    proptest! {
        /// Friction at the shortened arms of the corners resists torsion as a uniform pressure on
        /// many triangles does, in either winding order.
        #[test]
        fn the_torsion_ratio_is_that_of_a_uniform_pressure(
            mut angles in prop::collection::vec(0.0..std::f64::consts::TAU, 3..=MAX_CORNERS),
            (wide, high, at) in (0.01..0.05f64, 0.001..0.05f64, -1.0..1.0f64),
        ) {
            angles.sort_by(f64::total_cmp);
            angles.dedup_by(|a, b| (*a - *b).abs() < 0.05);
            let corners = polygon(angles.iter().map(|t| (at + wide * libm::cos(*t), high * libm::sin(*t))));
            let patch = Patch::new(&corners);
            prop_assume!(patch.area > 1e-6);
            let [u, v] = patch.centroid;
            let n = corners.len();
            let (mut area, mut moment) = (0.0, 0.0);
            for i in 0..n {
                let ends = [corners[i], corners[(i + 1) % n]].map(|c| (c.u - u, c.v - v));
                let triangle = 0.5 * (ends[0].0 * ends[1].1 - ends[0].1 * ends[1].0);
                // Strips from the centroid to the side: the mean distance over a strip of length R
                // is 2/3 R.
                let strips = 2000;
                for k in 0..strips {
                    let t = (f64::from(k) + 0.5) / f64::from(strips);
                    let (x, y) = (ends[0].0 + t * (ends[1].0 - ends[0].0), ends[0].1 + t * (ends[1].1 - ends[0].1));
                    area += triangle / f64::from(strips);
                    moment += triangle / f64::from(strips) * (x * x + y * y).sqrt() * (2.0 / 3.0);
                }
            }
            let corner = |i: usize| {
                let (x, y) = (corners[i].u - u, corners[i].v - v);
                patch.shares[i] * (x * x + y * y).sqrt()
            };
            let at_corners: f64 = (0..n).map(corner).sum();
            prop_assert!((patch.area / area - 1.0).abs() < 1e-9);
            prop_assert!((patch.torsion_ratio * at_corners / (moment / area) - 1.0).abs() < 1e-5);
            let reversed: Polygon = corners.iter().rev().copied().collect();
            prop_assert!((Patch::new(&reversed).torsion_ratio / patch.torsion_ratio - 1.0).abs() < 1e-9);
        }
    }
}
