//! Contacts of edges and corners: of rounded boxes whose cores are apart, and of the crossing edges
//! of boxes whose cores overlap.

use arrayvec::ArrayVec;
use glam::DVec3;

use crate::collision::cuboid::Cuboid;
use crate::collision::manifold::{ContactPoint, MAX_POINTS, Manifold, arm};
use crate::collision::nearest::{Feature, Nearest};
use crate::collision::polygon::{LINE_TORSION_RATIO, Patch};
use crate::constants::{EDGE_AREA, MIN_EDGE_SINE};

/// Pairs of points on two boxes, in the world, m.
type Pairs = ArrayVec<[DVec3; 2], 2>;

/// Shortest interval that two parallel edges share, over the middle edge of a box: below it they
/// touch in one point.
const MIN_INTERVAL: f64 = 4e-3;

/// Largest cosine of the angle between the normal and edges that touch along their length.
const MAX_ALONG: f64 = 0.05;

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
    let (a, b) = (&a.core(), &b.core());
    let may_be = |feature, axis| feature == Feature::Corner || feature == Feature::Edge(axis);
    let [on_a, on_b] = nearest.features;
    let across = |c: &Cuboid, axis: usize| nearest.normal.dot(c.axes.col(axis)).abs() < MAX_ALONG;
    for i in (0..3).filter(|&i| may_be(on_a, i) && across(a, i)) {
        for j in (0..3).filter(|&j| may_be(on_b, j) && across(b, j)) {
            if let Some(ends) = shared_ends((a, i), (b, j), nearest.points) {
                return Pairs::from(ends);
            }
        }
    }
    Pairs::from_iter([nearest.points])
}

/// Ends of the interval that an edge of `a` along axis `i` and one of `b` along axis `j` share, as
/// points of both; none where they are not parallel, or share too little. The edges pass through
/// the points given.
fn shared_ends((a, i): (&Cuboid, usize), (b, j): (&Cuboid, usize), [p, q]: [DVec3; 2]) -> Option<[[DVec3; 2]; 2]> {
    let (d, e) = (a.axes.col(i), b.axes.col(j));
    if d.cross(e).length_squared() > MIN_EDGE_SINE * MIN_EDGE_SINE {
        return None;
    }
    let cosine = d.dot(e);
    // Positions along the edge of `a`, from its middle.
    let (at, other) = ((p - a.center).dot(d), (q - a.center).dot(d));
    let middle = other - (q - b.center).dot(e) * cosine;
    let half = b.half[j] * cosine.abs();
    let (low, high) = ((middle - half).max(-a.half[i]), (middle + half).min(a.half[i]));
    if high - low < MIN_INTERVAL * a.middle_edge().min(b.middle_edge()) {
        return None;
    }
    Some([low, high].map(|end| [p + d * (end - at), q + e * ((end - other) / cosine)]))
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
    let frame = a.contact_frame(normal, (in_a * normal).abs().min_position());
    let centroid = in_a * (pairs.iter().map(|[on_a, _]| *on_a).sum::<DVec3>() * share - a.center);
    let points = pairs.iter().map(|[on_a, on_b]| {
        let anchor_a = in_a * (*on_a - a.center);
        ContactPoint {
            anchor_a,
            anchor_b: in_b * (*on_b - b.center),
            arm: arm(anchor_a, &frame, centroid),
            weight: share,
            gap: normal.dot(*on_b - *on_a),
            ..ContactPoint::default()
        }
    });
    to.set([a.body, b.body], (frame, centroid), &patch, points);
}
