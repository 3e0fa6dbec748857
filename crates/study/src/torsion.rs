//! Torsional friction of a patch of contact.
//!
//! Under a uniform pressure a patch of area A resists rotation about its centroid with a moment
//! mu N L, where L is the mean distance of its area from the centroid,
//!
//! ```text
//! L = 1/A integral r dA
//! ```
//!
//! Forces at the corners, with shares w_i of the load, resist with mu N sum w_i r_i instead. The
//! torsion ratio, L / sum w_i r_i, scales the distances of the corners so that both agree. The
//! engine has an approximation of its own, which is measured against this one.

use glam::DVec2;

use crate::plan::area;

/// Mean distance of the area of a convex polygon (anticlockwise) from a point in it, m.
///
/// In closed form: over the triangle from the point to an edge at distance h, between the angles a
/// and b from the perpendicular, the integral of r is h³/6 [sec t tan t + asinh tan t] from a to b.
///
/// ```
/// use glam::DVec2;
/// use teeter_study::torsion::{centroid, mean_distance, rectangle_mean_distance};
///
/// let block = [DVec2::ZERO, DVec2::new(0.08, 0.0), DVec2::new(0.08, 0.03), DVec2::new(0.0, 0.03)];
/// let mean = mean_distance(&block, centroid(&block));
/// assert!((mean / rectangle_mean_distance(0.08, 0.03) - 1.0).abs() < 1e-9);
/// ```
pub fn mean_distance(polygon: &[DVec2], from: DVec2) -> f64 {
    let n = polygon.len();
    let part = |i: usize| {
        let (p, q) = (polygon[i] - from, polygon[(i + 1) % n] - from);
        let along = (q - p).normalize_or_zero();
        let h = p.perp_dot(along);
        if h <= 1e-12 {
            return 0.0;
        }
        // tan t at a corner, by its position along the edge
        let of = |corner: DVec2| {
            let tan = corner.dot(along) / h;
            (1.0 + tan * tan).sqrt() * tan + libm::asinh(tan)
        };
        h * h * h / 6.0 * (of(q) - of(p))
    };
    (0..n).map(part).sum::<f64>() / area(polygon)
}

/// Mean distance of the area of a rectangle from its centre, m:
/// d/6 + a²/(12 b) asinh(b/a) + b²/(12 a) asinh(a/b), where d is the diagonal.
///
/// ```
/// let mean = teeter_study::torsion::rectangle_mean_distance(1.0, 1.0);
/// assert!((mean - 0.3826).abs() < 1e-4);
/// ```
pub fn rectangle_mean_distance(a: f64, b: f64) -> f64 {
    let diagonal = (a * a + b * b).sqrt();
    diagonal / 6.0 + a * a / (12.0 * b) * libm::asinh(b / a) + b * b / (12.0 * a) * libm::asinh(a / b)
}

/// Centroid of a polygon, m.
///
/// ```
/// use glam::DVec2;
///
/// let triangle = [DVec2::ZERO, DVec2::new(3.0, 0.0), DVec2::new(0.0, 3.0)];
/// assert!(teeter_study::torsion::centroid(&triangle).distance(DVec2::ONE) < 1e-12);
/// ```
pub fn centroid(polygon: &[DVec2]) -> DVec2 {
    let (n, origin) = (polygon.len(), polygon[0]);
    let moment = |i: usize| {
        let (p, q) = (polygon[i] - origin, polygon[(i + 1) % n] - origin);
        (p + q) * (p.perp_dot(q) / 6.0)
    };
    origin + (0..n).map(moment).sum::<DVec2>() / area(polygon)
}

/// Ratio of the torsional friction of a patch under uniform pressure to that of forces at its
/// corners. The share of a corner is half of the two triangles between it, its neighbours and the
/// centroid.
///
/// ```
/// use glam::DVec2;
///
/// let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
/// assert!((teeter_study::torsion::torsion_ratio(&square) - 0.5411).abs() < 1e-4);
/// ```
pub fn torsion_ratio(polygon: &[DVec2]) -> f64 {
    let (n, center) = (polygon.len(), centroid(polygon));
    let triangle = |i: usize| 0.5 * (polygon[i] - center).perp_dot(polygon[(i + 1) % n] - center);
    let corner = |i: usize| 0.5 * (triangle((i + n - 1) % n) + triangle(i)) * polygon[i].distance(center);
    mean_distance(polygon, center) / ((0..n).map(corner).sum::<f64>() / area(polygon))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(a: f64, b: f64) -> [DVec2; 4] {
        [DVec2::ZERO, DVec2::new(a, 0.0), DVec2::new(a, b), DVec2::new(0.0, b)]
    }

    #[test]
    fn the_mean_distance_is_that_of_a_grid_of_points() {
        let shapes: [&[DVec2]; 3] = [
            &rectangle(0.081, 0.0268),
            &[DVec2::ZERO, DVec2::new(0.03, 0.0), DVec2::new(0.01, 0.02)],
            &[
                DVec2::new(1.0, 0.0),
                DVec2::new(3.0, 0.5),
                DVec2::new(3.5, 2.0),
                DVec2::new(2.0, 3.0),
                DVec2::new(0.5, 2.0),
            ],
        ];
        for polygon in shapes {
            let center = centroid(polygon);
            let (low, high) = polygon.iter().fold((polygon[0], polygon[0]), |(l, h), p| (l.min(*p), h.max(*p)));
            let n = 1500;
            let point =
                |i: usize| low + (high - low) * DVec2::new((i % n) as f64 + 0.5, (i / n) as f64 + 0.5) / n as f64;
            let inside = |p: &DVec2| {
                (0..polygon.len()).all(|i| {
                    let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                    (b - a).perp_dot(*p - a) >= 0.0
                })
            };
            let (mut count, mut distance, mut sum) = (0.0, 0.0, DVec2::ZERO);
            for p in (0..n * n).map(point).filter(inside) {
                count += 1.0;
                distance += p.distance(center);
                sum += p;
            }
            assert!((sum / count).distance(center) < 2e-3 * (high - low).length());
            let exact = mean_distance(polygon, center);
            assert!((distance / count / exact - 1.0).abs() < 1e-3, "{exact} instead of {}", distance / count);
        }
    }

    #[test]
    fn the_two_forms_agree_on_rectangles() {
        for (a, b) in [(1.0, 1.0), (0.081, 0.0268), (0.0268, 1e-4)] {
            let polygon = rectangle(a, b);
            let general = mean_distance(&polygon, centroid(&polygon));
            assert!((general / rectangle_mean_distance(a, b) - 1.0).abs() < 1e-9);
        }
    }

    /// A square has (sqrt 2 + asinh 1) / (3 sqrt 2). A thin strip is a line, whose ends are twice
    /// as far from its centre as the mean.
    #[test]
    fn the_torsion_ratio_of_a_square_and_of_a_strip_is_exact() {
        let square = (std::f64::consts::SQRT_2 + libm::asinh(1.0)) / (3.0 * std::f64::consts::SQRT_2);
        assert!((torsion_ratio(&rectangle(1.0, 1.0)) - square).abs() < 1e-12 && (square - 0.5411).abs() < 1e-4);
        assert!((torsion_ratio(&rectangle(1.0, 1e-5)) - 0.5).abs() < 1e-4);
    }
}
