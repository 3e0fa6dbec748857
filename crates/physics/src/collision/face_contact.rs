//! Contacts of a face: the facing face of the other box, clipped by it.

use glam::DVec3;

use crate::collision::cuboid::{Cuboid, Facing};
use crate::collision::manifold::{ContactPoint, Manifold, arm};
use crate::collision::polygon::{Corner, Patch, Polygon, clip, merge};
use crate::constants::{CORNER_MERGE, FLAT_SINE, LEVEL_SINE};

/// Distance of a point from a side of a face that is rounding, over half the size of the face.
const SIDE_TOLERANCE: f64 = 1e-9;

/// Face of a box, and the face of another box that faces it.
#[derive(Debug, Clone, Copy)]
pub struct FacePair<'a> {
    a: &'a Cuboid,
    b: &'a Cuboid,
    /// Axis of A across its face.
    axis: usize,
    /// Outward normal of the face of A.
    normal: DVec3,
    facing: Facing,
}

impl<'a> FacePair<'a> {
    /// Face of `a` across `axis` with this outward normal, and the face of `b` that faces most
    /// against it.
    pub fn new(a: &'a Cuboid, b: &'a Cuboid, axis: usize, normal: DVec3) -> Self {
        Self { a, b, axis, normal, facing: b.facing(normal) }
    }

    /// Returns true if the faces are so nearly parallel that they meet as faces.
    pub fn is_flat(&self) -> bool {
        self.facing.sine < FLAT_SINE
    }

    /// Face of B clipped by that of A, both smaller by `part` of their radii.
    fn polygon(&self, part: f64) -> Polygon {
        let &Self { a, b, axis, normal, facing } = self;
        let (iu, iv) = ((axis + 1) % 3, (axis + 2) % 3);
        let (u, v) = (a.axes.col(iu), a.axes.col(iv));
        let plane = a.center + normal * a.half[axis];
        // The surface of B nearest to A lies one radius from its core, along the normal.
        let k = facing.axis;
        let face = b.center + b.axes.col(k) * (facing.sign * (b.half[k] - b.radius)) - normal * b.radius;
        let (ip, iq) = ((k + 1) % 3, (k + 2) % 3);
        let p = b.axes.col(ip) * (b.half[ip] - part * b.radius);
        let q = b.axes.col(iq) * (b.half[iq] - part * b.radius);
        let corners = [face + p + q, face - p + q, face - p - q, face + p - q].map(|x| {
            let d = x - plane;
            Corner { u: d.dot(u), v: d.dot(v), gap: d.dot(normal) }
        });
        let mut polygon = clip(&corners, a.half[iu] - part * a.radius, a.half[iv] - part * a.radius);
        merge(&mut polygon, CORNER_MERGE);
        polygon
    }

    /// Returns true if the faces of the cores overlap in plan, `polygon` being the overlap of those
    /// of the boxes: otherwise only the roundings meet.
    fn cores_overlap(&self, polygon: &Polygon) -> bool {
        let radius = self.a.radius.max(self.b.radius);
        radius == 0.0 || is_inside(polygon, radius) || !self.polygon(1.0).is_empty()
    }

    /// Sets the manifold. Returns false if the faces do not overlap in plan.
    pub fn contact(&self, to: &mut Manifold) -> bool {
        let polygon = self.polygon(rounding(self.facing.sine));
        if polygon.is_empty() || !self.cores_overlap(&polygon) {
            return false;
        }
        let &Self { a, b, axis, normal, .. } = self;
        let (iu, iv) = ((axis + 1) % 3, (axis + 2) % 3);
        let (u, v) = (a.axes.col(iu), a.axes.col(iv));
        let plane = a.center + normal * a.half[axis];
        let patch = Patch::new(&polygon);
        let local = |u: f64, v: f64| {
            let mut x = DVec3::ZERO;
            x[axis] = normal.dot(a.axes.col(axis)).signum() * a.half[axis];
            x[iu] = u;
            x[iv] = v;
            x
        };
        let frame = a.contact_frame(normal, iu);
        // Corners of B lie within the sides of the face of A; those made by clipping, on them.
        let part = rounding(self.facing.sine) * a.radius;
        let [within_u, within_v] = [iu, iv].map(|i| (1.0 - SIDE_TOLERANCE) * (a.half[i] - part));
        let centroid = local(patch.centroid[0], patch.centroid[1]);
        let inverse = b.axes.transpose();
        let points = polygon.iter().zip(patch.shares).map(|(c, weight)| {
            let anchor_a = local(c.u, c.v);
            let on_b = plane + u * c.u + v * c.v + normal * c.gap;
            ContactPoint {
                anchor_a,
                anchor_b: inverse * (on_b - b.center),
                arm: arm(anchor_a, &frame, centroid),
                follows: [c.u.abs() < within_u, c.v.abs() < within_v],
                weight,
                gap: c.gap,
                ..ContactPoint::default()
            }
        });
        to.set([a.body, b.body], (frame, centroid), &patch, points);
        true
    }
}

/// Part of the radius by which a rounded face is smaller than the sharp one, from the sine of its
/// angle with the plane that it touches. A block that lies flat bears on its whole face; one that
/// is tilted bears on the rounding.
pub fn rounding(sine: f64) -> f64 {
    let t = ((sine - LEVEL_SINE) / (FLAT_SINE - LEVEL_SINE)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns true if the mean of the corners lies at least `depth` (m) inside every side.
fn is_inside(polygon: &Polygon, depth: f64) -> bool {
    let n = polygon.len();
    let inv = 1.0 / n as f64;
    let (u, v) = (polygon.iter().map(|c| c.u).sum::<f64>() * inv, polygon.iter().map(|c| c.v).sum::<f64>() * inv);
    n >= 3
        && (0..n).all(|i| {
            let (p, q) = (&polygon[i], &polygon[(i + 1) % n]);
            let (x, y) = (q.u - p.u, q.v - p.v);
            let area = x * (v - p.v) - y * (u - p.u);
            area * area > depth * depth * (x * x + y * y)
        })
}
