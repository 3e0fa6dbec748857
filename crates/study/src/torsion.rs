//! Torsional friction of a patch of contact.
//!
//! Under a uniform pressure a patch of area A resists turning about its centroid with mu N L, where L is the mean distance of its area from the centroid,
//!
//! ```text
//! L = 1/A integral r dA
//! ```
//!
//! Forces at the corners, with their shares w_i of the load, resist with mu N sum w_i r_i instead. What makes the second the first is the ratio of the two,
//! the lever by which the distances of the corners are to be multiplied. The engine has a form of its own of it, which is measured against this one.

use glam::DVec2;

use crate::plan::area;

/// Mean distance of the area of a convex polygon (anticlockwise) from a point in it, m. In closed form: over the triangle from the point to an edge at
/// distance h, seen from the angle a to b off the perpendicular, the integral of r is h³/6 [sec t tan t + asinh tan t] from a to b.
pub fn mean_distance(polygon: &[DVec2], from: DVec2) -> f64 {
    let n = polygon.len();
    let part = |i: usize| {
        let (p, q) = (polygon[i] - from, polygon[(i + 1) % n] - from);
        let along = (q - p).normalize_or_zero();
        let h = p.perp_dot(along);
        if h <= 1e-12 {
            return 0.0;
        }
        // tan t at a corner, by its place along the edge
        let of = |corner: DVec2| {
            let tan = corner.dot(along) / h;
            (1.0 + tan * tan).sqrt() * tan + libm::asinh(tan)
        };
        h * h * h / 6.0 * (of(q) - of(p))
    };
    (0..n).map(part).sum::<f64>() / area(polygon)
}

/// Mean distance of the area of a rectangle from its centre, m: d/6 + a²/(12 b) asinh(b/a) + b²/(12 a) asinh(a/b), where d is the diagonal.
pub fn rectangle_mean_distance(a: f64, b: f64) -> f64 {
    let diagonal = (a * a + b * b).sqrt();
    diagonal / 6.0 + a * a / (12.0 * b) * libm::asinh(b / a) + b * b / (12.0 * a) * libm::asinh(a / b)
}

/// Centroid of a polygon, m.
pub fn centroid(polygon: &[DVec2]) -> DVec2 {
    let (n, origin) = (polygon.len(), polygon[0]);
    let moment = |i: usize| {
        let (p, q) = (polygon[i] - origin, polygon[(i + 1) % n] - origin);
        (p + q) * (p.perp_dot(q) / 6.0)
    };
    origin + (0..n).map(moment).sum::<DVec2>() / area(polygon)
}

/// By how much the distances of the corners from the centroid are to be multiplied so that their torsional friction is that of a uniform pressure. A corner has
/// half of the two triangles between it, its neighbours and the centroid as its share.
pub fn lever(polygon: &[DVec2]) -> f64 {
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
    fn the_mean_distance_is_that_of_many_points() {
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
            let place =
                |i: usize| low + (high - low) * DVec2::new((i % n) as f64 + 0.5, (i / n) as f64 + 0.5) / n as f64;
            let inside = |p: &DVec2| {
                (0..polygon.len()).all(|i| {
                    let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                    (b - a).perp_dot(*p - a) >= 0.0
                })
            };
            let (mut count, mut distance, mut middle) = (0.0, 0.0, DVec2::ZERO);
            for p in (0..n * n).map(place).filter(inside) {
                count += 1.0;
                distance += p.distance(center);
                middle += p;
            }
            assert!((middle / count).distance(center) < 2e-3 * (high - low).length());
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

    /// A square has (sqrt 2 + asinh 1) / (3 sqrt 2), a thin strip one half: it is a line, of which the ends are twice as far as the mean.
    #[test]
    fn levers_of_squares_and_strips() {
        let square = (std::f64::consts::SQRT_2 + libm::asinh(1.0)) / (3.0 * std::f64::consts::SQRT_2);
        assert!((lever(&rectangle(1.0, 1.0)) - square).abs() < 1e-12 && (square - 0.5411).abs() < 1e-4);
        assert!((lever(&rectangle(1.0, 1e-5)) - 0.5).abs() < 1e-4);
    }
}
