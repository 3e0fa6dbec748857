//! Box against box and box against floor: the separating axis test, then clipping of face against face.
//!
//! Crossed blocks touch edge against edge at the corners of their overlap; only clipping finds these.

#[cfg(test)]
mod tests;

use glam::{DMat3, DVec3};

use crate::body::FLOOR;
use crate::constants::{
    AXIS_HYSTERESIS, CORNER_MERGE, EDGE_AREA, EDGE_PREFERENCE, LEAST_EDGE_SINE, LEAST_EDGE_TILT, REFERENCE_AREA,
};
use crate::manifold::{Axis, MAX_POINTS, Manifold, Point};
use crate::polygon::{Corner, LINE_LEVER, Patch, clip, merge, patch};

/// What an edge crossing an edge counts as.
const EDGE: Patch =
    Patch { area: EDGE_AREA * REFERENCE_AREA, centroid: [0.0; 2], shares: [1.0; MAX_POINTS], lever: LINE_LEVER };

/// A box in the world.
#[derive(Debug, Clone, Copy)]
pub struct Cuboid {
    /// Index of the body.
    pub body: u32,
    /// Centre, m.
    pub center: DVec3,
    /// Its axes as columns.
    pub axes: DMat3,
    /// Half edge lengths, m.
    pub half: DVec3,
}

/// The best separating axis of two boxes: normal from the first to the second, and the separation along it, m.
#[derive(Debug, Clone, Copy)]
pub struct Separation {
    pub axis: Axis,
    pub normal: DVec3,
    pub distance: f64,
}

/// The axis that separates two boxes best, with a preference for faces and for the axis of the last detection; none where some
/// axis separates them by more than `limit`.
pub fn separation(low: &Cuboid, high: &Cuboid, limit: f64, last: Option<Axis>) -> Option<Separation> {
    let offset = high.center - low.center;
    // m.col(j)[i] = a_i . b_j
    let m = low.axes.transpose() * high.axes;
    let abs = DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs());
    let in_low = low.axes.transpose() * offset;
    let in_high = high.axes.transpose() * offset;

    // merit, axis, distance, and on which side of the first the second is; the best of the faces and the best of the edges
    let mut faces = (f64::NEG_INFINITY, Axis::FaceLow(0), 0.0, 0.0);
    let mut edges = faces;
    let consider = |best: &mut (f64, Axis, f64, f64), axis: Axis, along: f64, distance: f64, handicap: f64| {
        let merit = distance - handicap + if last == Some(axis) { AXIS_HYSTERESIS } else { 0.0 };
        if merit > best.0 {
            *best = (merit, axis, distance, along);
        }
    };

    let reach = low.half + abs * high.half;
    for i in 0..3 {
        let distance = in_low[i].abs() - reach[i];
        if distance > limit {
            return None;
        }
        consider(&mut faces, Axis::FaceLow(i as u8), in_low[i], distance, 0.0);
    }
    let reach = high.half + abs.transpose() * low.half;
    for j in 0..3 {
        let distance = in_high[j].abs() - reach[j];
        if distance > limit {
            return None;
        }
        consider(&mut faces, Axis::FaceHigh(j as u8), in_high[j], distance, 0.0);
    }
    for i in 0..3 {
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        for j in 0..3 {
            let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
            let cosine = m.col(j)[i];
            let square = 1.0 - cosine * cosine;
            if square < LEAST_EDGE_SINE * LEAST_EDGE_SINE {
                continue;
            }
            // all along a_i x b_j, whose length is the sine (Gottschalk, Lin and Manocha, OBBTree, 1996)
            let along = in_low[i2] * m.col(j)[i1] - in_low[i1] * m.col(j)[i2];
            let reach_low = low.half[i1] * abs.col(j)[i2] + low.half[i2] * abs.col(j)[i1];
            let reach_high = high.half[j1] * abs.col(j2)[i] + high.half[j2] * abs.col(j1)[i];
            let over = along.abs() - reach_low - reach_high;
            // where boxes overlap the division makes it less, never more: what is behind the best already stays so
            if over < 0.0 && over - EDGE_PREFERENCE + AXIS_HYSTERESIS <= faces.0.max(edges.0) {
                continue;
            }
            let distance = over / square.sqrt();
            if distance > limit {
                return None;
            }
            consider(&mut edges, Axis::Edges((3 * i + j) as u8), along, distance, EDGE_PREFERENCE);
        }
    }
    let found = |(_, axis, distance, along): (f64, Axis, f64, f64)| {
        let normal = match axis {
            Axis::FaceLow(i) => low.axes.col(i as usize),
            Axis::FaceHigh(j) => high.axes.col(j as usize),
            Axis::Edges(pair) => low.axes.col(pair as usize / 3).cross(high.axes.col(pair as usize % 3)).normalize(),
        };
        Separation { axis, normal: if along < 0.0 { -normal } else { normal }, distance }
    };
    let face = found(faces);
    if edges.0 > faces.0 {
        let edge = found(edges);
        if edge.normal.cross(face.normal).length_squared() > LEAST_EDGE_TILT * LEAST_EDGE_TILT {
            return Some(edge);
        }
    }
    Some(face)
}

/// How two boxes are to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meeting {
    /// Out of reach.
    Apart,
    /// At least so far apart (m), and no part of one before a face of the other: they may yet meet with their edges.
    Near(f64),
    /// In reach: they have a manifold.
    Touching,
}

/// How two boxes are to each other, `low` having the lower index; they are apart where some axis separates them by more than
/// `limit` (m). Where they touch, `to` becomes their manifold: it is a kilobyte, which is made where it is wanted.
pub fn box_box(low: &Cuboid, high: &Cuboid, limit: f64, last: Option<Axis>, to: &mut Manifold) -> Meeting {
    let Some(found) = separation(low, high, limit, last) else { return Meeting::Apart };
    to.axis = found.axis;
    let touching = match found.axis {
        Axis::FaceLow(i) => face_manifold(low, high, i as usize, found.normal, to),
        Axis::FaceHigh(j) => face_manifold(high, low, j as usize, -found.normal, to),
        Axis::Edges(pair) => {
            edge_manifold(low, high, pair as usize, found.normal, to);
            true
        }
    };
    if touching { Meeting::Touching } else { Meeting::Near(found.distance) }
}

/// Right-handed frame in A's coordinates from a normal in the world and an axis of A that is not parallel to it.
fn frame(a: &Cuboid, normal: DVec3, along: usize) -> [DVec3; 3] {
    let n = a.axes.transpose() * normal;
    let mut t = DVec3::ZERO;
    t[along] = 1.0;
    let t1 = (t - n * n.dot(t)).normalize();
    [n, t1, n.cross(t1)]
}

/// Clips the face of `b` that looks most against `normal` (out of face `axis` of `a`) by that face; false where nothing of it is left.
fn face_manifold(a: &Cuboid, b: &Cuboid, axis: usize, normal: DVec3, to: &mut Manifold) -> bool {
    let (iu, iv) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = (a.axes.col(iu), a.axes.col(iv));
    let plane = a.center + normal * a.half[axis];

    let facing = b.axes.transpose() * normal;
    let size = facing.abs();
    let k = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let outward = if facing[k] > 0.0 { -1.0 } else { 1.0 };
    let face = b.center + b.axes.col(k) * (outward * b.half[k]);
    let (ip, iq) = ((k + 1) % 3, (k + 2) % 3);
    let (p, q) = (b.axes.col(ip) * b.half[ip], b.axes.col(iq) * b.half[iq]);
    let corner = |x: DVec3| {
        let d = x - plane;
        Corner { u: d.dot(u), v: d.dot(v), gap: d.dot(normal) }
    };
    let corners = [corner(face + p + q), corner(face - p + q), corner(face - p - q), corner(face + p - q)];

    let mut polygon = clip(&corners, a.half[iu], a.half[iv]);
    merge(&mut polygon, CORNER_MERGE);
    if polygon.is_empty() {
        return false;
    }
    let patch = patch(&polygon);
    let local = |u: f64, v: f64| {
        let mut x = DVec3::ZERO;
        x[axis] = normal.dot(a.axes.col(axis)).signum() * a.half[axis];
        x[iu] = u;
        x[iv] = v;
        x
    };
    let frame = frame(a, normal, iu);
    let centroid = local(patch.centroid[0], patch.centroid[1]);
    let inverse = b.axes.transpose();
    let points = polygon.iter().zip(patch.shares).map(|(c, weight)| {
        let anchor_a = local(c.u, c.v);
        let on_b = plane + u * c.u + v * c.v + normal * c.gap;
        let arm = anchor_a - centroid;
        Point {
            anchor_a,
            anchor_b: inverse * (on_b - b.center),
            arm: [arm.dot(frame[1]), arm.dot(frame[2])],
            weight,
            gap: c.gap,
            ..Point::default()
        }
    });
    to.set([a.body, b.body], frame, centroid, &patch, points);
    true
}

/// The one point between two crossing edges.
fn edge_manifold(a: &Cuboid, b: &Cuboid, pair: usize, normal: DVec3, to: &mut Manifold) {
    let (i, j) = (pair / 3, pair % 3);
    // middle of the edge of a box that lies farthest along a direction
    let edge = |c: &Cuboid, along: usize, direction: DVec3| {
        let toward = c.axes.transpose() * direction;
        let mut local = DVec3::ZERO;
        for k in 0..3 {
            if k != along {
                local[k] = if toward[k] >= 0.0 { c.half[k] } else { -c.half[k] };
            }
        }
        c.center + c.axes * local
    };
    let (p, q) = (edge(a, i, normal), edge(b, j, -normal));
    let (d, e) = (a.axes.col(i), b.axes.col(j));
    // closest points of two lines p + s d, q + t e with unit directions
    let w = q - p;
    let cosine = d.dot(e);
    let inv = 1.0 / (1.0 - cosine * cosine);
    let s = ((w.dot(d) - cosine * w.dot(e)) * inv).clamp(-a.half[i], a.half[i]);
    let t = ((cosine * w.dot(d) - w.dot(e)) * inv).clamp(-b.half[j], b.half[j]);
    let (on_a, on_b) = (p + d * s, q + e * t);
    let anchor_a = a.axes.transpose() * (on_a - a.center);
    let point = Point {
        anchor_a,
        anchor_b: b.axes.transpose() * (on_b - b.center),
        weight: 1.0,
        gap: normal.dot(on_b - on_a),
        ..Point::default()
    };
    to.set([a.body, b.body], frame(a, normal, i), anchor_a, &EDGE, [point]);
}

/// How a box is to the floor z = 0, which it touches with the corners of its lowest face; it is apart where it is higher than `limit` (m).
pub fn box_floor(b: &Cuboid, limit: f64, last: Option<Axis>, to: &mut Manifold) -> Meeting {
    let up = b.axes.transpose() * DVec3::Z;
    if b.center.z - up.abs().dot(b.half) > limit {
        return Meeting::Apart;
    }
    let mut k = 0;
    let mut best = f64::NEG_INFINITY;
    for i in 0..3 {
        // a box balanced on an edge stays on the face it was on
        let merit = up[i].abs() + if last == Some(Axis::FaceHigh(i as u8)) { 0.01 } else { 0.0 };
        if merit > best {
            best = merit;
            k = i;
        }
    }
    let outward = if up[k] > 0.0 { -1.0 } else { 1.0 };
    let (ip, iq) = ((k + 1) % 3, (k + 2) % 3);
    let mut center = DVec3::ZERO;
    center[k] = outward * b.half[k];
    let sides = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let patch = patch(&sides.map(|(x, y)| Corner { u: x * b.half[ip], v: y * b.half[iq], gap: 0.0 }));
    let ground = |local: DVec3| {
        let x = b.center + b.axes * local;
        DVec3::new(x.x, x.y, 0.0)
    };
    let centroid = ground(center);
    let points = sides.iter().map(|(x, y)| {
        let mut anchor_b = center;
        anchor_b[ip] = x * b.half[ip];
        anchor_b[iq] = y * b.half[iq];
        let x = b.center + b.axes * anchor_b;
        let anchor_a = DVec3::new(x.x, x.y, 0.0);
        let arm = anchor_a - centroid;
        Point { anchor_a, anchor_b, arm: [arm.x, arm.y], weight: 0.25, gap: x.z, ..Point::default() }
    });
    to.axis = Axis::FaceHigh(k as u8);
    to.set([FLOOR, b.body], [DVec3::Z, DVec3::X, DVec3::Y], centroid, &patch, points);
    Meeting::Touching
}
