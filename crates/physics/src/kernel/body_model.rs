//! Body model of the inner loop: rigid ([`crate::kernel::rigid`]) or a lattice of particles
//! ([`crate::kernel::lattice`]).
//!
//! The contact law sees only the relative motion of two bodies at a point and returns forces. The
//! model computes that motion from the state of the bodies, and integrates the forces.

use glam::{DQuat, DVec3};

use crate::body::BodyForce;
use crate::kernel::layout::{Group, Row};
use crate::lattice::affine::PARTICLES;
use crate::lattice::particles::Particles;
use crate::lattice::springs::Springs;
use crate::simd::lanes::{Lanes, Real};

/// Bodies of one model, one for each of [`LANES`](crate::simd::lanes::LANES) lanes.
pub trait BodyModel<R: Real>: Clone + std::fmt::Debug + Send + Sync {
    /// Rows of velocity, and of force, for each body.
    const ROWS: usize;
    /// Relative motion of two bodies.
    type Motion<L: Lanes<Scalar = R>>: RelativeMotion<L>;

    /// Bodies at rest without mass or budgets, for unused lanes.
    fn empty() -> Self;

    /// Sets the body in lane `l`, and its rows of velocity and load.
    fn load(&mut self, l: usize, body: &KernelBody, velocity: &mut [Row<R>], load: &mut [Row<R>]);

    /// Computes the motion of B relative to A at the contacts of one part of a group, in their
    /// frames.
    ///
    /// # Safety
    /// The group is [within](Group::is_within) the rows of `velocity`, at [`Self::ROWS`] a body.
    unsafe fn relative_motion<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        velocity: &[Row<R>],
        motion: &mut Self::Motion<L>,
    );

    /// Adds the wrench of the contacts to the forces on A and subtracts it from those on B. The
    /// wrench serves as scratch space.
    ///
    /// # Safety
    /// The group is [within](Group::is_within) the rows of `force`, at [`Self::ROWS`] a body.
    unsafe fn apply_wrench<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        wrench: &mut <Self::Motion<L> as RelativeMotion<L>>::Wrench,
        force: &mut [Row<R>],
    );

    /// Advances one part of the bodies by a substep, and resets the forces on them to the load.
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    );

    /// Returns true if a body of one part has used up its budget of travel, rotation or deviation
    /// after `substeps` substeps of a batch.
    fn exceeds_budget<L: Lanes<Scalar = R>>(&self, part: usize, substeps: usize) -> bool;

    /// Adds the substeps of a batch to those since the last sync of each body.
    fn add_substeps(&mut self, substeps: usize);

    /// Displacement (m) and rotation (rad) of the body in lane `l` beyond those of its uniform
    /// motion.
    fn deviation(&self, l: usize) -> (DVec3, DVec3);

    /// Displacement (m) and rotation (rad) of the body in lane `l` since its last sync.
    fn displacement(&self, l: usize) -> (DVec3, DVec3);

    /// Stores the displacement since the last sync in the layout of the velocity rows.
    ///
    /// Returns the largest magnitude from which the displacements were accumulated, m, to which
    /// their rounding error is proportional; zero where all started at zero.
    fn displacement_rows(&self, l: usize, rows: &mut [Row<R>]) -> f64;

    /// Velocity of the centre and spin of the body in lane `l`, m and rad per substep.
    fn twist(&self, l: usize) -> (DVec3, DVec3);

    /// Change of the body in lane `l` since its last sync, with substeps of `h` (s).
    fn delta(&self, l: usize, h: f64) -> BodyDelta;

    /// Adds to the forces on the body in lane `l`.
    fn add_force(&self, l: usize, applied: &BodyForce, force: &mut [Row<R>]);
}

/// Relative motion of two bodies along normal, tangent, tangent of a contact.
pub trait RelativeMotion<L: Lanes> {
    /// Sum of the forces of points on A.
    type Wrench;

    /// Zero motion.
    fn zero() -> Self;

    /// Zero wrench.
    fn zero_wrench() -> Self::Wrench;

    /// Velocity of the centroid along the normal.
    fn normal_velocity(&self) -> L;

    /// Velocity of a point: along the normal at `arm`; along the tangents at `friction_arm`, whose
    /// third component is the arm of the turning about the normal.
    fn velocity_at(&self, arm: &[L; 2], friction_arm: &[L; 3]) -> [L; 4];

    /// Adds the force on A at a point to the wrench; the `FIRST` one sets the wrench, which costs
    /// less than to add to zero.
    fn add_force<const FIRST: bool>(wrench: &mut Self::Wrench, force: &[L; 4], arm: &[L; 2], friction_arm: &[L; 3]);
}

/// Motion that was predicted for a body when its pairs were last considered.
#[derive(Debug, Clone, Copy, Default)]
pub struct UniformMotion {
    /// Velocity of the centre, m/s.
    pub velocity: DVec3,
    /// Angular velocity, rad/s.
    pub spin: DVec3,
    /// Displacement (m) and rotation (rad) by which the body has deviated from it since.
    pub deviation: (DVec3, DVec3),
}

/// Body to be loaded into the inner loop.
#[derive(Debug, Clone, Copy)]
pub struct KernelBody<'a> {
    /// Substep, s.
    pub h: f64,
    /// True if forces move the body.
    pub active: bool,
    /// Mass, kg.
    pub mass: f64,
    /// Principal moments of inertia, kg m².
    pub inertia: DVec3,
    /// Distance from the centre to a corner, m.
    pub radius: f64,
    /// Centre, from the cluster's reference point, m.
    pub offset: DVec3,
    /// Orientation, unit quaternion.
    pub orientation: DQuat,
    /// Velocity of the centre, m/s.
    pub velocity: DVec3,
    /// Angular velocity, rad/s.
    pub spin: DVec3,
    /// Travel until the next sync, m.
    pub travel_budget: f64,
    /// Rotation until the next sync, rad.
    pub rotation_budget: f64,
    /// Deviation of the body's points from uniform motion until the next sync, m.
    pub deviation_budget: f64,
    /// Motion from which it deviates.
    pub uniform: UniformMotion,
    /// Constant force until the next sync, N.
    pub force: DVec3,
    /// Constant torque until the next sync, N m.
    pub torque: DVec3,
    /// Particles, their distances from the centre along the body's axes (m), and springs; none for
    /// a rigid body.
    pub lattice: Option<(&'a Particles, DVec3, &'a Springs)>,
}

/// Change of a body in the inner loop since its last sync.
#[derive(Debug, Clone)]
pub struct BodyDelta {
    /// Displacement of the centre, m.
    pub displacement: DVec3,
    /// Rotation vector, rad.
    pub rotation: DVec3,
    /// Velocity of the centre, m/s.
    pub velocity: DVec3,
    /// Angular velocity, rad/s.
    pub spin: DVec3,
    /// Displacements (m) and velocities (m/s) of the particles in the world; none for a rigid body.
    pub particles: Option<[(DVec3, DVec3); PARTICLES]>,
}
