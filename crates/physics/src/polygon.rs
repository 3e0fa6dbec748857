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

/// What a pressure spread over a polygon comes to, told by forces at its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// m².
    pub area: f64,
    /// m.
    pub centroid: [f64; 2],
    /// Share of each corner: half of the two triangles of the fan around the centroid that meet in it.
    pub shares: [f64; MAX_POINTS],
    /// By how much the corners must be closer to the centroid for their friction to resist turning as that of an even pressure does.
    pub lever: f64,
}

/// The lever of a patch without area, of which the ends are twice as far from the middle as the mean.
pub const LINE_LEVER: f64 = 0.5;

/// The patch of a convex polygon. One without area is shared evenly.
pub fn patch(polygon: &[Corner]) -> Patch {
    let n = polygon.len();
    let next = |i: usize| if i + 1 == n { 0 } else { i + 1 };
    let inv = 1.0 / n as f64;
    let mean = [polygon.iter().map(|c| c.u).sum::<f64>() * inv, polygon.iter().map(|c| c.v).sum::<f64>() * inv];
    // twice the triangle (o, p, q)
    let cross = |o: [f64; 2], p: &Corner, q: &Corner| (p.u - o[0]) * (q.v - o[1]) - (p.v - o[1]) * (q.u - o[0]);
    let (mut twice, mut moment) = (0.0, [0.0; 2]);
    for i in 0..n {
        let (p, q) = (&polygon[i], &polygon[next(i)]);
        let c = cross(mean, p, q);
        twice += c;
        moment[0] += c * (p.u + q.u + mean[0]) / 3.0;
        moment[1] += c * (p.v + q.v + mean[1]) / 3.0;
    }
    // a sliver thinner than a micrometre has no centroid worth the name
    let extent = polygon.iter().map(|c| (c.u - mean[0]).abs() + (c.v - mean[1]).abs()).fold(0.0, f64::max);
    if twice.abs() < 1e-6 * extent || n < 3 {
        return Patch { area: 0.0, centroid: mean, shares: [inv; MAX_POINTS], lever: LINE_LEVER };
    }
    let centroid = [moment[0] / twice, moment[1] / twice];
    // of each corner its distance, and the triangle from it to the next
    let mut corners = [(0.0, 0.0); MAX_POINTS];
    for (i, c) in polygon.iter().enumerate() {
        let distance = ((c.u - centroid[0]) * (c.u - centroid[0]) + (c.v - centroid[1]) * (c.v - centroid[1])).sqrt();
        corners[i] = (distance, cross(centroid, c, &polygon[next(i)]));
    }
    let mut shares = [0.0; MAX_POINTS];
    let (mut spread, mut at_corners) = (0.0, 0.0);
    let mut before = corners[n - 1].1;
    for (i, share) in shares.iter_mut().enumerate().take(n) {
        let (here, after) = (&polygon[i], &polygon[next(i)]);
        let (distance, triangle) = corners[i];
        *share = 0.5 * (before + triangle) / twice;
        let length = ((after.u - here.u) * (after.u - here.u) + (after.v - here.v) * (after.v - here.v)).sqrt();
        spread += moment_of_distance(triangle.abs(), length, distance, corners[next(i)].0);
        at_corners += *share * distance;
        before = triangle;
    }
    let area = 0.5 * twice.abs();
    Patch { area, centroid, shares, lever: spread / area / at_corners }
}

/// The integral of the distance from a corner of a triangle over the triangle, m³: `twice` its area, the `length` of the side opposite, and the
/// distances of that side's ends.
///
/// With h the height over that side, which is seen from the angle a to the angle b off the height, it is h³/6 [sec t tan t + asinh tan t] from a to b.
/// The difference of the two asinh is that of one number.
fn moment_of_distance(twice: f64, length: f64, from: f64, to: f64) -> f64 {
    let height = twice / length;
    // far thinner than long, it is a line
    if height < 1e-9 * length {
        return 0.0;
    }
    // places of the ends along the side, from the foot of the height
    let end = (to * to - from * from + length * length) / (2.0 * length);
    let start = end - length;
    let seen = (end * from - start * to) / (height * height);
    height / 6.0 * (end * to - start * from + height * height * libm::asinh(seen))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon(places: impl IntoIterator<Item = (f64, f64)>) -> Polygon {
        places.into_iter().map(|(u, v)| Corner { u, v, gap: 0.0 }).collect()
    }

    fn rectangle(a: f64, b: f64) -> Polygon {
        polygon([(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)])
    }

    /// The lever of a rectangle: its mean distance d/6 + a²/(12 b) asinh(b/a) + b²/(12 a) asinh(a/b) over half its diagonal d.
    #[test]
    fn levers_of_squares_blocks_and_strips() {
        let closed = |a: f64, b: f64| {
            let d = (a * a + b * b).sqrt();
            (d / 6.0 + a * a / (12.0 * b) * libm::asinh(b / a) + b * b / (12.0 * a) * libm::asinh(a / b)) / (d / 2.0)
        };
        for (a, b) in [(0.0268, 0.0268), (0.0268, 0.018), (0.081, 0.0268), (0.081, 0.018), (0.081, 1e-4)] {
            let lever = patch(&rectangle(a, b)).lever;
            assert!((lever - closed(a, b)).abs() < 1e-9, "{a} x {b}: {lever} instead of {}", closed(a, b));
        }
        assert!((patch(&rectangle(1.0, 1.0)).lever - 0.5411).abs() < 1e-4);
        assert!((patch(&rectangle(1.0, 1e-5)).lever - LINE_LEVER).abs() < 1e-4);
        assert!(patch(&rectangle(1.0, 0.0)).lever == LINE_LEVER);
    }

    proptest! {
        /// The friction of the corners, drawn in, is that of an even pressure on very many triangles; the way round does not matter.
        #[test]
        fn the_lever_is_that_of_an_even_pressure(
            mut angles in prop::collection::vec(0.0..std::f64::consts::TAU, 3..=MAX_POINTS),
            (wide, high, at) in (0.01..0.05f64, 0.001..0.05f64, -1.0..1.0f64),
        ) {
            angles.sort_by(f64::total_cmp);
            angles.dedup_by(|a, b| (*a - *b).abs() < 0.05);
            let corners = polygon(angles.iter().map(|t| (at + wide * libm::cos(*t), high * libm::sin(*t))));
            let patch = patch(&corners);
            prop_assume!(patch.area > 1e-6);
            let [u, v] = patch.centroid;
            let n = corners.len();
            let (mut area, mut moment) = (0.0, 0.0);
            for i in 0..n {
                let ends = [corners[i], corners[(i + 1) % n]].map(|c| (c.u - u, c.v - v));
                let triangle = 0.5 * (ends[0].0 * ends[1].1 - ends[0].1 * ends[1].0);
                // strips from the centroid to the side: r goes evenly from 0 to R along each, so that the mean over a strip is 2/3 R
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
            prop_assert!((patch.lever * at_corners / (moment / area) - 1.0).abs() < 1e-5);
            let round: Polygon = corners.iter().rev().copied().collect();
            prop_assert!((super::patch(&round).lever / patch.lever - 1.0).abs() < 1e-9);
        }
    }
}
