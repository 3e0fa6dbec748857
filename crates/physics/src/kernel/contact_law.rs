//! Contact law: springs, dampers, Maxwell elements and Coulomb friction at the points of all
//! contacts.
//!
//! Each result is stored as soon as it is computed: V8 hoists loads above the next store and spills
//! what its registers cannot hold, see [`store_in_order`](crate::kernel::layout::store_in_order).
//! Arrays are written out instead of mapped: a closure passed to `map` is not always inlined, which
//! costs ten times the time where wider registers are used than the program was built for.

use crate::constants::{MAXWELL_TIME, PARTING_SPEED, STRIBECK_SPEED, TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS};
use crate::derived::Derived;
use crate::kernel::body_model::{BodyModel, RelativeMotion};
use crate::kernel::layout::{Group, PointLanes, Row, SLOTS};
use crate::kernel::vector::{LaneArray, load, load3};
use crate::simd::lanes::{LANES, Lanes, Real};

/// Constants of the contact law.
#[derive(Debug, Clone, Copy)]
pub struct ContactLaw<R> {
    /// Factor by which the Maxwell element decays in a substep.
    pub maxwell_decay: R,
    /// Tangential over normal stiffness.
    pub tangential_stiffness: R,
    /// Tangential over normal ratio of damping to stiffness.
    pub tangential_damping_time: R,
    /// Displacement in a substep from which the bodies of a contact part, m; infinite where springs
    /// recover fully.
    pub parting: R,
    /// Part of the force of the springs that is left as the bodies part.
    pub recovery: R,
    /// Part of a tension of the damper that holds them back.
    pub adhesion: R,
    /// Inverse square of the displacement in a substep at [`STRIBECK_SPEED`], 1/m².
    pub stribeck: R,
}

impl<R: Real> ContactLaw<R> {
    /// Constants of a world.
    pub fn new(derived: &Derived) -> Self {
        let displacement = derived.h * STRIBECK_SPEED;
        Self {
            maxwell_decay: R::from_f64(1.0 - derived.h / MAXWELL_TIME),
            tangential_stiffness: R::from_f64(TANGENTIAL_STIFFNESS),
            tangential_damping_time: R::from_f64(TANGENTIAL_DAMPING / TANGENTIAL_STIFFNESS),
            parting: R::from_f64(if !derived.impact.recovers() { derived.h * PARTING_SPEED } else { f64::INFINITY }),
            recovery: R::from_f64(derived.impact.recovery),
            adhesion: R::from_f64(derived.impact.adhesion),
            stribeck: R::from_f64(1.0 / (displacement * displacement)),
        }
    }
}

/// State in a substep of one part of a group: as many contacts as a register has lanes.
pub struct GroupPart<L: Lanes, M: RelativeMotion<L>> {
    /// Points in the fullest lane.
    count: u8,
    motion: M,
    wrench: M::Wrench,
}

impl<L: Lanes, M: RelativeMotion<L>> GroupPart<L, M> {
    /// Parts of a group.
    pub fn of(group: &Group<L::Scalar>) -> impl Iterator<Item = Self> {
        group.counts.chunks_exact(L::WIDTH).map(|counts| {
            let count = counts.iter().fold(0, |max, &count| max.max(count));
            Self { count, motion: M::zero(), wrench: M::zero_wrench() }
        })
    }
}

/// Applies the contact law to a chunk of groups: reads velocities, advances springs, adds to
/// forces.
///
/// Each stage runs over all groups before the next one begins: its loop is short, and an
/// out-of-order processor overlaps consecutive contacts. Iterators are passed to `zip` by
/// reference, or it would walk both by a common index and multiply that in each iteration.
///
/// # Safety
/// The groups are [within](Group::is_within) the rows of `velocity` and of `force`.
#[inline(always)]
pub unsafe fn apply_contacts<L: Lanes, B: BodyModel<L::Scalar>>(
    groups: &mut [Group<L::Scalar>],
    parts: &mut [GroupPart<L, B::Motion<L>>],
    law: &ContactLaw<L::Scalar>,
    velocity: &[Row<L::Scalar>],
    force: &mut [Row<L::Scalar>],
) {
    for (group, parts) in groups.iter().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            if LANES == L::WIDTH || part.count > 0 {
                // SAFETY: as for this function.
                unsafe { B::relative_motion::<L>(group, i, velocity, &mut part.motion) };
            }
        }
    }
    for (group, parts) in groups.iter_mut().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            part.wrench = contact_wrench(group, i, part.count, law, &part.motion);
        }
    }
    for (group, parts) in groups.iter().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            if LANES == L::WIDTH || part.count > 0 {
                // SAFETY: as for this function.
                unsafe { B::apply_wrench::<L>(group, i, &mut part.wrench, force) };
            }
        }
    }
}

/// Contact law and damping of one part of a group.
#[derive(Clone, Copy)]
struct PartLaw<'a, L: Lanes> {
    part: usize,
    /// Index of the part again, see [`reload`].
    again: usize,
    law: &'a ContactLaw<L::Scalar>,
    /// Damping over stiffness, substeps.
    damping_time: L,
    /// Kinetic coefficient of friction, and what the static one exceeds it by.
    friction: [&'a LaneArray<L::Scalar>; 2],
    /// Parts of the force of the springs and of a tension of the damper that are left.
    left: [L; 2],
}

/// Returns its argument, and hides from the compiler that it is the same: what is loaded
/// with it after a store is loaded from memory, as an operand of the arithmetic. Otherwise values
/// used before and after are spilled to the stack in between, at one instruction each.
#[inline(always)]
fn reload(part: usize) -> usize {
    #[cfg(target_arch = "x86_64")]
    {
        let mut again = part;
        // SAFETY: the assembly is empty and leaves the register as it is.
        unsafe { std::arch::asm!("/* {0} */", inout(reg) again, options(pure, nomem, nostack, preserves_flags)) };
        again
    }
    #[cfg(not(target_arch = "x86_64"))]
    part
}

/// Wrench of one part of a group whose fullest lane has `count` points.
#[inline(always)]
fn contact_wrench<L: Lanes, M: RelativeMotion<L>>(
    group: &mut Group<L::Scalar>,
    part: usize,
    count: u8,
    law: &ContactLaw<L::Scalar>,
    motion: &M,
) -> M::Wrench {
    let mut wrench = M::zero_wrench();
    let damping_time = load(&group.damping_time, part);
    let friction = [&group.mu_kinetic, &group.mu_excess];
    let parting = L::splat(law.parting).less_than(motion.normal_velocity());
    let one = L::splat_f64(1.0);
    let law = PartLaw { part, again: reload(part), law, damping_time, friction, left: [one, L::zero()] };
    if L::any(parting) {
        let recovery = L::select(parting, L::splat(law.law.recovery), one);
        let left = [recovery, L::mask(parting, L::splat(law.law.adhesion))];
        contact_points::<L, M, true>(&mut group.points, count, &PartLaw { left, ..law }, motion, &mut wrench);
    } else {
        contact_points::<L, M, false>(&mut group.points, count, &law, motion, &mut wrench);
    }
    wrench
}

/// Contact law at the points of one part of a group, of which bodies part in some lane where
/// `PARTING`. The slots are unrolled by hand because the compiler keeps a loop over them.
#[inline(always)]
fn contact_points<L: Lanes, M: RelativeMotion<L>, const PARTING: bool>(
    [p, q, r, s]: &mut [PointLanes<L::Scalar>; SLOTS],
    count: u8,
    law: &PartLaw<L>,
    motion: &M,
    wrench: &mut M::Wrench,
) {
    if count > 0 {
        contact_point::<L, M, PARTING, true>(p, law, motion, wrench);
    }
    if count > 1 {
        contact_point::<L, M, PARTING, false>(q, law, motion, wrench);
    }
    if count > 2 {
        contact_point::<L, M, PARTING, false>(r, law, motion, wrench);
    }
    if count > 3 {
        contact_point::<L, M, PARTING, false>(s, law, motion, wrench);
    }
}

/// Contact law at one point of each lane, the `FIRST` of its part or another, from the motion of B
/// relative to A.
#[inline(always)]
fn contact_point<L: Lanes, M: RelativeMotion<L>, const PARTING: bool, const FIRST: bool>(
    p: &mut PointLanes<L::Scalar>,
    &PartLaw { part, again, law, damping_time, friction, left }: &PartLaw<L>,
    motion: &M,
    wrench: &mut M::Wrench,
) {
    let zero = L::zero();
    let arm = [load::<L>(&p.arm[0], part), load::<L>(&p.arm[1], part)];
    let friction_arm = load3::<L>(&p.friction_arm, part);

    // Displacement of the point in this substep, along normal, tangent, tangent, and about the
    // normal.
    let [vn, u1, u2, u3] = motion.velocity_at(&arm, &friction_arm);

    // Normal: spring, damper and Maxwell element, without tension. An open point has no stiffness.
    let gap = load::<L>(&p.gap, part) + vn;
    let closed = gap.less_than(zero);
    gap.store(&mut p.gap.0, part);
    // A register with several lanes is rarely open in all of them, so the test pays for one lane
    // only.
    if L::WIDTH == 1 && !L::any(closed) {
        zero.store(&mut p.maxwell.0, part);
        zero.store(&mut p.tangential[0].0, part);
        zero.store(&mut p.tangential[1].0, part);
        zero.store(&mut p.tangential[2].0, part);
        return;
    }
    let maxwell = L::mask(closed, load::<L>(&p.maxwell, part) * L::splat(law.maxwell_decay) + vn);
    let k = L::mask(closed, load::<L>(&p.stiffness, part));
    // A point that still closes, as a block rotates, keeps all of its force, or it would sink in.
    let spring = if PARTING {
        (gap + maxwell) * L::select(zero.less_than(vn), left[0], L::splat_f64(1.0))
    } else {
        gap + maxwell
    };
    let unlimited = k * (spring + damping_time * vn);
    let normal_force = unlimited.min(zero);
    maxwell.store(&mut p.maxwell.0, part);

    // Tangential: spring and damper within Coulomb's cone, which sliding and turning share.
    let kt = L::splat(law.tangential_stiffness) * k;
    let ct = L::splat(law.tangential_damping_time) * damping_time;
    let mut s1 = L::mask(closed, load::<L>(&p.tangential[0], part) + u1);
    let mut s2 = L::mask(closed, load::<L>(&p.tangential[1], part) + u2);
    let mut s3 = L::mask(closed, load::<L>(&p.tangential[2], part) + u3);
    let (mut g1, mut g2, mut g3) = (kt * (s1 + ct * u1), kt * (s2 + ct * u2), kt * (s3 + ct * u3));
    let limit = load::<L>(friction[0], part) * normal_force;
    let square = (g1 * g1 + g2 * g2) + g3 * g3;
    if L::any((limit * limit).less_than(square)) {
        let speed = ((u1 * u1 + u2 * u2) + u3 * u3) * L::splat(law.stribeck);
        let mu = load::<L>(friction[0], part) + load::<L>(friction[1], part) / (L::splat_f64(1.0) + speed);
        let q = cone_scale(mu * -normal_force, square);
        (s1, s2, s3, g1, g2, g3) = (s1 * q, s2 * q, s3 * q, g1 * q, g2 * q, g3 * q);
    }
    s1.store(&mut p.tangential[0].0, part);
    s2.store(&mut p.tangential[1].0, part);
    s3.store(&mut p.tangential[2].0, part);

    let arm = [load::<L>(&p.arm[0], again), load::<L>(&p.arm[1], again)];
    let normal_force = if PARTING { normal_force + (unlimited - normal_force) * left[1] } else { normal_force };
    M::add_force::<FIRST>(wrench, &[normal_force, g1, g2, g3], &arm, &load3(&p.friction_arm, again));
}

/// Factor that scales friction and its springs back to Coulomb's cone, from the limit of friction
/// and its square.
///
/// The limit falls from static to kinetic friction with the sliding speed, mu = mu_k + (mu_s -
/// mu_k) / (1 + (u / u_s)²), so that a sliding contact does not stick in each substep.
#[inline(always)]
fn cone_scale<L: Lanes>(limit: L, friction_squared: L) -> L {
    let friction = friction_squared.sqrt();
    L::select(limit.less_than(friction), limit / friction, L::splat_f64(1.0))
}
