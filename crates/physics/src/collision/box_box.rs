//! Box against box and box against floor: separating axis test, then clipping of face against face.
//!
//! Crossed blocks touch edge against edge at the corners of their overlap; only clipping finds
//! these points.

#[cfg(test)]
mod tests;

use glam::{DMat3, DVec3};

use crate::body::FLOOR;
use crate::collision::manifold::{ContactPoint, MAX_POINTS, Manifold, SeparatingAxis};
use crate::collision::polygon::{Corner, LINE_TORSION_RATIO, Patch, clip, merge};
use crate::constants::{
    AXIS_HYSTERESIS, CORNER_MERGE, EDGE_AREA, EDGE_PREFERENCE, MIN_EDGE_SINE, MIN_EDGE_TILT, REFERENCE_AREA,
};

/// Patch of two crossing edges.
const EDGE_PATCH: Patch = Patch {
    area: EDGE_AREA * REFERENCE_AREA,
    centroid: [0.0; 2],
    shares: [1.0; MAX_POINTS],
    torsion_ratio: LINE_TORSION_RATIO,
};

/// Oriented box in the world.
#[derive(Debug, Clone, Copy)]
pub struct Cuboid {
    /// Index of the body.
    pub body: u32,
    /// Centre, m.
    pub center: DVec3,
    /// Axes of the box, as columns.
    pub axes: DMat3,
    /// Half edge lengths, m.
    pub half: DVec3,
}

/// Result of the separating axis test: normal from the first box to the second, and separation
/// along it, m.
#[derive(Debug, Clone, Copy)]
pub struct Separation {
    pub axis: SeparatingAxis,
    pub normal: DVec3,
    pub distance: f64,
}

/// Best axis so far in a separating axis test.
#[derive(Clone, Copy)]
struct Candidate {
    /// Separation with preference and hysteresis, m.
    merit: f64,
    axis: SeparatingAxis,
    /// Separation, m.
    distance: f64,
    /// Offset of the second box along the axis, of which only the sign is used.
    offset: f64,
}

/// Separating axis test of two boxes.
struct AxisTest<'a> {
    low: &'a Cuboid,
    high: &'a Cuboid,
    limit: f64,
    last: Option<SeparatingAxis>,
    /// Dot products of the axes: `dots.col(j)[i]` = a_i . b_j, and their absolute values.
    dots: DMat3,
    abs: DMat3,
    /// Offset of the centres along the axes of each box, m.
    in_low: DVec3,
    in_high: DVec3,
}

impl<'a> AxisTest<'a> {
    #[inline]
    fn new(low: &'a Cuboid, high: &'a Cuboid, limit: f64, last: Option<SeparatingAxis>) -> Self {
        let offset = high.center - low.center;
        let dots = low.axes.transpose() * high.axes;
        Self {
            low,
            high,
            limit,
            last,
            dots,
            abs: DMat3::from_cols(dots.x_axis.abs(), dots.y_axis.abs(), dots.z_axis.abs()),
            in_low: low.axes.transpose() * offset,
            in_high: high.axes.transpose() * offset,
        }
    }

    /// Replaces `best` by an axis of higher merit.
    #[inline]
    fn consider(&self, best: &mut Candidate, axis: SeparatingAxis, offset: f64, (distance, handicap): (f64, f64)) {
        let merit = distance - handicap + if self.last == Some(axis) { AXIS_HYSTERESIS } else { 0.0 };
        if merit > best.merit {
            *best = Candidate { merit, axis, distance, offset };
        }
    }

    /// Best face axis; none where a face axis separates the boxes by more than the limit.
    #[inline]
    fn faces(&self) -> Option<Candidate> {
        let axis = SeparatingAxis::FaceLow(0);
        let mut best = Candidate { merit: f64::NEG_INFINITY, axis, distance: 0.0, offset: 0.0 };
        let reach = self.low.half + self.abs * self.high.half;
        for i in 0..3 {
            let distance = self.in_low[i].abs() - reach[i];
            if distance > self.limit {
                return None;
            }
            self.consider(&mut best, SeparatingAxis::FaceLow(i as u8), self.in_low[i], (distance, 0.0));
        }
        let reach = self.high.half + self.abs.transpose() * self.low.half;
        for j in 0..3 {
            let distance = self.in_high[j].abs() - reach[j];
            if distance > self.limit {
                return None;
            }
            self.consider(&mut best, SeparatingAxis::FaceHigh(j as u8), self.in_high[j], (distance, 0.0));
        }
        Some(best)
    }

    /// Best edge axis; none where an edge axis separates the boxes by more than the limit.
    #[inline]
    fn edges(&self, faces: &Candidate) -> Option<Candidate> {
        let axis = SeparatingAxis::FaceLow(0);
        let mut best = Candidate { merit: f64::NEG_INFINITY, axis, distance: 0.0, offset: 0.0 };
        let (low, high, dots, abs) = (self.low, self.high, &self.dots, &self.abs);
        for i in 0..3 {
            let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
                let cosine = dots.col(j)[i];
                let square = 1.0 - cosine * cosine;
                if square < MIN_EDGE_SINE * MIN_EDGE_SINE {
                    continue;
                }
                // Projections on a_i x b_j, whose length is the sine (Gottschalk, Lin and Manocha,
                // OBBTree, 1996).
                let offset = self.in_low[i2] * dots.col(j)[i1] - self.in_low[i1] * dots.col(j)[i2];
                let reach_low = low.half[i1] * abs.col(j)[i2] + low.half[i2] * abs.col(j)[i1];
                let reach_high = high.half[j1] * abs.col(j2)[i] + high.half[j2] * abs.col(j1)[i];
                let scaled = offset.abs() - reach_low - reach_high;
                // Division by the sine only lowers a negative separation: an axis below the best
                // stays below it.
                if scaled < 0.0 && scaled - EDGE_PREFERENCE + AXIS_HYSTERESIS <= faces.merit.max(best.merit) {
                    continue;
                }
                let distance = scaled / square.sqrt();
                if distance > self.limit {
                    return None;
                }
                let axis = SeparatingAxis::Edges((3 * i + j) as u8);
                self.consider(&mut best, axis, offset, (distance, EDGE_PREFERENCE));
            }
        }
        Some(best)
    }

    /// Separation along an axis, with the normal from the first box to the second.
    #[inline]
    fn separation(&self, Candidate { axis, distance, offset, .. }: Candidate) -> Separation {
        let (a, b) = (&self.low.axes, &self.high.axes);
        let normal = match axis {
            SeparatingAxis::FaceLow(i) => a.col(i as usize),
            SeparatingAxis::FaceHigh(j) => b.col(j as usize),
            SeparatingAxis::Edges(pair) => a.col(pair as usize / 3).cross(b.col(pair as usize % 3)).normalize(),
        };
        Separation { axis, normal: if offset < 0.0 { -normal } else { normal }, distance }
    }
}

/// Separating axis test of two boxes, with a preference for faces and for the axis of the last
/// detection. Returns none where some axis separates them by more than `limit` (m).
pub fn separation(low: &Cuboid, high: &Cuboid, limit: f64, last: Option<SeparatingAxis>) -> Option<Separation> {
    let test = AxisTest::new(low, high, limit, last);
    let faces = test.faces()?;
    let edges = test.edges(&faces)?;
    let face = test.separation(faces);
    if edges.merit > faces.merit {
        let edge = test.separation(edges);
        if edge.normal.cross(face.normal).length_squared() > MIN_EDGE_TILT * MIN_EDGE_TILT {
            return Some(edge);
        }
    }
    Some(face)
}

/// Result of testing a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PairStatus {
    /// Separated by more than the limit.
    Apart,
    /// Separated by at least this much (m), with no part of one box in front of a face of the
    /// other: they may yet touch with their edges.
    Near(f64),
    /// Within the limit: the pair has a manifold.
    Touching,
}

/// Tests two boxes, `low` having the lower index; they are apart where some axis separates them by
/// more than `limit` (m). Where they touch, `to` becomes their manifold, which is too large to
/// return by value.
pub fn box_box(low: &Cuboid, high: &Cuboid, limit: f64, last: Option<SeparatingAxis>, to: &mut Manifold) -> PairStatus {
    let Some(found) = separation(low, high, limit, last) else { return PairStatus::Apart };
    to.axis = found.axis;
    let touching = match found.axis {
        SeparatingAxis::FaceLow(i) => face_manifold(low, high, i as usize, found.normal, to),
        SeparatingAxis::FaceHigh(j) => face_manifold(high, low, j as usize, -found.normal, to),
        SeparatingAxis::Edges(pair) => {
            edge_manifold(low, high, pair as usize, found.normal, to);
            true
        }
    };
    if touching { PairStatus::Touching } else { PairStatus::Near(found.distance) }
}

/// Right-handed contact frame in A's coordinates, from a normal in the world and an axis of A that
/// is not parallel to it.
fn contact_frame(a: &Cuboid, normal: DVec3, tangent_axis: usize) -> [DVec3; 3] {
    let n = a.axes.transpose() * normal;
    let mut t = DVec3::ZERO;
    t[tangent_axis] = 1.0;
    let t1 = (t - n * n.dot(t)).normalize();
    [n, t1, n.cross(t1)]
}

/// Corners of the face of `b` that faces most against `normal`, in the world, m.
#[inline]
fn incident_face(b: &Cuboid, normal: DVec3) -> [DVec3; 4] {
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
    [face + p + q, face - p + q, face - p - q, face + p - q]
}

/// Sets the manifold of the incident face of `b`, clipped by the face of `a` along `axis` whose
/// outward normal is `normal`. Returns false if nothing is left after clipping.
fn face_manifold(a: &Cuboid, b: &Cuboid, axis: usize, normal: DVec3, to: &mut Manifold) -> bool {
    let (iu, iv) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = (a.axes.col(iu), a.axes.col(iv));
    let plane = a.center + normal * a.half[axis];
    let corners = incident_face(b, normal).map(|x| {
        let d = x - plane;
        Corner { u: d.dot(u), v: d.dot(v), gap: d.dot(normal) }
    });

    let mut polygon = clip(&corners, a.half[iu], a.half[iv]);
    merge(&mut polygon, CORNER_MERGE);
    if polygon.is_empty() {
        return false;
    }
    let patch = Patch::new(&polygon);
    let local = |u: f64, v: f64| {
        let mut x = DVec3::ZERO;
        x[axis] = normal.dot(a.axes.col(axis)).signum() * a.half[axis];
        x[iu] = u;
        x[iv] = v;
        x
    };
    let frame = contact_frame(a, normal, iu);
    let centroid = local(patch.centroid[0], patch.centroid[1]);
    let inverse = b.axes.transpose();
    let points = polygon.iter().zip(patch.shares).map(|(c, weight)| {
        let anchor_a = local(c.u, c.v);
        let on_b = plane + u * c.u + v * c.v + normal * c.gap;
        let arm = anchor_a - centroid;
        ContactPoint {
            anchor_a,
            anchor_b: inverse * (on_b - b.center),
            arm: [arm.dot(frame[1]), arm.dot(frame[2])],
            weight,
            gap: c.gap,
            ..ContactPoint::default()
        }
    });
    to.set([a.body, b.body], (frame, centroid), &patch, points);
    true
}

/// Middle of the edge of a box along axis `along` that lies farthest in a direction, m.
#[inline]
fn farthest_edge(c: &Cuboid, along: usize, direction: DVec3) -> DVec3 {
    let toward = c.axes.transpose() * direction;
    let mut local = DVec3::ZERO;
    for k in 0..3 {
        if k != along {
            local[k] = if toward[k] >= 0.0 { c.half[k] } else { -c.half[k] };
        }
    }
    c.center + c.axes * local
}

/// Sets the manifold of two crossing edges, which has a single point.
fn edge_manifold(a: &Cuboid, b: &Cuboid, pair: usize, normal: DVec3, to: &mut Manifold) {
    let (i, j) = (pair / 3, pair % 3);
    let (p, q) = (farthest_edge(a, i, normal), farthest_edge(b, j, -normal));
    let (d, e) = (a.axes.col(i), b.axes.col(j));
    // Closest points of the lines p + s d and q + t e with unit directions.
    let w = q - p;
    let cosine = d.dot(e);
    let inv = 1.0 / (1.0 - cosine * cosine);
    let s = ((w.dot(d) - cosine * w.dot(e)) * inv).clamp(-a.half[i], a.half[i]);
    let t = ((cosine * w.dot(d) - w.dot(e)) * inv).clamp(-b.half[j], b.half[j]);
    let (on_a, on_b) = (p + d * s, q + e * t);
    let anchor_a = a.axes.transpose() * (on_a - a.center);
    let point = ContactPoint {
        anchor_a,
        anchor_b: b.axes.transpose() * (on_b - b.center),
        weight: 1.0,
        gap: normal.dot(on_b - on_a),
        ..ContactPoint::default()
    };
    to.set([a.body, b.body], (contact_frame(a, normal, i), anchor_a), &EDGE_PATCH, [point]);
}

/// Index of the axis of a box whose face is lowest, given the world's upward direction in the box's
/// frame. Hysteresis keeps a box balanced on an edge on the face of the last detection.
#[inline]
fn lowest_face(up: DVec3, last: Option<SeparatingAxis>) -> usize {
    let mut k = 0;
    let mut best = f64::NEG_INFINITY;
    for i in 0..3 {
        let merit = up[i].abs() + if last == Some(SeparatingAxis::FaceHigh(i as u8)) { 0.01 } else { 0.0 };
        if merit > best {
            best = merit;
            k = i;
        }
    }
    k
}

/// Tests a box against the floor z = 0; they are apart where the box is higher than `limit` (m).
/// The points are the corners of its lowest face.
pub fn box_floor(b: &Cuboid, limit: f64, last: Option<SeparatingAxis>, to: &mut Manifold) -> PairStatus {
    let up = b.axes.transpose() * DVec3::Z;
    if b.center.z - up.abs().dot(b.half) > limit {
        return PairStatus::Apart;
    }
    let k = lowest_face(up, last);
    let outward = if up[k] > 0.0 { -1.0 } else { 1.0 };
    let (ip, iq) = ((k + 1) % 3, (k + 2) % 3);
    let mut center = DVec3::ZERO;
    center[k] = outward * b.half[k];
    let sides = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let patch = Patch::new(&sides.map(|(x, y)| Corner { u: x * b.half[ip], v: y * b.half[iq], gap: 0.0 }));
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
        ContactPoint { anchor_a, anchor_b, arm: [arm.x, arm.y], weight: 0.25, gap: x.z, ..ContactPoint::default() }
    });
    to.axis = SeparatingAxis::FaceHigh(k as u8);
    to.set([FLOOR, b.body], ([DVec3::Z, DVec3::X, DVec3::Y], centroid), &patch, points);
    PairStatus::Touching
}
