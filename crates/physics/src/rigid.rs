//! Rigid bodies in the inner loop: a velocity and a spin each, and a force and a torque.

use glam::{DMat3, DVec3};

use crate::body::world_tensor;
use crate::form::{Form, Loading, Motion, Push, Taken, lanes};
use crate::kernel::{
    Group, Lane, Row, add, cross, dot, load, load3, put3, row, row_mut, store3, vector, write_in_turn,
};
use crate::simd::lanes::{Lanes, Real, RowRegister as _};

/// A body a lane.
#[derive(Debug, Clone, Copy)]
pub struct Rigid<R> {
    /// Velocity of the centre and spin, m and rad per substep.
    velocity: [Lane<R>; 3],
    spin: [Lane<R>; 3],
    /// Centre from the cluster's reference point, m.
    offset: [Lane<R>; 3],
    /// h² / m: what a force of 1 N adds to the velocity in a substep.
    ease: Lane<R>,
    /// h² times the inverse inertia in the world: xx, yy, zz; xy, xz, yz.
    turning_ease: [[Lane<R>; 3]; 2],
    /// Displacement and turn since the last sync, m and rad.
    shift: [Lane<R>; 3],
    turn: [Lane<R>; 3],
    /// Distance to the corners, m.
    radius: Lane<R>,
    /// Travel (m) and turn (rad) that end the batch.
    travel_bound: Lane<R>,
    turn_bound: Lane<R>,
}

/// Relative velocity and spin of two rigid bodies, along normal, tangent, tangent.
#[derive(Debug, Clone, Copy)]
pub struct Turning<L> {
    v: [L; 3],
    w: [L; 3],
}

/// Force and moment about the centroid along normal, tangent, tangent.
#[derive(Debug, Clone, Copy)]
pub struct Wrench<L> {
    f: [L; 3],
    m: [L; 3],
}

impl<L: Lanes> Motion<L> for Turning<L> {
    type Wrench = Wrench<L>;

    #[inline(always)]
    fn still() -> Self {
        Self { v: [L::zero(); 3], w: [L::zero(); 3] }
    }

    #[inline(always)]
    fn no_force() -> Wrench<L> {
        Wrench { f: [L::zero(); 3], m: [L::zero(); 3] }
    }

    #[inline(always)]
    fn at(&self, [r1, r2]: &[L; 2], [q1, q2]: &[L; 2]) -> [L; 3] {
        let (v, w) = (&self.v, &self.w);
        [v[0] + (w[1] * *r2 - w[2] * *r1), v[1] - w[0] * *q2, v[2] + w[0] * *q1]
    }

    #[inline(always)]
    fn add(sum: &mut Wrench<L>, &[pull, g1, g2]: &[L; 3], [r1, r2]: &[L; 2], [q1, q2]: &[L; 2]) {
        sum.f[0] -= pull;
        sum.f[1] -= g1;
        sum.f[2] -= g2;
        sum.m[0] -= *q1 * g2 - *q2 * g1;
        sum.m[1] -= *r2 * pull;
        sum.m[2] += *r1 * pull;
    }
}

/// Adds a number at place `k` of the rows to the force on B and takes it from that on A.
#[inline(always)]
fn add_at<R: Real>(force: &mut [Row<R>], [a, b]: [u32; 2], k: usize, x: R) {
    let a = row_mut(force, a);
    a[k] = a[k] - x;
    let b = row_mut(force, b);
    b[k] = b[k] + x;
}

/// [`Form::react`] of a lane that has a register for itself: rows need no turning, and each number is added where it belongs as soon as it is
/// reckoned.
#[inline(always)]
fn react_alone<L: Lanes>(group: &Group<L::Scalar>, lane: usize, sum: &mut Wrench<L>, force: &mut [Row<L::Scalar>]) {
    let bodies = [group.a[lane], group.b[lane]];
    let Wrench { mut f, m } = *sum;
    let along = f;
    for (k, f) in f.iter_mut().enumerate() {
        let axes = group.axes_along::<L>(k, lane);
        *f = dot(&axes, &along);
        add_at(force, bodies, k, f.first());
        write_in_turn(&mut sum.m[k], dot(&axes, &m));
    }
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let turning = load::<L>(&group.arm[i], lane) * f[j] - load::<L>(&group.arm[j], lane) * f[i];
        add_at(force, bodies, 4 + k, (turning + sum.m[k]).first());
    }
}

impl<R: Real> Form<R> for Rigid<R> {
    const ROWS: usize = 1;
    type Motion<L: Lanes<Scalar = R>> = Turning<L>;

    fn empty() -> Self {
        let far = lanes(1e30);
        let zero = Lane::default();
        Self {
            velocity: [zero; 3],
            spin: [zero; 3],
            offset: [zero; 3],
            ease: zero,
            turning_ease: [[zero; 3]; 2],
            shift: [zero; 3],
            turn: [zero; 3],
            radius: zero,
            travel_bound: far,
            turn_bound: far,
        }
    }

    fn load(&mut self, l: usize, body: &Loading, velocity: &mut [Row<R>], load: &mut [Row<R>]) {
        let h = body.h;
        let (v, w) = (body.velocity * h, body.spin * h);
        velocity[0] = Row::of(v - w.cross(body.offset), w);
        put3(&mut self.velocity, l, v);
        put3(&mut self.spin, l, w);
        put3(&mut self.offset, l, body.offset);
        put3(&mut self.shift, l, DVec3::ZERO);
        put3(&mut self.turn, l, DVec3::ZERO);
        self.radius.0[l] = R::from_f64(body.radius);
        self.travel_bound.0[l] = R::from_f64(body.reach);
        self.turn_bound.0[l] = R::from_f64(body.turn);
        // one that flies is moved by a parabola instead, but here it is seen to reach its bound
        let (force, torque) = if body.moves { (body.force, body.torque) } else { (DVec3::ZERO, DVec3::ZERO) };
        load[0] = Row::of(force, torque + body.offset.cross(force));
        self.ease.0[l] = R::from_f64(if body.moves { h * h / body.mass } else { 0.0 });
        let tensor = if body.moves { world_tensor(body.orientation, h * h / body.inertia) } else { DMat3::ZERO };
        let (x, y, z) = (tensor.x_axis, tensor.y_axis, tensor.z_axis);
        put3(&mut self.turning_ease[0], l, DVec3::new(x.x, y.y, z.z));
        put3(&mut self.turning_ease[1], l, DVec3::new(x.y, x.z, y.z));
    }

    #[inline(always)]
    fn relative<L: Lanes<Scalar = R>>(group: &Group<R>, part: usize, velocity: &[Row<R>], motion: &mut Turning<L>) {
        let first = L::WIDTH * part;
        // relative velocity at the reference point and relative spin, B over A; then at the centroid, along the frame
        let d = L::columns(|l| {
            L::Row::read(row(velocity, group.b[first + l])) - L::Row::read(row(velocity, group.a[first + l]))
        });
        let dw = [d[4], d[5], d[6]];
        let turning = cross(&dw, &load3(&group.arm, part));
        let dv = [d[0] + turning[0], d[1] + turning[1], d[2] + turning[2]];
        for (k, axis) in group.frame.iter().enumerate() {
            let axis = load3(axis, part);
            write_in_turn(&mut motion.w[k], dot(&axis, &dw));
            write_in_turn(&mut motion.v[k], dot(&axis, &dv));
        }
    }

    #[inline(always)]
    fn react<L: Lanes<Scalar = R>>(group: &Group<R>, part: usize, sum: &mut Wrench<L>, force: &mut [Row<R>]) {
        if L::WIDTH == 1 {
            return react_alone(group, part, sum, force);
        }
        let first = L::WIDTH * part;
        // one force and one moment about the reference point, equal and opposite on the two
        let Wrench { f, m } = *sum;
        for k in 0..3 {
            let axes = group.axes_along::<L>(k, part);
            sum.f[k] = dot(&axes, &f);
            sum.m[k] = dot(&axes, &m);
        }
        let Wrench { f, m } = *sum;
        let t = cross(&load3(&group.arm, part), &f);
        let zero = L::zero();
        let rows = L::rows([f[0], f[1], f[2], zero, t[0] + m[0], t[1] + m[1], t[2] + m[2], zero]);
        for (l, on_b) in rows.into_iter().enumerate() {
            let a = row_mut(force, group.a[first + l]);
            (L::Row::read(a) - on_b).write(a);
            let b = row_mut(force, group.b[first + l]);
            (L::Row::read(b) + on_b).write(b);
        }
    }

    /// Semi-implicit Euler: places with the velocity that the springs have just seen, then velocities with the forces.
    #[inline(always)]
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    ) {
        let f = L::columns(|l| L::Row::read(&force[l].0));
        // row by row: the slice at once would be a call where registers hold four numbers, which takes 4 % longer
        for (to, from) in force.iter_mut().zip(load) {
            *to = *from;
        }
        let ease = self::load::<L>(&self.ease, part);
        let mut v = load3::<L>(&self.velocity, part);
        add(&mut self.shift, part, &v);
        for k in 0..3 {
            v[k] += ease * f[k];
        }
        store3(&mut self.velocity, part, &v);
        // torque about the centre
        let offset = load3::<L>(&self.offset, part);
        let lever = cross(&offset, &[f[0], f[1], f[2]]);
        let t = [f[4] - lever[0], f[5] - lever[1], f[6] - lever[2]];
        let w = load3::<L>(&self.spin, part);
        add(&mut self.turn, part, &w);
        let [diagonal, beside] = &self.turning_ease;
        let [xy, xz] = [self::load::<L>(&beside[0], part), self::load::<L>(&beside[1], part)];
        let wx = w[0] + (self::load::<L>(&diagonal[0], part) * t[0] + xy * t[1] + xz * t[2]);
        wx.store(&mut self.spin[0].0, part);
        let yz = self::load::<L>(&beside[2], part);
        let wy = w[1] + (xy * t[0] + self::load::<L>(&diagonal[1], part) * t[1] + yz * t[2]);
        wy.store(&mut self.spin[1].0, part);
        let wz = w[2] + (xz * t[0] + yz * t[1] + self::load::<L>(&diagonal[2], part) * t[2]);
        wz.store(&mut self.spin[2].0, part);
        let w = [wx, wy, wz];
        let turning = cross(&w, &offset);
        let zero = L::zero();
        let row = [v[0] - turning[0], v[1] - turning[1], v[2] - turning[2], zero, w[0], w[1], w[2], zero];
        for (row, to) in L::rows(row).into_iter().zip(velocity) {
            row.write(&mut to.0);
        }
    }

    #[inline(always)]
    fn beyond<L: Lanes<Scalar = R>>(&self, part: usize) -> bool {
        let (shift, turn) = (load3::<L>(&self.shift, part), load3::<L>(&self.turn, part));
        let (shift, turn) = (dot(&shift, &shift), dot(&turn, &turn));
        let (radius, travel_bound) = (load::<L>(&self.radius, part), load::<L>(&self.travel_bound, part));
        let turn_bound = load::<L>(&self.turn_bound, part);
        let beyond = (turn_bound * turn_bound).less_than(turn);
        // Roots are for bodies that are near their bounds: (a + b)² is at most 2 (a² + b²). With room for rounding, so that it is the same
        // whoever else is in the register.
        let most = L::splat_f64(2.01) * (shift + turn * (radius * radius));
        if !L::any((travel_bound * travel_bound).less_than(most)) {
            return L::any(beyond);
        }
        L::any(travel_bound.less_than(shift.sqrt() + turn.sqrt() * radius)) || L::any(beyond)
    }

    fn displacement(&self, l: usize) -> (DVec3, DVec3) {
        (vector(&self.shift, l), vector(&self.turn, l))
    }

    fn way(&self, l: usize, rows: &mut [Row<R>]) -> f64 {
        let (shift, turn) = self.displacement(l);
        rows[0] = Row::of(shift - turn.cross(vector(&self.offset, l)), turn);
        0.0
    }

    fn motion(&self, l: usize) -> (DVec3, DVec3) {
        (vector(&self.velocity, l), vector(&self.spin, l))
    }

    fn taken(&self, l: usize, h: f64) -> Taken {
        let ((shift, turn), (v, w)) = (self.displacement(l), self.motion(l));
        Taken { shift, turn, velocity: v / h, spin: w / h, particles: None }
    }

    fn push(&self, l: usize, push: &Push, force: &mut [Row<R>]) {
        let torque = push.arm.cross(push.force) + push.torque;
        force[0].add(push.force, torque + vector(&self.offset, l).cross(push.force));
    }
}
