//! Contact manifold: the points at which two bodies touch or may soon touch, with a common normal.
//!
//! The geometry is fixed in the bodies' frames between detections. The history is the state of the
//! springs of each point.

use arrayvec::ArrayVec;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR};
use crate::collision::friction_levers::FrictionLevers;
use crate::collision::polygon::{MAX_CORNERS, Patch};
use crate::constants::{MIN_AREA, REFERENCE_AREA};

/// Part of the mobility along two tangents apart below which that along both is used. The limit of
/// stability has that much to spare, and the stiffness of towers does not depend on rounding.
const OVERSTATED: f64 = 0.5;

/// Separating axis of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SeparatingAxis {
    /// Face normal of the body with the lower index, or of the floor, by the index of the axis.
    FaceLow(u8),
    /// Face normal of the body with the higher index, by the index of the axis.
    FaceHigh(u8),
    /// Cross product of two edges: 3 * (axis of the lower body) + axis of the higher.
    Edges(u8),
    /// Line between the nearest points of two cores.
    Cores,
}

/// Contact point of a manifold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactPoint {
    /// Anchor on the reference plane of A, in A's frame, m.
    pub anchor_a: DVec3,
    /// Anchor on the surface of B, in B's frame, m.
    pub anchor_b: DVec3,
    /// Offset from the centroid along the two tangents, m.
    pub arm: [f64; 2],
    /// True for each tangent along which the point moves with B between detections: both for a
    /// corner of B, one for a point at which an edge of B crosses a side of A's face.
    pub follows: [bool; 2],
    /// Share of the manifold's stiffness.
    pub weight: f64,
    /// Separation along the normal, m; negative where the bodies overlap.
    pub gap: f64,
    /// Tangential spring: displacement of B against A along the tangents, and turning times the
    /// turning arm, since the point began to stick, m.
    pub tangential: [f64; 3],
    /// Maxwell element: recent normal displacement that has not yet relaxed, m.
    pub maxwell: f64,
    /// Normal force of the springs at the last sync, N; positive in compression.
    pub normal_force: f64,
}

/// Most points of a manifold.
pub const MAX_POINTS: usize = MAX_CORNERS;

/// Contact manifold of two bodies, A and B.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifold {
    /// Body of the reference plane; [`FLOOR`] for the floor.
    pub a: u32,
    /// The other body.
    pub b: u32,
    /// Axis on which the pair was found.
    pub axis: SeparatingAxis,
    /// Normal from A to B and two tangents, right-handed, in A's frame.
    pub frame: [DVec3; 3],
    /// Centroid of the patch in A's frame, m.
    pub centroid: DVec3,
    /// Area of the patch over [`REFERENCE_AREA`], at least [`MIN_AREA`]: stiffness over that of the
    /// scene.
    pub area_ratio: f64,
    /// Levers of friction.
    pub levers: FrictionLevers,
    /// Inverse effective mass of the two bodies at the patch, 1/kg: bounds the stiffness that the
    /// explicit step can integrate.
    pub mobility: f64,
    /// Depth up to which the points exert no force, m, see [`crate::collision::passivity`].
    pub free_depth: f64,
    /// Contact points.
    pub points: ArrayVec<ContactPoint, MAX_POINTS>,
}

impl ContactPoint {
    /// Moves the point on A, in its frame (m): its arm follows.
    pub fn move_on_a(&mut self, to: DVec3, frame: &[DVec3; 3], centroid: DVec3) {
        self.anchor_a = to;
        self.arm = arm(to, frame, centroid);
    }

    /// Resets the springs to those of an open point.
    pub fn reset(&mut self) {
        self.tangential = [0.0; 3];
        self.maxwell = 0.0;
        self.normal_force = 0.0;
    }
}

impl Manifold {
    /// Empty manifold, to be [`set`](Self::set).
    pub fn new() -> Self {
        Self {
            a: FLOOR,
            b: FLOOR,
            axis: SeparatingAxis::FaceLow(0),
            frame: [DVec3::ZERO; 3],
            centroid: DVec3::ZERO,
            area_ratio: 0.0,
            levers: FrictionLevers::default(),
            mobility: 0.0,
            free_depth: 0.0,
            points: ArrayVec::new(),
        }
    }

    /// Sets bodies, geometry and points; frame and centroid are in the frame of the first body. The
    /// axis stays, and the mobility is left to the caller, who knows the masses.
    pub fn set(
        &mut self,
        [a, b]: [u32; 2],
        (frame, centroid): ([DVec3; 3], DVec3),
        patch: &Patch,
        points: impl IntoIterator<Item = ContactPoint>,
    ) {
        (self.a, self.b, self.frame, self.centroid) = (a, b, frame, centroid);
        self.area_ratio = (patch.area / REFERENCE_AREA).max(MIN_AREA);
        (self.mobility, self.free_depth) = (0.0, 0.0);
        self.points.clear();
        self.points.extend(points);
        let offsets: ArrayVec<[f64; 2], MAX_POINTS> = self.points.iter().map(|p| p.arm).collect();
        self.levers = FrictionLevers::new(&offsets, &patch.shares[..offsets.len()], patch.torsion_ratio);
    }

    /// Copies another manifold. Unlike an assignment it moves only the points in use.
    pub fn copy_from(&mut self, from: &Self) {
        let Self { a, b, axis, frame, centroid, area_ratio, levers, mobility, free_depth, ref points } = *from;
        (self.a, self.b, self.axis, self.frame, self.centroid) = (a, b, axis, frame, centroid);
        (self.area_ratio, self.levers) = (area_ratio, levers);
        (self.mobility, self.free_depth) = (mobility, free_depth);
        self.points.clear();
        self.points.extend(points.iter().copied());
    }

    /// Sort key of the pair, see [`key`].
    pub fn key(&self) -> (u32, u32) {
        key(self.a, self.b)
    }

    /// Depth of the deepest point, m; zero where all are open.
    pub fn deepest(&self) -> f64 {
        self.points.iter().map(|p| -p.gap).fold(0.0, f64::max)
    }

    /// Normal force of the springs of all points at the last sync, N.
    pub fn normal_force(&self) -> f64 {
        self.points.iter().map(|p| p.normal_force).sum()
    }

    /// Normal in the world, perpendicular to the face of A also where A is strained.
    pub fn normal_in_world(&self, bodies: &Bodies, axes_a: DMat3) -> DVec3 {
        let normal = axes_a * self.frame[0];
        let Some(stretch) = bodies.stretch_of(self.a) else { return normal };
        // Normals transform by the cofactors of the stretch, det(S) S⁻ᵀ.
        let [x, y, z] = [stretch.x_axis, stretch.y_axis, stretch.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let strained = axes_a * (cofactors * self.frame[0]);
        strained.try_normalize().filter(|n| n.dot(normal) > 0.5).unwrap_or(normal)
    }

    /// Normal and tangents in the world.
    pub fn frame_in_world(&self, bodies: &Bodies, axes_a: DMat3) -> [DVec3; 3] {
        let normal = self.normal_in_world(bodies, axes_a);
        let tangent = axes_a * self.frame[1];
        if bodies.stretch_of(self.a).is_none() {
            return [normal, tangent, axes_a * self.frame[2]];
        }
        let tangent = (tangent - normal * normal.dot(tangent)).normalize();
        [normal, tangent, normal.cross(tangent)]
    }

    /// Inverse effective mass of a rigid body at this patch, 1/kg: translation, or rotation under a
    /// pressure that varies over the patch, plus rotation under the resultant of the pressure.
    /// `to_centroid` (m) leads from the body's centre to the centroid; `to_world` rotates from A's
    /// frame.
    pub fn rigid_mobility(
        &self,
        mass: f64,
        inv_inertia: DMat3,
        to_centroid: DVec3,
        to_world: impl Fn(DVec3) -> DVec3,
    ) -> f64 {
        let tangents = [to_world(self.frame[1]), to_world(self.frame[2])];
        // An arm along one tangent rotates the body about the other.
        let rotation = |k: usize| {
            let axis = tangents[1 - k];
            let offset = to_centroid.dot(tangents[k]);
            let inv = axis.dot(inv_inertia * axis);
            (self.variance(k) * inv, offset * offset * inv)
        };
        let ((spread0, offset0), (spread1, offset1)) = (rotation(0), rotation(1));
        let apart = mass.recip().max(spread0).max(spread1) + offset0 + offset1;
        // The tangents apart are right where they are along the axes of patch and body. A long
        // block at an angle would seem to yield to all of its length about its thinnest axis.
        let [b00, b01, b11] = [(1, 1), (1, 0), (0, 0)].map(|(i, j)| tangents[i].dot(inv_inertia * tangents[j]));
        let (c00, c01, c11) = (self.variance(0), self.covariance(), self.variance(1));
        let half_trace = 0.5 * (c00 * b00 + c11 * b11) - c01 * b01;
        let determinant = (c00 * c11 - c01 * c01) * (b00 * b11 - b01 * b01);
        let spread = half_trace + (half_trace * half_trace - determinant).max(0.0).sqrt();
        let offsets = offset0 + offset1 - 2.0 * to_centroid.dot(tangents[0]) * to_centroid.dot(tangents[1]) * b01;
        let together = mass.recip().max(spread) + offsets;
        if together < OVERSTATED * apart { together } else { apart }
    }

    /// Inverse effective mass of a block of particles at this patch, 1/kg, which includes its
    /// strain. `inv_squares` is the tensor of one over the squared distances of the particles from
    /// the centre along the body's axes, in the world, 1/m².
    pub fn affine_mobility(
        &self,
        mass: f64,
        inv_squares: DMat3,
        to_centroid: DVec3,
        to_world: impl Fn(DVec3) -> DVec3,
    ) -> f64 {
        let of = |axis: DVec3, square: f64| square * axis.dot(inv_squares * axis);
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

    /// Variance of the points along tangent `k`, m².
    fn variance(&self, k: usize) -> f64 {
        self.points.iter().map(|p| p.weight * p.arm[k] * p.arm[k]).sum::<f64>()
    }

    /// Covariance of the points along both tangents, m².
    fn covariance(&self) -> f64 {
        self.points.iter().map(|p| p.weight * p.arm[0] * p.arm[1]).sum::<f64>()
    }

    /// Copies to each point the history of the nearest point of an earlier manifold of the same
    /// bodies. `to_world` and `old_to_world` rotate a direction from the frame of A into the world.
    pub fn inherit_history(
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
            // Distances are taken in the frame of the old A.
            let anchor = if swapped { point.anchor_b } else { point.anchor_a };
            let nearest = old.points.iter().min_by(|p, q| {
                (p.anchor_a - anchor).length_squared().total_cmp(&(q.anchor_a - anchor).length_squared())
            });
            if let Some(nearest) = nearest {
                let tangential = nearest.tangential[0] * old_tangents[0] + nearest.tangential[1] * old_tangents[1];
                let tangential = if swapped { -tangential } else { tangential };
                // Turning about the normal is the same for both orders of the bodies.
                let turned = nearest.tangential[2];
                point.tangential = [tangential.dot(tangents[0]), tangential.dot(tangents[1]), turned];
                point.maxwell = nearest.maxwell;
                point.normal_force = nearest.normal_force;
            }
        }
    }
}

/// Offset of a point from the centroid along the tangents of a frame, all in the frame of A, m.
pub fn arm(anchor_a: DVec3, frame: &[DVec3; 3], centroid: DVec3) -> [f64; 2] {
    let offset = anchor_a - centroid;
    [offset.dot(frame[1]), offset.dot(frame[2])]
}

/// Sort key of a pair, the same for both orders: lower index first, the floor lowest.
pub fn key(a: u32, b: u32) -> (u32, u32) {
    // The floor has the highest index; adding one wraps it to rank 0.
    let rank = |i: u32| i.wrapping_add(1);
    if rank(a) < rank(b) { (rank(a), rank(b)) } else { (rank(b), rank(a)) }
}
