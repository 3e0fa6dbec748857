//! What a body is in the inner loop: rigid ([`crate::rigid`]) or a lattice of particles ([`crate::lattice`]).
//!
//! The contact law sees only how the two bodies move against each other at a point, and hands back forces. How a body has that motion, and
//! what the forces do to it, is its form's.

use glam::{DQuat, DVec3};

use crate::kernel::{Group, Row};
use crate::lattice::{Particles, Springs};
use crate::simd::lanes::{LANES, Lanes, Real};

/// [`LANES`] bodies of one form, a lane each.
pub trait Form<R: Real>: Clone + std::fmt::Debug + Send + Sync {
    /// Rows of velocity, and of force, that a body has.
    const ROWS: usize;
    /// How two bodies move against each other.
    type Motion<L: Lanes<Scalar = R>>: Motion<L>;

    /// Bodies at rest without mass or bounds, for empty lanes.
    fn empty() -> Self;

    /// Puts a body into lane `l`, and its rows of velocity and load.
    fn load(&mut self, l: usize, body: &Loading, velocity: &mut [Row<R>], load: &mut [Row<R>]);

    /// How B moves against A at the contacts of a part of a group, along their frames.
    fn relative<L: Lanes<Scalar = R>>(group: &Group<R>, part: usize, velocity: &[Row<R>], motion: &mut Self::Motion<L>);

    /// Adds what the contacts did to the forces on B, and takes it from those on A. Uses up the sum.
    fn react<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        sum: &mut <Self::Motion<L> as Motion<L>>::Wrench,
        force: &mut [Row<R>],
    );

    /// Advances a part of the bodies by a substep with the forces on them, which begin anew with the load.
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    );

    /// Whether one of a part of them has gone as far as it may between two syncs.
    fn beyond<L: Lanes<Scalar = R>>(&self, part: usize) -> bool;

    /// Displacement (m) and turn (rad) of the body in lane `l` since its pose was made exact.
    fn displacement(&self, l: usize) -> (DVec3, DVec3);

    /// What its points have done since then, laid out as its rows of velocity. Gives the largest of the numbers that they have done it from, m,
    /// zero where all begin at zero: what rounding kept from being done is in proportion to that.
    fn way(&self, l: usize, rows: &mut [Row<R>]) -> f64;

    /// Velocity of its centre and spin, m and rad per substep.
    fn motion(&self, l: usize) -> (DVec3, DVec3);

    /// All that it has done since its pose was made exact, in substeps of `h` (s).
    fn taken(&self, l: usize, h: f64) -> Taken;

    /// Adds what pushes it to the forces on it.
    fn push(&self, l: usize, push: &Push, force: &mut [Row<R>]);
}

/// How two bodies move against each other, along normal, tangent, tangent of a contact.
pub trait Motion<L: Lanes> {
    /// Forces of points, summed.
    type Wrench;

    /// No motion.
    fn still() -> Self;

    /// The sum of none.
    fn no_force() -> Self::Wrench;

    /// Velocity of a point: along the normal at `arm` from the centroid, along the tangents at `lever`.
    fn at(&self, arm: &[L; 2], lever: &[L; 2]) -> [L; 3];

    /// Takes a force of the point from the sum.
    fn add(sum: &mut Self::Wrench, pull: &[L; 3], arm: &[L; 2], lever: &[L; 2]);
}

/// A body to put into the inner loop.
#[derive(Debug, Clone, Copy)]
pub struct Loading<'a> {
    /// Substep, s.
    pub h: f64,
    /// Whether forces move it.
    pub moves: bool,
    /// Mass (kg) and principal moments of inertia (kg m²).
    pub mass: f64,
    pub inertia: DVec3,
    /// Distance from the centre to the corners, m.
    pub radius: f64,
    /// Centre from the cluster's reference point, m.
    pub offset: DVec3,
    pub orientation: DQuat,
    /// Velocity of the centre (m/s) and spin (rad/s).
    pub velocity: DVec3,
    pub spin: DVec3,
    /// Travel (m) and turn (rad) until its next sync.
    pub reach: f64,
    pub turn: f64,
    /// Force (N) and torque (N m) that stay the same until its next sync.
    pub force: DVec3,
    pub torque: DVec3,
    /// Its particles, their distances from the centre along its axes (m), and its springs, where it has any.
    pub lattice: Option<(&'a Particles, DVec3, &'a Springs)>,
}

/// A force at a point of a body, and a torque on all of it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Push {
    /// N.
    pub force: DVec3,
    /// From the centre to where it acts, m.
    pub arm: DVec3,
    /// N m.
    pub torque: DVec3,
}

/// What the inner loop did to a body.
#[derive(Debug, Clone)]
pub struct Taken {
    /// Displacement of the centre (m) and turn (rad) since its pose was made exact.
    pub shift: DVec3,
    pub turn: DVec3,
    /// Velocity of the centre (m/s) and spin (rad/s).
    pub velocity: DVec3,
    pub spin: DVec3,
    /// Displacements (m) and velocities (m/s) of its particles, where it has any, in the world.
    pub particles: Option<[(DVec3, DVec3); 8]>,
}

/// Data of so many lanes with the same number in each.
pub fn lanes<R: Real>(x: f64) -> crate::kernel::Lane<R> {
    crate::kernel::Lane([R::from_f64(x); LANES])
}
