//! Rigid body model: velocity and spin, force and torque.

use glam::{DMat3, DVec3};

use crate::body::{BodyForce, world_tensor};
use crate::constants::UNLIMITED;
use crate::kernel::body_model::{BodyDelta, BodyModel, KernelBody, RelativeMotion};
use crate::kernel::layout::{Group, Row, row, row_mut, store_in_order};
use crate::kernel::uniform_motion::Deviation;
use crate::kernel::vector::{LaneArray, add3, cross, dot, get3, load, load3, set3, store3};
use crate::simd::lanes::{Lanes, Real, RowRegister as _};

/// Rigid bodies, one for each lane.
#[derive(Debug, Clone, Copy)]
pub struct Rigid<R> {
    /// Velocity of the centre and spin, m and rad per substep.
    velocity: [LaneArray<R>; 3],
    spin: [LaneArray<R>; 3],
    /// Centre, from the cluster's reference point, m.
    offset: [LaneArray<R>; 3],
    /// h² / m: change of the velocity in a substep by a force of 1 N.
    h2_inv_mass: LaneArray<R>,
    /// h² times the inverse inertia tensor in the world: xx, yy, zz; xy, xz, yz.
    h2_inv_inertia: [[LaneArray<R>; 3]; 2],
    /// Displacement and rotation since the last sync, m and rad.
    displacement: [LaneArray<R>; 3],
    rotation: [LaneArray<R>; 3],
    /// Distance from the centre to a corner, m.
    radius: LaneArray<R>,
    /// Travel (m) and rotation (rad) that end the batch.
    travel_budget: LaneArray<R>,
    rotation_budget: LaneArray<R>,
    /// Uniform motion, and the deviation from it that ends the batch.
    deviation: Deviation<R>,
}

/// Relative velocity at the centroid and relative spin of two rigid bodies, along normal, tangent,
/// tangent.
#[derive(Debug, Clone, Copy)]
pub struct RigidMotion<L> {
    v: [L; 3],
    w: [L; 3],
}

/// Force and moment about the centroid, along normal, tangent, tangent.
#[derive(Debug, Clone, Copy)]
pub struct RigidWrench<L> {
    f: [L; 3],
    m: [L; 3],
}

impl<L: Lanes> RelativeMotion<L> for RigidMotion<L> {
    type Wrench = RigidWrench<L>;

    #[inline(always)]
    fn zero() -> Self {
        Self { v: [L::zero(); 3], w: [L::zero(); 3] }
    }

    #[inline(always)]
    fn zero_wrench() -> RigidWrench<L> {
        RigidWrench { f: [L::zero(); 3], m: [L::zero(); 3] }
    }

    #[inline(always)]
    fn normal_velocity(&self) -> L {
        self.v[0]
    }

    #[inline(always)]
    fn velocity_at(&self, [r1, r2]: &[L; 2], [q1, q2, turn]: &[L; 3]) -> [L; 4] {
        let (v, w) = (&self.v, &self.w);
        [v[0] + (w[1] * *r2 - w[2] * *r1), v[1] - w[0] * *q2, v[2] + w[0] * *q1, w[0] * *turn]
    }

    #[inline(always)]
    fn add_force<const FIRST: bool>(
        wrench: &mut RigidWrench<L>,
        &[normal, g1, g2, g3]: &[L; 4],
        [r1, r2]: &[L; 2],
        [q1, q2, turn]: &[L; 3],
    ) {
        let about_normal = (*q1 * g2 - *q2 * g1) + *turn * g3;
        if FIRST {
            *wrench = RigidWrench { f: [normal, g1, g2], m: [about_normal, *r2 * normal, L::zero() - *r1 * normal] };
            return;
        }
        wrench.f[0] += normal;
        wrench.f[1] += g1;
        wrench.f[2] += g2;
        wrench.m[0] += about_normal;
        wrench.m[1] += *r2 * normal;
        wrench.m[2] -= *r1 * normal;
    }
}

/// Adds a scalar at index `k` of the rows to the force on A and subtracts it from that on B.
///
/// # Safety
/// As for [`row`].
#[inline(always)]
unsafe fn add_component<R: Real>(force: &mut [Row<R>], [a, b]: [u32; 2], k: usize, x: R) {
    // SAFETY: as for this function.
    let a = unsafe { row_mut(force, a) };
    a[k] = a[k] + x;
    // SAFETY: as for this function.
    let b = unsafe { row_mut(force, b) };
    b[k] = b[k] - x;
}

/// [`BodyModel::apply_wrench`] for registers of one lane: rows need no transposition, and each
/// component is added as soon as it is computed, which saves registers.
///
/// # Safety
/// As for [`BodyModel::apply_wrench`].
#[inline(always)]
unsafe fn apply_scalar_wrench<L: Lanes>(
    group: &Group<L::Scalar>,
    lane: usize,
    wrench: &mut RigidWrench<L>,
    force: &mut [Row<L::Scalar>],
) {
    let bodies = group.bodies(lane);
    let RigidWrench { mut f, m } = *wrench;
    let in_frame = f;
    for (k, f) in f.iter_mut().enumerate() {
        let components = group.frame_components::<L>(k, lane);
        *f = dot(&components, &in_frame);
        // SAFETY: as for this function.
        unsafe { add_component(force, bodies, k, f.first()) };
        store_in_order(&mut wrench.m[k], dot(&components, &m));
    }
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let moment = load::<L>(&group.centroid[i], lane) * f[j] - load::<L>(&group.centroid[j], lane) * f[i];
        // SAFETY: as for this function.
        unsafe { add_component(force, bodies, 4 + k, (moment + wrench.m[k]).first()) };
    }
}

impl<R: Real> BodyModel<R> for Rigid<R> {
    const ROWS: usize = 1;
    type Motion<L: Lanes<Scalar = R>> = RigidMotion<L>;

    fn empty() -> Self {
        let unlimited = LaneArray::splat(UNLIMITED);
        let zero = LaneArray::default();
        Self {
            velocity: [zero; 3],
            spin: [zero; 3],
            offset: [zero; 3],
            h2_inv_mass: zero,
            h2_inv_inertia: [[zero; 3]; 2],
            displacement: [zero; 3],
            rotation: [zero; 3],
            radius: zero,
            travel_budget: unlimited,
            rotation_budget: unlimited,
            deviation: Deviation::empty(),
        }
    }

    fn load(&mut self, l: usize, body: &KernelBody, velocity: &mut [Row<R>], load: &mut [Row<R>]) {
        let h = body.h;
        let (v, w) = (body.velocity * h, body.spin * h);
        velocity[0] = Row::new(v - w.cross(body.offset), w);
        set3(&mut self.velocity, l, v);
        set3(&mut self.spin, l, w);
        set3(&mut self.offset, l, body.offset);
        set3(&mut self.displacement, l, DVec3::ZERO);
        set3(&mut self.rotation, l, DVec3::ZERO);
        self.radius.0[l] = R::from_f64(body.radius);
        self.travel_budget.0[l] = R::from_f64(body.travel_budget);
        self.rotation_budget.0[l] = R::from_f64(body.rotation_budget);
        self.deviation.load(l, body);
        // The sync replaces the motion of a body in free flight by a parabola. The loop integrates
        // it all the same, to see when it uses up its budget.
        let (force, torque) = if body.active { (body.force, body.torque) } else { (DVec3::ZERO, DVec3::ZERO) };
        load[0] = Row::new(force, torque + body.offset.cross(force));
        self.h2_inv_mass.0[l] = R::from_f64(if body.active { h * h / body.mass } else { 0.0 });
        let tensor = if body.active { world_tensor(body.orientation, h * h / body.inertia) } else { DMat3::ZERO };
        let (x, y, z) = (tensor.x_axis, tensor.y_axis, tensor.z_axis);
        set3(&mut self.h2_inv_inertia[0], l, DVec3::new(x.x, y.y, z.z));
        set3(&mut self.h2_inv_inertia[1], l, DVec3::new(x.y, x.z, y.z));
    }

    #[inline(always)]
    unsafe fn relative_motion<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        velocity: &[Row<R>],
        motion: &mut RigidMotion<L>,
    ) {
        let first = L::WIDTH * part;
        // Velocity at the reference point and spin of B relative to A; then at the centroid, in the
        // frame.
        // SAFETY: as for this function.
        let of = |offset| L::Row::read(unsafe { row(velocity, offset) });
        let d = L::columns(|l| {
            let [a, b] = group.bodies(first + l);
            of(b) - of(a)
        });
        let dw = [d[4], d[5], d[6]];
        let lever = cross(&dw, &load3(&group.centroid, part));
        let dv = [d[0] + lever[0], d[1] + lever[1], d[2] + lever[2]];
        for (k, axis) in group.frame.iter().enumerate() {
            let axis = load3(axis, part);
            store_in_order(&mut motion.w[k], dot(&axis, &dw));
            store_in_order(&mut motion.v[k], dot(&axis, &dv));
        }
    }

    #[inline(always)]
    unsafe fn apply_wrench<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        wrench: &mut RigidWrench<L>,
        force: &mut [Row<R>],
    ) {
        if L::WIDTH == 1 {
            // SAFETY: as for this function.
            return unsafe { apply_scalar_wrench(group, part, wrench, force) };
        }
        let first = L::WIDTH * part;
        // Force and moment about the reference point, equal and opposite for the two bodies.
        let RigidWrench { f, m } = *wrench;
        for k in 0..3 {
            let components = group.frame_components::<L>(k, part);
            wrench.f[k] = dot(&components, &f);
            wrench.m[k] = dot(&components, &m);
        }
        let RigidWrench { f, m } = *wrench;
        let t = cross(&load3(&group.centroid, part), &f);
        let zero = L::zero();
        let rows = L::rows([f[0], f[1], f[2], zero, t[0] + m[0], t[1] + m[1], t[2] + m[2], zero]);
        for (l, on_a) in rows.into_iter().enumerate() {
            let [a, b] = group.bodies(first + l);
            // SAFETY: as for this function.
            let a = unsafe { row_mut(force, a) };
            (L::Row::read(a) + on_a).write(a);
            // SAFETY: as for this function.
            let b = unsafe { row_mut(force, b) };
            (L::Row::read(b) - on_a).write(b);
        }
    }

    /// Semi-implicit Euler: displacements with the velocity that the contact law has seen, then
    /// velocities with the forces.
    #[inline(always)]
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    ) {
        let f = L::columns(|l| L::Row::read(&force[l].0));
        // Row by row: with registers of four lanes, copying the slice would be a call that costs 4
        // %.
        for (to, from) in force.iter_mut().zip(load) {
            *to = *from;
        }
        let h2_inv_mass = self::load::<L>(&self.h2_inv_mass, part);
        let mut v = load3::<L>(&self.velocity, part);
        add3(&mut self.displacement, part, &v);
        for k in 0..3 {
            v[k] += h2_inv_mass * f[k];
        }
        store3(&mut self.velocity, part, &v);
        // Torque about the centre.
        let offset = load3::<L>(&self.offset, part);
        let moment = cross(&offset, &[f[0], f[1], f[2]]);
        let t = [f[4] - moment[0], f[5] - moment[1], f[6] - moment[2]];
        let w = load3::<L>(&self.spin, part);
        add3(&mut self.rotation, part, &w);
        let [diagonal, off_diagonal] = &self.h2_inv_inertia;
        let [xy, xz] = [self::load::<L>(&off_diagonal[0], part), self::load::<L>(&off_diagonal[1], part)];
        let wx = w[0] + (self::load::<L>(&diagonal[0], part) * t[0] + xy * t[1] + xz * t[2]);
        wx.store(&mut self.spin[0].0, part);
        let yz = self::load::<L>(&off_diagonal[2], part);
        let wy = w[1] + (xy * t[0] + self::load::<L>(&diagonal[1], part) * t[1] + yz * t[2]);
        wy.store(&mut self.spin[1].0, part);
        let wz = w[2] + (xz * t[0] + yz * t[1] + self::load::<L>(&diagonal[2], part) * t[2]);
        wz.store(&mut self.spin[2].0, part);
        let w = [wx, wy, wz];
        let lever = cross(&w, &offset);
        let zero = L::zero();
        let row = [v[0] - lever[0], v[1] - lever[1], v[2] - lever[2], zero, w[0], w[1], w[2], zero];
        for (row, to) in L::rows(row).into_iter().zip(velocity) {
            row.write(&mut to.0);
        }
    }

    #[inline(always)]
    fn exceeds_budget<L: Lanes<Scalar = R>>(&self, part: usize, substeps: usize) -> bool {
        let (displacement, rotation) = (load3::<L>(&self.displacement, part), load3::<L>(&self.rotation, part));
        let moved = [displacement, rotation];
        if self.deviation.is_limited() && self.deviation.exceeds_budget(part, substeps, &moved) {
            return true;
        }
        let (displacement, rotation) = (dot(&displacement, &displacement), dot(&rotation, &rotation));
        let (radius, travel_budget) = (load::<L>(&self.radius, part), load::<L>(&self.travel_budget, part));
        let rotation_budget = load::<L>(&self.rotation_budget, part);
        let exceeded = (rotation_budget * rotation_budget).less_than(rotation);
        // Roots are taken only near a budget, by (a + b)² <= 2 (a² + b²). The factor leaves room
        // for rounding, so that the result does not depend on the other lanes of the register.
        let bound = L::splat_f64(2.01) * (displacement + rotation * (radius * radius));
        if !L::any((travel_budget * travel_budget).less_than(bound)) {
            return L::any(exceeded);
        }
        L::any(travel_budget.less_than(displacement.sqrt() + rotation.sqrt() * radius)) || L::any(exceeded)
    }

    fn add_substeps(&mut self, substeps: usize) {
        self.deviation.add_substeps(substeps);
    }

    fn deviation(&self, l: usize) -> (DVec3, DVec3) {
        self.deviation.after(l, self.displacement(l))
    }

    fn displacement(&self, l: usize) -> (DVec3, DVec3) {
        (get3(&self.displacement, l), get3(&self.rotation, l))
    }

    fn displacement_rows(&self, l: usize, rows: &mut [Row<R>]) -> f64 {
        let (displacement, rotation) = self.displacement(l);
        rows[0] = Row::new(displacement - rotation.cross(get3(&self.offset, l)), rotation);
        0.0
    }

    fn twist(&self, l: usize) -> (DVec3, DVec3) {
        (get3(&self.velocity, l), get3(&self.spin, l))
    }

    fn delta(&self, l: usize, h: f64) -> BodyDelta {
        let ((displacement, rotation), (v, w)) = (self.displacement(l), self.twist(l));
        BodyDelta { displacement, rotation, velocity: v / h, spin: w / h, particles: None }
    }

    fn add_force(&self, l: usize, applied: &BodyForce, force: &mut [Row<R>]) {
        let torque = applied.arm.cross(applied.force) + applied.torque;
        force[0].add(applied.force, torque + get3(&self.offset, l).cross(applied.force));
    }
}
