//! Contacts of edges and corners: of rounded boxes whose cores are apart, and of the crossing edges
//! of boxes whose cores overlap.

use arrayvec::ArrayVec;
use glam::DVec3;

use crate::collision::cuboid::Cuboid;
use crate::collision::manifold::{ContactPoint, MAX_POINTS, Manifold};
use crate::collision::nearest::{Feature, Nearest};
use crate::collision::polygon::{LINE_TORSION_RATIO, Patch};
use crate::constants::{EDGE_AREA, MIN_EDGE_SINE};

/// Pairs of points on two boxes, in the world, m.
type Pairs = ArrayVec<[DVec3; 2], 2>;

/// Shortest interval that two parallel edges share, over the middle edge of a box: below it they
/// touch in one point.
const MIN_INTERVAL: f64 = 4e-3;

/// Sets the manifold of edges or corners of two rounded boxes from the nearest points of their
/// cores. The normal leads from one core to the other, and the separation is their distance less
/// both radii.
pub fn round_contact(a: &Cuboid, b: &Cuboid, nearest: &Nearest, to: &mut Manifold) {
    let on_surface = |[p, q]: [DVec3; 2]| [p + nearest.normal * a.radius, q - nearest.normal * b.radius];
    set_points(a, b, nearest.normal, &common_interval(a, b, nearest).into_iter().map(on_surface).collect(), to);
}

/// Nearest points of two cores; two pairs of them, at the ends of the interval that the edges
/// share, where these are parallel.
fn common_interval(a: &Cuboid, b: &Cuboid, nearest: &Nearest) -> Pairs {
    let pairs = match nearest.features {
        [Feature::Edge(i), Feature::Corner] => along_edge(&a.core(), i, &b.core(), nearest.points),
        [Feature::Corner, Feature::Edge(j)] => {
            let [p, q] = nearest.points;
            along_edge(&b.core(), j, &a.core(), [q, p]).map(|ends| ends.map(|[q, p]| [p, q]))
        }
        _ => None,
    };
    pairs.map_or_else(|| Pairs::from_iter([nearest.points]), Pairs::from)
}

/// Ends of the interval that the edge of `a` along axis `i` shares with a parallel edge of `b`, as
/// points of `a` and of `b`; none where no edge of `b` at the corner is parallel, or the interval
/// is short. The edges pass through the two points given, the second being a corner.
fn along_edge(a: &Cuboid, i: usize, b: &Cuboid, [p, q]: [DVec3; 2]) -> Option<[[DVec3; 2]; 2]> {
    let d = a.axes.col(i);
    let j = (0..3).find(|&j| d.cross(b.axes.col(j)).length_squared() < MIN_EDGE_SINE * MIN_EDGE_SINE)?;
    let e = b.axes.col(j);
    let cosine = d.dot(e);
    // Positions along the edge of `a`, from its middle.
    let (at, corner) = ((p - a.center).dot(d), (q - a.center).dot(d));
    let other = corner - 2.0 * b.half[j] * cosine * (q - b.center).dot(e).signum();
    let low = corner.min(other).max(-a.half[i]);
    let high = corner.max(other).min(a.half[i]);
    if high - low < MIN_INTERVAL * a.middle_edge().min(b.middle_edge()) {
        return None;
    }
    Some([low, high].map(|end| [p + d * (end - at), q + e * ((end - corner) / cosine)]))
}

/// Sets the manifold of two crossing edges, which has a single point.
pub fn crossing_edges(a: &Cuboid, b: &Cuboid, pair: usize, normal: DVec3, to: &mut Manifold) {
    let (i, j) = (pair / 3, pair % 3);
    let (p, q) = (a.farthest_edge(i, normal), b.farthest_edge(j, -normal));
    let (d, e) = (a.axes.col(i), b.axes.col(j));
    // Closest points of the lines p + s d and q + t e with unit directions.
    let w = q - p;
    let cosine = d.dot(e);
    let inv = 1.0 / (1.0 - cosine * cosine);
    let s = ((w.dot(d) - cosine * w.dot(e)) * inv).clamp(-a.half[i], a.half[i]);
    let t = ((cosine * w.dot(d) - w.dot(e)) * inv).clamp(-b.half[j], b.half[j]);
    set_points(a, b, normal, &Pairs::from_iter([[p + d * s, q + e * t]]), to);
}

/// Sets the manifold of one or two pairs of points on the surfaces. The area of the patch is that
/// of an edge of the smaller box.
fn set_points(a: &Cuboid, b: &Cuboid, normal: DVec3, pairs: &Pairs, to: &mut Manifold) {
    let edge = a.middle_edge().min(b.middle_edge());
    let share = 1.0 / pairs.len() as f64;
    let patch = Patch {
        area: EDGE_AREA * edge * edge,
        centroid: [0.0; 2],
        shares: [share; MAX_POINTS],
        torsion_ratio: LINE_TORSION_RATIO,
    };
    let (in_a, in_b) = (a.axes.transpose(), b.axes.transpose());
    let frame = a.contact_frame(normal, least_axis(in_a * normal));
    let centroid = in_a * (pairs.iter().map(|[on_a, _]| *on_a).sum::<DVec3>() * share - a.center);
    let points = pairs.iter().map(|[on_a, on_b]| {
        let anchor_a = in_a * (*on_a - a.center);
        let arm = anchor_a - centroid;
        ContactPoint {
            anchor_a,
            anchor_b: in_b * (*on_b - b.center),
            arm: [arm.dot(frame[1]), arm.dot(frame[2])],
            weight: share,
            gap: normal.dot(*on_b - *on_a),
            ..ContactPoint::default()
        }
    });
    to.set([a.body, b.body], (frame, centroid), &patch, points);
}

/// Axis along which a direction has its smallest component.
fn least_axis(direction: DVec3) -> usize {
    let size = direction.abs();
    if size.x <= size.y && size.x <= size.z {
        0
    } else if size.y <= size.z {
        1
    } else {
        2
    }
}
