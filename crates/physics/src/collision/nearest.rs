//! Nearest points of two separated boxes.

use glam::{DMat3, DVec3};

use crate::collision::cuboid::Cuboid;
use crate::constants::MIN_EDGE_SINE;

/// Feature of a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// Face across an axis.
    Face(usize),
    /// Edge along an axis.
    Edge(usize),
    /// Corner.
    Corner,
}

/// Nearest points of two boxes.
#[derive(Debug, Clone, Copy)]
pub struct Nearest {
    /// Points on the two boxes, m.
    pub points: [DVec3; 2],
    /// Features of the boxes on which they lie.
    pub features: [Feature; 2],
    /// Direction from the first point to the second.
    pub normal: DVec3,
    /// Distance, m.
    pub distance: f64,
}

/// Relative shortfall of a separation along the normal that rounding explains: of parallel edges
/// with ends side by side any may be nearest, and the normal leans towards the next by rounding
/// over distance.
const ROUNDING: f64 = 1e-2;

/// Best pair of points so far.
struct Search {
    square: f64,
    points: [DVec3; 2],
    features: [Feature; 2],
}

/// Returns the nearest points of two boxes; none where they overlap.
///
/// They are a corner and a point of the other box, or points of two edges. Two convex bodies are as
/// far apart as the planes through their nearest points: where the boxes are not separated by as
/// much along the normal, they overlap elsewhere.
pub fn nearest(a: &Cuboid, b: &Cuboid) -> Option<Nearest> {
    let mut search =
        Search { square: f64::INFINITY, points: [DVec3::ZERO; 2], features: [Feature::Corner, Feature::Corner] };
    search.corners(a, b, false);
    search.corners(b, a, true);
    search.edges(a, b);
    let offset = search.points[1] - search.points[0];
    let distance = offset.length();
    let normal = offset.try_normalize()?;
    let extent = |c: &Cuboid| (c.axes.transpose() * normal).abs().dot(c.half);
    let separation = (b.center - a.center).dot(normal) - extent(a) - extent(b);
    if separation < distance * (1.0 - ROUNDING) - 1e-9 {
        return None;
    }
    Some(Nearest { points: search.points, features: search.features, normal, distance })
}

impl Search {
    /// Considers the corners of `b` and the points of `a` nearest to them; `swapped` where `b` is
    /// the first box.
    fn corners(&mut self, a: &Cuboid, b: &Cuboid, swapped: bool) {
        let inverse = a.axes.transpose();
        let center = inverse * (b.center - a.center);
        let edges =
            inverse * DMat3::from_cols(b.axes.x_axis * b.half.x, b.axes.y_axis * b.half.y, b.axes.z_axis * b.half.z);
        for i in 0..8 {
            let sign = |k: usize| if i >> k & 1 == 1 { 1.0 } else { -1.0 };
            let corner = center + edges.x_axis * sign(0) + edges.y_axis * sign(1) + edges.z_axis * sign(2);
            let on_a = corner.clamp(-a.half, a.half);
            let square = (corner - on_a).length_squared();
            if square >= self.square {
                continue;
            }
            self.square = square;
            let points = [a.center + a.axes * on_a, a.center + a.axes * corner];
            let features = [feature(corner - on_a), Feature::Corner];
            self.points = if swapped { [points[1], points[0]] } else { points };
            self.features = if swapped { [features[1], features[0]] } else { features };
        }
    }

    /// Considers pairs of edges that are nearest between their ends.
    fn edges(&mut self, a: &Cuboid, b: &Cuboid) {
        let offset = b.center - a.center;
        for i in 0..3 {
            for j in 0..3 {
                let (d, e) = (a.axes.col(i), b.axes.col(j));
                let across = d.cross(e);
                let square = across.length_squared();
                if square < MIN_EDGE_SINE * MIN_EDGE_SINE {
                    continue;
                }
                let across = if across.dot(offset) < 0.0 { -across } else { across };
                let (p, q) = (a.farthest_edge(i, across), b.farthest_edge(j, -across));
                let w = q - p;
                let separation = w.dot(across);
                // Distance of the lines; only a separation can be the distance of the boxes.
                if separation <= 0.0 || separation * separation >= self.square * square {
                    continue;
                }
                let cosine = d.dot(e);
                let s = (w.dot(d) - cosine * w.dot(e)) / square;
                let t = (cosine * w.dot(d) - w.dot(e)) / square;
                if s.abs() > a.half[i] || t.abs() > b.half[j] {
                    continue;
                }
                self.square = separation * separation / square;
                self.points = [p + d * s, q + e * t];
                self.features = [Feature::Edge(i), Feature::Edge(j)];
            }
        }
    }
}

/// Feature of a box to which a point outside of it is nearest, from the offset of the two along the
/// box's axes.
fn feature(offset: DVec3) -> Feature {
    let outside = [0, 1, 2].map(|k| offset[k] != 0.0);
    match outside {
        [true, false, false] => Feature::Face(0),
        [false, true, false] => Feature::Face(1),
        [false, false, true] => Feature::Face(2),
        [false, true, true] => Feature::Edge(0),
        [true, false, true] => Feature::Edge(1),
        [true, true, false] => Feature::Edge(2),
        _ => Feature::Corner,
    }
}
