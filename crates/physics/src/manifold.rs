//! A manifold: the points at which two bodies touch, or may soon, under one normal. The geometry is fixed in the bodies between
//! detections; the history is the springs' memory.

use arrayvec::ArrayVec;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR};
use crate::constants::{AREA_RANGE, REFERENCE_AREA};
use crate::polygon::Patch;

/// Which axis separates best.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// Normal of a face of the body with the lower index (or of the floor), by axis.
    FaceLow(u8),
    /// Normal of a face of the body with the higher index, by axis.
    FaceHigh(u8),
    /// Cross product of two edges, 3 * (axis of the lower) + axis of the higher.
    Edges(u8),
}

/// One point of a manifold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// On A's reference plane, in A's frame, m.
    pub anchor_a: DVec3,
    /// On B's surface, in B's frame, m.
    pub anchor_b: DVec3,
    /// Place in the plane of contact from the centroid, along the two tangents, m.
    pub arm: [f64; 2],
    /// Share of the manifold's stiffness.
    pub weight: f64,
    /// Separation along the normal, m; negative is overlap.
    pub gap: f64,
    /// Tangential spring: displacement of B over A along the tangents since the point began to stick, m.
    pub stretch: [f64; 2],
    /// Maxwell element: recent normal displacement that has not yet relaxed, m.
    pub creep: f64,
    /// Normal force at the last substep, N.
    pub force: f64,
}

/// At most this many points: a quadrilateral clipped by a rectangle.
pub const MAX_POINTS: usize = 8;

/// The points at which two bodies touch, or may soon.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifold {
    /// The body of the reference plane; [`crate::body::FLOOR`] for the floor.
    pub a: u32,
    /// The other body.
    pub b: u32,
    /// Which axis it was found on.
    pub axis: Axis,
    /// Normal from A to B and two tangents, right-handed, in A's frame.
    pub frame: [DVec3; 3],
    /// Centroid of the patch in A's frame, m.
    pub centroid: DVec3,
    /// Area of the patch over the reference area, clamped: stiffness over that of the scene.
    pub area: f64,
    /// By how much the levers of the points' friction are shorter than their arms, see [`crate::polygon::Patch`].
    pub lever: f64,
    /// How easily the two bodies give way at the patch, 1/kg: bounds what the explicit step can hold.
    pub mobility: f64,
    /// The points.
    pub points: ArrayVec<Point, MAX_POINTS>,
}

impl Point {
    /// Forgets the springs: what an open point has.
    pub fn forget(&mut self) {
        self.stretch = [0.0; 2];
        self.creep = 0.0;
        self.force = 0.0;
    }
}

impl Manifold {
    /// One of nothing, to be [`set`](Self::set).
    pub fn new() -> Self {
        Self {
            a: FLOOR,
            b: FLOOR,
            axis: Axis::FaceLow(0),
            frame: [DVec3::ZERO; 3],
            centroid: DVec3::ZERO,
            area: 0.0,
            lever: 0.0,
            mobility: 0.0,
            points: ArrayVec::new(),
        }
    }

    /// Makes it the manifold of two bodies on the axis that it has: of the frame and the centroid in the frame of the first, and of a patch with
    /// these points. What follows from the bodies' masses stays to be found.
    pub fn set(
        &mut self,
        [a, b]: [u32; 2],
        frame: [DVec3; 3],
        centroid: DVec3,
        patch: &Patch,
        points: impl IntoIterator<Item = Point>,
    ) {
        (self.a, self.b, self.frame, self.centroid) = (a, b, frame, centroid);
        self.area = (patch.area / REFERENCE_AREA).clamp(AREA_RANGE.0, AREA_RANGE.1);
        (self.lever, self.mobility) = (patch.lever, 0.0);
        self.points.clear();
        self.points.extend(points);
    }

    /// Becomes the same as another. The points that it does not have are not moved, which a plain copy does.
    pub fn copy(&mut self, from: &Self) {
        let Self { a, b, axis, frame, centroid, area, lever, mobility, ref points } = *from;
        (self.a, self.b, self.axis, self.frame, self.centroid) = (a, b, axis, frame, centroid);
        (self.area, self.lever, self.mobility) = (area, lever, mobility);
        self.points.clear();
        self.points.extend(points.iter().copied());
    }

    /// Lower index first, the floor lowest: the order in which manifolds are kept.
    pub fn key(&self) -> (u32, u32) {
        key(self.a, self.b)
    }

    /// Normal in the world: upright on the face of A, also where that is strained.
    pub fn normal_in_world(&self, bodies: &Bodies, axes_a: DMat3) -> DVec3 {
        let normal = axes_a * self.frame[0];
        let Some(stretch) = bodies.stretch_of(self.a) else { return normal };
        // normals go by the cofactors of what strains the face: det(S) S⁻ᵀ
        let [x, y, z] = [stretch.x_axis, stretch.y_axis, stretch.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let strained = axes_a * (cofactors * self.frame[0]);
        strained.try_normalize().filter(|n| n.dot(normal) > 0.5).unwrap_or(normal)
    }

    /// Normal and tangents in the world.
    pub fn frame_in_world(&self, bodies: &Bodies, axes_a: DMat3) -> [DVec3; 3] {
        let normal = self.normal_in_world(bodies, axes_a);
        let along = axes_a * self.frame[1];
        if bodies.stretch_of(self.a).is_none() {
            return [normal, along, axes_a * self.frame[2]];
        }
        let along = (along - normal * normal.dot(along)).normalize();
        [normal, along, normal.cross(along)]
    }

    /// How easily a body gives way to this patch, 1/kg: as a whole, or by turning about its centre under a pressure that varies
    /// over the patch, and by turning under the pressure's resultant.
    pub fn mobility_of(
        &self,
        mass: f64,
        inv_inertia: DMat3,
        to_centroid: DVec3,
        to_world: impl Fn(DVec3) -> DVec3,
    ) -> f64 {
        let tangents = [to_world(self.frame[1]), to_world(self.frame[2])];
        // a lever along one tangent turns the body about the other
        let turn = |k: usize| {
            let axis = tangents[1 - k];
            let offset = to_centroid.dot(tangents[k]);
            let ease = axis.dot(inv_inertia * axis);
            (self.variance(k) * ease, offset * offset * ease)
        };
        let ((spread0, offset0), (spread1, offset1)) = (turn(0), turn(1));
        mass.recip().max(spread0).max(spread1) + offset0 + offset1
    }

    /// The same for a body of particles, which gives way by straining as well. `levers` are the squares of one over the distances of the particles
    /// from the centre along its axes, 1/m², in the world.
    pub fn affine_mobility_of(
        &self,
        mass: f64,
        levers: DMat3,
        to_centroid: DVec3,
        to_world: impl Fn(DVec3) -> DVec3,
    ) -> f64 {
        let of = |axis: DVec3, square: f64| square * axis.dot(levers * axis);
        let [normal, ..] = self.frame.map(&to_world);
        let along = |k: usize| {
            let tangent = to_world(self.frame[1 + k]);
            let offset = to_centroid.dot(tangent);
            (of(tangent, self.variance(k)), of(tangent, offset * offset))
        };
        let depth = to_centroid.dot(normal);
        let ((spread0, offset0), (spread1, offset1)) = (along(0), along(1));
        ((1.0 + of(normal, depth * depth)).max(spread0).max(spread1) + offset0 + offset1) / mass
    }

    /// Variance of the points along a tangent, m².
    fn variance(&self, k: usize) -> f64 {
        self.points.iter().map(|p| p.weight * p.arm[k] * p.arm[k]).sum::<f64>()
    }

    /// Levers of the points' friction from the centroid, m: the resultant acts at the centre of pressure, and around it the points
    /// stand closer by [`Manifold::lever`]. The pressure is that of the last substep.
    pub fn levers(&self) -> impl Fn(&Point) -> [f64; 2] {
        let total: f64 = self.points.iter().map(|p| p.force).sum();
        let center = |k: usize| {
            if total > 0.0 { self.points.iter().map(|p| p.force * p.arm[k]).sum::<f64>() / total } else { 0.0 }
        };
        let (center, lever) = ([center(0), center(1)], self.lever);
        move |p| [0, 1].map(|k| center[k] + lever * (p.arm[k] - center[k]))
    }

    /// Takes the history of an earlier manifold of the same bodies: each point that of the nearest old one. `old_to_world` and
    /// `to_world` turn a direction in A's frame into the world.
    pub fn inherit(
        &mut self,
        old: &Manifold,
        to_world: impl Fn(DVec3) -> DVec3,
        old_to_world: impl Fn(DVec3) -> DVec3,
    ) {
        if old.points.is_empty() {
            return;
        }
        let swapped = self.a != old.a;
        let tangents = [to_world(self.frame[1]), to_world(self.frame[2])];
        let old_tangents = [old_to_world(old.frame[1]), old_to_world(old.frame[2])];
        for point in &mut self.points {
            // both are compared in the frame of the same body
            let place = if swapped { point.anchor_b } else { point.anchor_a };
            let nearest = old
                .points
                .iter()
                .min_by(|p, q| (p.anchor_a - place).length_squared().total_cmp(&(q.anchor_a - place).length_squared()));
            if let Some(nearest) = nearest {
                let stretch = nearest.stretch[0] * old_tangents[0] + nearest.stretch[1] * old_tangents[1];
                let stretch = if swapped { -stretch } else { stretch };
                point.stretch = [stretch.dot(tangents[0]), stretch.dot(tangents[1])];
                point.creep = nearest.creep;
                point.force = nearest.force;
            }
        }
    }
}

/// The key of a pair.
pub fn key(a: u32, b: u32) -> (u32, u32) {
    // the floor's index is the highest, yet its contacts come first
    let rank = |i: u32| i.wrapping_add(1);
    if rank(a) < rank(b) { (rank(a), rank(b)) } else { (rank(b), rank(a)) }
}
