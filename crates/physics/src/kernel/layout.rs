//! Memory layout of the inner loop: lane arrays, groups of contacts, and rows of the bodies.

use glam::DVec3;

use crate::kernel::vector::{LaneArray, dot, load, load3};
use crate::simd::lanes::{LANES, Lanes, ROW_LEN, Real};

/// Points of an entry; a manifold with more points has several entries.
pub const SLOTS: usize = 4;

/// Contact points of a group in one slot, one for each lane.
#[derive(Debug, Clone, Copy, Default)]
pub struct PointLanes<R> {
    /// Offset from the centroid along the tangents, m.
    pub arm: [LaneArray<R>; 2],
    /// Offset from the centroid at which friction acts, along the tangents, and arm at which it
    /// resists turning about the normal, m, see
    /// [`friction_arms`](crate::collision::friction_arms::friction_arms).
    pub friction_arm: [LaneArray<R>; 3],
    /// Separation, m.
    pub gap: LaneArray<R>,
    /// Displacement of the tangential spring along the tangents and about the normal, m.
    pub tangential: [LaneArray<R>; 3],
    /// Displacement of the Maxwell element, m.
    pub maxwell: LaneArray<R>,
    /// Stiffness, N/m.
    pub stiffness: LaneArray<R>,
}

/// Group of contacts, one for each lane.
#[derive(Debug, Clone, Copy)]
pub struct Group<R> {
    /// Points of each contact.
    pub counts: [u8; LANES],
    /// Offsets of the rows of body A and body B, in scalars: those of rows up to the floor's.
    a: [u32; LANES],
    b: [u32; LANES],
    /// Offset of the rows of the floor, in scalars.
    floor: u32,
    /// Normal and tangents in the world.
    pub frame: [[LaneArray<R>; 3]; 3],
    /// Centroid, from the cluster's reference point, m.
    pub centroid: [LaneArray<R>; 3],
    /// Damping over stiffness, substeps.
    pub damping_time: LaneArray<R>,
    /// Kinetic coefficient of friction.
    pub mu_kinetic: LaneArray<R>,
    /// Static minus kinetic coefficient of friction.
    pub mu_excess: LaneArray<R>,
    /// Points by slot.
    pub points: [PointLanes<R>; SLOTS],
}

impl<R: Real> Group<R> {
    /// Group of open contacts of the floor with itself; `floor` is the offset of the floor's rows.
    ///
    /// # Panics
    /// When that is not the offset of a row.
    pub fn new(floor: u32) -> Self {
        assert!((floor as usize).is_multiple_of(ROW_LEN));
        let open = PointLanes { gap: LaneArray([R::from_f64(1.0); LANES]), ..PointLanes::default() };
        Self {
            counts: [0; LANES],
            a: [floor; LANES],
            b: [floor; LANES],
            floor,
            frame: Default::default(),
            centroid: Default::default(),
            damping_time: LaneArray::default(),
            mu_kinetic: LaneArray::default(),
            mu_excess: LaneArray::default(),
            points: [open; SLOTS],
        }
    }

    /// Returns true if the rows of all its bodies, `per_body` for each, are among `count` rows.
    pub fn is_within(&self, count: usize, per_body: usize) -> bool {
        self.floor as usize / ROW_LEN + per_body <= count
    }

    /// Sets the bodies of lane `l` by the offsets of their rows, in scalars.
    ///
    /// # Panics
    /// When one is not the offset of a row up to the floor's.
    pub fn set_bodies(&mut self, l: usize, [a, b]: [u32; 2]) {
        let is_row = |offset: u32| offset <= self.floor && (offset as usize).is_multiple_of(ROW_LEN);
        assert!(is_row(a) && is_row(b));
        (self.a[l], self.b[l]) = (a, b);
    }

    /// Offsets of the rows of body A and body B of lane `l`, in scalars.
    #[inline(always)]
    pub fn bodies(&self, l: usize) -> [u32; 2] {
        [self.a[l], self.b[l]]
    }

    /// Loads normal and tangents of one part.
    #[inline(always)]
    pub fn frame_part<L: Lanes<Scalar = R>>(&self, part: usize) -> [[L; 3]; 3] {
        [load3(&self.frame[0], part), load3(&self.frame[1], part), load3(&self.frame[2], part)]
    }

    /// Loads the components of normal and tangents along axis `k` of the world, of one part.
    #[inline(always)]
    pub fn frame_components<L: Lanes<Scalar = R>>(&self, k: usize, part: usize) -> [L; 3] {
        [load(&self.frame[0][k], part), load(&self.frame[1][k], part), load(&self.frame[2][k], part)]
    }

    /// Stores the components of a vector along normal and tangents, of one part.
    #[inline(always)]
    pub fn resolve<L: Lanes<Scalar = R>>(&self, part: usize, v: &[L; 3], to: &mut [L; 3]) {
        for (axis, to) in self.frame.iter().zip(to) {
            store_in_order(to, dot(&load3(axis, part), v));
        }
    }

    /// Resets lane `l` to an open contact of the floor with itself.
    pub fn clear_lane(&mut self, l: usize) {
        (self.a[l], self.b[l], self.counts[l]) = (self.floor, self.floor, 0);
        for axis in self.frame.iter_mut().flatten().chain(&mut self.centroid).chain([
            &mut self.damping_time,
            &mut self.mu_kinetic,
            &mut self.mu_excess,
        ]) {
            axis.0[l] = R::default();
        }
        for p in &mut self.points {
            for array in p
                .arm
                .iter_mut()
                .chain(&mut p.friction_arm)
                .chain(&mut p.tangential)
                .chain([&mut p.maxwell, &mut p.stiffness])
            {
                array.0[l] = R::default();
            }
            p.gap.0[l] = R::from_f64(1.0);
        }
    }
}

/// Row of two vectors, x, y, z, 0, x, y, z, 0: velocity and spin (m and rad per substep), or force
/// and torque (N and N m).
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub struct Row<R>(pub [R; ROW_LEN]);

impl<R: Real> Row<R> {
    /// Row of two vectors.
    pub fn new(x: DVec3, y: DVec3) -> Self {
        Self([x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0].map(R::from_f64))
    }

    /// Adds to the two vectors.
    pub fn add(&mut self, x: DVec3, y: DVec3) {
        for k in 0..3 {
            self.0[k] = self.0[k] + R::from_f64(x[k]);
            self.0[k + 4] = self.0[k + 4] + R::from_f64(y[k]);
        }
    }
}

/// Row at an offset in scalars, without a bounds check. The unit is a scalar because x86 scales an
/// index by the size of a scalar in the load itself, but not by that of a row.
///
/// # Safety
/// The offset is a multiple of [`ROW_LEN`], and below the number of scalars in `rows`:
/// [`Group::is_within`] tests that for all of a group.
#[inline(always)]
pub unsafe fn row<R>(rows: &[Row<R>], offset: u32) -> &[R; ROW_LEN] {
    debug_assert!((offset as usize).is_multiple_of(ROW_LEN) && (offset as usize) < ROW_LEN * rows.len());
    // SAFETY: the caller has tested the offset, and a row is `ROW_LEN` scalars and nothing else.
    unsafe { &*rows.as_ptr().cast::<R>().add(offset as usize).cast() }
}

/// Mutable row at an offset in scalars, without a bounds check.
///
/// # Safety
/// As for [`row`].
#[inline(always)]
pub unsafe fn row_mut<R>(rows: &mut [Row<R>], offset: u32) -> &mut [R; ROW_LEN] {
    debug_assert!((offset as usize).is_multiple_of(ROW_LEN) && (offset as usize) < ROW_LEN * rows.len());
    // SAFETY: as for `row`.
    unsafe { &mut *rows.as_mut_ptr().cast::<R>().add(offset as usize).cast() }
}

/// Stores a value before all later stores of the program.
///
/// Matters to WebAssembly only: LLVM otherwise reorders stores, and V8, which hoists loads above
/// the next store, then needs more registers than it has and spills.
#[inline(always)]
pub fn store_in_order<T: Copy>(to: &mut T, x: T) {
    if cfg!(target_arch = "wasm32") {
        // SAFETY: a reference is valid for writes, and a `Copy` type needs no drop.
        unsafe { std::ptr::write_volatile(to, x) }
    } else {
        *to = x;
    }
}
