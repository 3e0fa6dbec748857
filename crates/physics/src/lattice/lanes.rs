//! Blocks of springs in the inner loop, a block a lane: 24 displacements and velocities each, straight-line code for the 28 springs.

#![allow(clippy::needless_range_loop, reason = "one index for several arrays of components")]

use glam::{DMat3, DVec3};

use super::springs::{KINDS, SPRINGS, ends, spring};
use super::{PARTICLES, STRAIN_INERTIA, outer, place, sign, whole_moment};
use crate::form::{Form, Loading, Motion, Push, Taken, lanes};
use crate::kernel::{
    Group, Lane, Row, cross, into_frame, load, load3, out_of_frame, put3, row, row_mut, store3, vector,
};
use crate::simd::lanes::{Lanes, ROW_LEN, Real, RowRegister as _};

/// A block a lane. Lengths and velocities are in the world, from the pose at the last sync.
#[derive(Debug, Clone, Copy)]
pub struct Lattice<R> {
    /// Displacements of the particles from their places in that pose, m, and velocities, m per substep.
    shift: [[Lane<R>; 3]; PARTICLES],
    velocity: [[Lane<R>; 3]; PARTICLES],
    /// The displacements at the last sync, m.
    first: [[Lane<R>; 3]; PARTICLES],
    /// Strain of each spring in the last substep, m².
    strain: [Lane<R>; SPRINGS],
    /// Edges between particles along the axes of the body, m.
    edge: [[Lane<R>; 3]; 3],
    /// Stiffness and damping of a kind of spring, as in [`spring`], times h² over the mass of a particle and [`STRAIN_INERTIA`], 1/m².
    stiffness: [Lane<R>; KINDS],
    damping: [Lane<R>; KINDS],
    /// The axes over eight times the distances of the particles from the centre, 1/m.
    dual: [[Lane<R>; 3]; 3],
    /// Centre from the cluster's reference point, m.
    offset: [Lane<R>; 3],
    /// h² over the mass of a particle.
    ease: Lane<R>,
    /// Sums of the displacements times the signs of the particles at the last sync, m.
    start: [[Lane<R>; 3]; 3],
    /// Half edges of the block over eight times the distances of the particles.
    spread: Lane<R>,
    /// Travel (m) and turn (rad) that end the batch.
    travel_bound: Lane<R>,
    turn_bound: Lane<R>,
    /// 1 / (|e_k|² Σ |e_j|²) over the other two edges e_j: what of a torque along an edge turns the particles, 1/m⁴.
    turning_ease: [Lane<R>; 3],
    /// 1 / (8 g) along each axis, 1/m.
    inv_lever: [Lane<R>; 3],
}

/// How two affine bodies move against each other, along normal, tangent, tangent: velocity at the centroid, and its change along each tangent.
#[derive(Debug, Clone, Copy)]
pub struct Straining<L> {
    v: [L; 3],
    along: [[L; 3]; 2],
}

/// Force, and force times place along each tangent.
#[derive(Debug, Clone, Copy)]
pub struct Moments<L> {
    f: [L; 3],
    along: [[L; 3]; 2],
}

impl<L: Lanes> Motion<L> for Straining<L> {
    type Wrench = Moments<L>;

    #[inline(always)]
    fn still() -> Self {
        Self { v: [L::zero(); 3], along: [[L::zero(); 3]; 2] }
    }

    #[inline(always)]
    fn no_force() -> Moments<L> {
        Moments { f: [L::zero(); 3], along: [[L::zero(); 3]; 2] }
    }

    #[inline(always)]
    fn at(&self, r: &[L; 2], q: &[L; 2]) -> [L; 3] {
        let [x, y] = &self.along;
        [
            self.v[0] + (x[0] * r[0] + y[0] * r[1]),
            self.v[1] + (x[1] * q[0] + y[1] * q[1]),
            self.v[2] + (x[2] * q[0] + y[2] * q[1]),
        ]
    }

    #[inline(always)]
    fn add(sum: &mut Moments<L>, pull: &[L; 3], r: &[L; 2], q: &[L; 2]) {
        for k in 0..3 {
            sum.f[k] -= pull[k];
        }
        for (along, (r, q)) in sum.along.iter_mut().zip(r.iter().zip(q)) {
            along[0] -= *r * pull[0];
            along[1] -= *q * pull[1];
            along[2] -= *q * pull[2];
        }
    }
}

impl<R: Real> Form<R> for Lattice<R> {
    /// Velocity and its change along x; its changes along y and z. Force and its moments likewise.
    const ROWS: usize = 2;
    type Motion<L: Lanes<Scalar = R>> = Straining<L>;

    fn empty() -> Self {
        let (zero, far) = (Lane::default(), lanes(1e30));
        Self {
            shift: [[zero; 3]; PARTICLES],
            velocity: [[zero; 3]; PARTICLES],
            first: [[zero; 3]; PARTICLES],
            strain: [zero; SPRINGS],
            edge: [[zero; 3]; 3],
            stiffness: [zero; KINDS],
            damping: [zero; KINDS],
            dual: [[zero; 3]; 3],
            offset: [zero; 3],
            ease: zero,
            start: [[zero; 3]; 3],
            spread: zero,
            travel_bound: far,
            turn_bound: far,
            turning_ease: [zero; 3],
            inv_lever: [zero; 3],
        }
    }

    fn load(&mut self, l: usize, body: &Loading, velocity: &mut [Row<R>], load: &mut [Row<R>]) {
        let Some((particles, half, springs)) = body.lattice else { return };
        let h = body.h;
        let axes = DMat3::from_quat(body.orientation);
        let edges = [axes.x_axis * (2.0 * half.x), axes.y_axis * (2.0 * half.y), axes.z_axis * (2.0 * half.z)];
        let mut shift = [DVec3::ZERO; PARTICLES];
        let mut rate = [DVec3::ZERO; PARTICLES];
        for i in 0..PARTICLES {
            shift[i] = axes * particles.shift[i];
            rate[i] = if body.moves { particles.velocity[i] * h } else { DVec3::ZERO };
            put3(&mut self.shift[i], l, shift[i]);
            put3(&mut self.first[i], l, shift[i]);
            put3(&mut self.velocity[i], l, rate[i]);
        }
        for (n, strain) in self.strain.iter_mut().enumerate() {
            let (i, j, _) = ends(n);
            let rest = axes * (place(half, j) - place(half, i));
            let d = shift[j] - shift[i];
            strain.0[l] = R::from_f64((rest + 0.5 * d).dot(d));
        }
        let ease = if body.moves { PARTICLES as f64 * h * h / body.mass } else { 0.0 };
        let beta = springs.damper(body.mass) / (springs.stiffness * h);
        for kind in 1..=KINDS {
            let along = |k: usize| if kind >> k & 1 == 1 { edges[k].length_squared() } else { 0.0 };
            let k = ease / STRAIN_INERTIA * springs.stiffness / (along(0) + along(1) + along(2));
            self.stiffness[kind - 1].0[l] = R::from_f64(k * (1.0 + beta));
            self.damping[kind - 1].0[l] = R::from_f64(k * beta);
        }
        for k in 0..3 {
            put3(&mut self.edge[k], l, edges[k]);
            put3(&mut self.dual[k], l, axes.col(k) / (8.0 * half[k]));
            put3(&mut self.start[k], l, (0..PARTICLES).map(|i| shift[i] * sign(i, k)).sum());
            self.inv_lever[k].0[l] = R::from_f64(1.0 / (8.0 * half[k]));
            let square = |j: usize| edges[j % 3].length_squared();
            self.turning_ease[k].0[l] = R::from_f64(1.0 / (square(k) * (square(k + 1) + square(k + 2))));
        }
        put3(&mut self.offset, l, body.offset);
        self.ease.0[l] = R::from_f64(ease);
        self.spread.0[l] = R::from_f64(1.0 / (8.0 * springs.place));
        self.travel_bound.0[l] = R::from_f64(body.reach);
        self.turn_bound.0[l] = R::from_f64(body.turn);

        let center: DVec3 = rate.iter().sum::<DVec3>() / PARTICLES as f64;
        let change = (0..3).fold(DMat3::ZERO, |sum, k| {
            let along: DVec3 = (0..PARTICLES).map(|i| rate[i] * sign(i, k)).sum();
            sum + outer(along, axes.col(k) / (8.0 * half[k]))
        });
        write_rows(velocity, center - change * body.offset, &change);
        // the centre of one that flies is moved by a parabola instead, but here it is seen to reach its bound
        let (force, torque) = if body.moves { (body.force, body.torque) } else { (DVec3::ZERO, DVec3::ZERO) };
        write_rows(load, force, &(outer(force, body.offset) + whole_moment(torque, &edges)));
    }

    #[inline(always)]
    fn relative<L: Lanes<Scalar = R>>(group: &Group<R>, part: usize, velocity: &[Row<R>], motion: &mut Straining<L>) {
        let first = L::WIDTH * part;
        let d = L::columns(|l| {
            L::Row::read(row(velocity, group.b[first + l])) - L::Row::read(row(velocity, group.a[first + l]))
        });
        let next = ROW_LEN as u32;
        let e = L::columns(|l| {
            L::Row::read(row(velocity, group.b[first + l] + next))
                - L::Row::read(row(velocity, group.a[first + l] + next))
        });
        let change = [[d[4], d[5], d[6]], [e[0], e[1], e[2]], [e[4], e[5], e[6]]];
        for (to, tangent) in motion.along.iter_mut().zip(&group.frame[1..]) {
            group.resolve(part, &out_of_frame(&change, &load3(tangent, part)), to);
        }
        let [x, y, z] = out_of_frame(&change, &load3(&group.arm, part));
        group.resolve(part, &[d[0] + x, d[1] + y, d[2] + z], &mut motion.v);
    }

    #[inline(always)]
    fn react<L: Lanes<Scalar = R>>(group: &Group<R>, part: usize, sum: &mut Moments<L>, force: &mut [Row<R>]) {
        let first = L::WIDTH * part;
        let (arm, frame) = (&load3(&group.arm, part), &group.frame_of(part));
        let f = out_of_frame(frame, &sum.f);
        let m = [f, out_of_frame(frame, &sum.along[0]), out_of_frame(frame, &sum.along[1])];
        let zero = L::zero();
        let x = out_of_frame(&m, &[arm[0], frame[1][0], frame[2][0]]);
        let rows = L::rows([f[0], f[1], f[2], zero, x[0], x[1], x[2], zero]);
        react_row::<L>(group, first, 0, rows, force);
        let y = out_of_frame(&m, &[arm[1], frame[1][1], frame[2][1]]);
        let z = out_of_frame(&m, &[arm[2], frame[1][2], frame[2][2]]);
        let rows = L::rows([y[0], y[1], y[2], zero, z[0], z[1], z[2], zero]);
        react_row::<L>(group, first, ROW_LEN as u32, rows, force);
    }

    /// Semi-implicit Euler, as for rigid bodies: places, the springs at them, then velocities.
    #[inline(always)]
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    ) {
        let mut pulls = self.outside::<L>(part, force);
        for (to, from) in force.iter_mut().zip(load) {
            *to = *from;
        }
        let mut v = [[L::zero(); 3]; PARTICLES];
        let mut u = [[L::zero(); 3]; PARTICLES];
        for i in 0..PARTICLES {
            (v[i], u[i]) = (load3::<L>(&self.velocity[i], part), load3::<L>(&self.shift[i], part));
            for k in 0..3 {
                u[i][k] += v[i][k];
            }
            store3(&mut self.shift[i], part, &u[i]);
        }
        self.springs::<L>(part, &u, &mut pulls);
        for i in 0..PARTICLES {
            for k in 0..3 {
                v[i][k] += pulls[i][k];
            }
            store3(&mut self.velocity[i], part, &v[i]);
        }
        self.write_motion::<L>(part, &v, velocity);
    }

    #[inline(always)]
    fn beyond<L: Lanes<Scalar = R>>(&self, part: usize) -> bool {
        let length = |x: [L; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        let mut u = [[L::zero(); 3]; PARTICLES];
        for i in 0..PARTICLES {
            u[i] = load3(&self.shift[i], part);
        }
        let (sum, along) = sums(&u);
        // how far the ends of the axes have gone against the centre, over their length in the second
        let (mut ends, mut turn) = (L::zero(), L::zero());
        for k in 0..3 {
            let start = load3::<L>(&self.start[k], part);
            let way = length([along[k][0] - start[0], along[k][1] - start[1], along[k][2] - start[2]]);
            ends += way;
            turn += way * self::load(&self.inv_lever[k], part);
        }
        let travel = length(sum) * L::splat_f64(1.0 / PARTICLES as f64) + ends * self::load(&self.spread, part);
        // a turn about one axis moves the ends of two
        let turn = turn * L::splat_f64(0.5);
        L::any(self::load::<L>(&self.travel_bound, part).less_than(travel))
            || L::any(self::load::<L>(&self.turn_bound, part).less_than(turn))
    }

    fn displacement(&self, l: usize) -> (DVec3, DVec3) {
        let mut start = [DVec3::ZERO; 3];
        for k in 0..3 {
            start[k] = vector(&self.start[k], l);
        }
        self.whole(l, &self.shift, start)
    }

    fn way(&self, l: usize, rows: &mut [Row<R>]) -> f64 {
        let (mut center, mut change, mut largest) = (DVec3::ZERO, DMat3::ZERO, 0.0f64);
        for (i, (now, first)) in self.shift.iter().zip(&self.first).enumerate() {
            let first = vector(first, l);
            let way = vector(now, l) - first;
            center += way / PARTICLES as f64;
            change += (0..3).map(|k| outer(way * sign(i, k), vector(&self.dual[k], l))).sum::<DMat3>();
            largest = largest.max(first.abs().max_element());
        }
        write_rows(rows, center - change * vector(&self.offset, l), &change);
        largest
    }

    fn motion(&self, l: usize) -> (DVec3, DVec3) {
        self.whole(l, &self.velocity, [DVec3::ZERO; 3])
    }

    fn taken(&self, l: usize, h: f64) -> Taken {
        let ((shift, turn), (v, w)) = (self.displacement(l), self.motion(l));
        let mut particles = [(DVec3::ZERO, DVec3::ZERO); PARTICLES];
        for (i, particle) in particles.iter_mut().enumerate() {
            *particle = (vector(&self.shift[i], l), vector(&self.velocity[i], l) / h);
        }
        Taken { shift, turn, velocity: v / h, spin: w / h, particles: Some(particles) }
    }

    fn push(&self, l: usize, push: &Push, force: &mut [Row<R>]) {
        let edges = [vector(&self.edge[0], l), vector(&self.edge[1], l), vector(&self.edge[2], l)];
        let place = vector(&self.offset, l) + push.arm;
        let moment = outer(push.force, place) + whole_moment(push.torque, &edges);
        force[0].add(push.force, moment.x_axis);
        force[1].add(moment.y_axis, moment.z_axis);
    }
}

impl<R: Real> Lattice<R> {
    /// What the forces from outside do to the velocity of each particle in a substep.
    #[inline(always)]
    fn outside<L: Lanes<Scalar = R>>(&self, part: usize, force: &[Row<R>]) -> [[L; 3]; PARTICLES] {
        let f = L::columns(|l| L::Row::read(&force[2 * l].0));
        let g = L::columns(|l| L::Row::read(&force[2 * l + 1].0));
        let offset = load3::<L>(&self.offset, part);
        let ease = load::<L>(&self.ease, part);
        let share = ease * L::splat_f64(1.0 / PARTICLES as f64);
        let mut pulls = [[L::zero(); 3]; PARTICLES];
        let mut along = [[L::zero(); 3]; 3];
        let dual = [load3::<L>(&self.dual[0], part), load3::<L>(&self.dual[1], part), load3::<L>(&self.dual[2], part)];
        for k in 0..3 {
            // moments about the centre
            let m = [f[4 + k] - f[k] * offset[0], g[k] - f[k] * offset[1], g[4 + k] - f[k] * offset[2]];
            let [x, y, z] = into_frame(&dual, &m);
            for (along, x) in along.iter_mut().zip([x, y, z]) {
                along[k] = ease * x;
            }
        }
        self.stiffen(part, &mut along);
        let [x, y, z] = along;
        for k in 0..3 {
            let (x, y, z) = (x[k], y[k], z[k]);
            let whole = f[k] * share;
            let (low, high) = (whole - z, whole + z);
            let rows = [low - y, low + y, high - y, high + y];
            for (i, row) in rows.into_iter().enumerate() {
                pulls[2 * i][k] = row - x;
                pulls[2 * i + 1][k] = row + x;
            }
        }
        pulls
    }

    /// Leaves of what accelerates the axes, apart from what turns them together, one over [`STRAIN_INERTIA`].
    #[inline(always)]
    fn stiffen<L: Lanes<Scalar = R>>(&self, part: usize, along: &mut [[L; 3]; 3]) {
        let edge = [load3::<L>(&self.edge[0], part), load3::<L>(&self.edge[1], part), load3::<L>(&self.edge[2], part)];
        // The particles turn with β where Σ e × x = Σ e × (β × e): they are the ends of the axes, and β is h² times half the angular acceleration.
        let (x, y, z) = (cross(&edge[0], &along[0]), cross(&edge[1], &along[1]), cross(&edge[2], &along[2]));
        let torque = [x[0] + y[0] + z[0], x[1] + y[1] + z[1], x[2] + y[2] + z[2]];
        let ease = load3::<L>(&self.turning_ease, part);
        let [x, y, z] = into_frame(&edge, &torque);
        let turning = out_of_frame(&edge, &[x * ease[0], y * ease[1], z * ease[2]]);
        let (keep, whole) = (L::splat_f64(1.0 / STRAIN_INERTIA), L::splat_f64(1.0 - 1.0 / STRAIN_INERTIA));
        for k in 0..3 {
            let turned = cross(&turning, &edge[k]);
            for (x, turned) in along[k].iter_mut().zip(turned) {
                *x = keep * *x + whole * turned;
            }
        }
    }

    /// What the springs do to the velocity of each particle in a substep.
    #[inline(always)]
    fn springs<L: Lanes<Scalar = R>>(&mut self, part: usize, u: &[[L; 3]; PARTICLES], pulls: &mut [[L; 3]; PARTICLES]) {
        let [x, y, z] =
            [load3::<L>(&self.edge[0], part), load3::<L>(&self.edge[1], part), load3::<L>(&self.edge[2], part)];
        // from the lower to the higher particle: the highest axis that a spring goes along, it goes upwards
        let (y_plus, y_minus) = (sum_of(&y, &x), difference(&y, &x));
        let (zx_plus, zx_minus) = (sum_of(&z, &x), difference(&z, &x));
        let (zy_plus, zy_minus) = (sum_of(&z, &y), difference(&z, &y));
        let (pp, pm) = (sum_of(&zy_plus, &x), difference(&zy_plus, &x));
        let (mp, mm) = (sum_of(&zy_minus, &x), difference(&zy_minus, &x));
        macro_rules! pull {
            ($($n:literal: $rest:expr),* $(,)?) => {
                $({
                    const ENDS: (usize, usize, usize) = ends($n);
                    let (i, j, kind) = ENDS;
                    let strain = &mut self.strain[$n];
                    let (k, c) = (load::<L>(&self.stiffness[kind - 1], part), load::<L>(&self.damping[kind - 1], part));
                    let (force, now) = spring(&u[i], &u[j], $rest, k, c, load::<L>(strain, part));
                    now.store(&mut strain.0, part);
                    for k in 0..3 {
                        pulls[i][k] += force[k];
                        pulls[j][k] -= force[k];
                    }
                })*
            };
        }
        pull! {
            // from particle 0 (- - -) to 1 (+ - -), 2 (- + -), ... 7 (+ + +)
            0: &x, 1: &y, 2: &y_plus, 3: &z, 4: &zx_plus, 5: &zy_plus, 6: &pp,
            // from 1
            7: &y_minus, 8: &y, 9: &zx_minus, 10: &z, 11: &pm, 12: &zy_plus,
            // from 2
            13: &x, 14: &zy_minus, 15: &mp, 16: &z, 17: &zx_plus,
            // from 3
            18: &mm, 19: &zy_minus, 20: &zx_minus, 21: &z,
            // from 4, 5, 6
            22: &x, 23: &y, 24: &y_plus,
            25: &y_minus, 26: &y,
            27: &x,
        }
    }

    /// Writes the rows of velocity.
    #[inline(always)]
    fn write_motion<L: Lanes<Scalar = R>>(&self, part: usize, v: &[[L; 3]; PARTICLES], velocity: &mut [Row<R>]) {
        let (sum, along) = sums(v);
        let dual = [load3::<L>(&self.dual[0], part), load3::<L>(&self.dual[1], part), load3::<L>(&self.dual[2], part)];
        let offset = load3::<L>(&self.offset, part);
        let eighth = L::splat_f64(1.0 / PARTICLES as f64);
        let zero = L::zero();
        // changes along the axes of the world
        let x = out_of_frame(&along, &[dual[0][0], dual[1][0], dual[2][0]]);
        let y = out_of_frame(&along, &[dual[0][1], dual[1][1], dual[2][1]]);
        let z = out_of_frame(&along, &[dual[0][2], dual[1][2], dual[2][2]]);
        let c = out_of_frame(&[x, y, z], &offset);
        let at = [sum[0] * eighth - c[0], sum[1] * eighth - c[1], sum[2] * eighth - c[2]];
        let first = L::rows([at[0], at[1], at[2], zero, x[0], x[1], x[2], zero]);
        let second = L::rows([y[0], y[1], y[2], zero, z[0], z[1], z[2], zero]);
        for ((first, second), to) in first.into_iter().zip(second).zip(velocity.chunks_exact_mut(2)) {
            first.write(&mut to[0].0);
            second.write(&mut to[1].0);
        }
    }

    /// The mean of vectors at the particles, and the turn in them, less what `start` has of it.
    fn whole(&self, l: usize, of: &[[Lane<R>; 3]; PARTICLES], start: [DVec3; 3]) -> (DVec3, DVec3) {
        let mut sum = DVec3::ZERO;
        let mut turn = DVec3::ZERO;
        for k in 0..3 {
            let along: DVec3 = (0..PARTICLES).map(|i| vector(&of[i], l) * sign(i, k)).sum();
            turn += 0.5 * vector(&self.dual[k], l).cross(along - start[k]);
        }
        for of in of {
            sum += vector(of, l);
        }
        (sum / PARTICLES as f64, turn)
    }
}

/// The sum of vectors at the particles, and those with the signs of the particles along each axis.
#[inline(always)]
fn sums<L: Lanes>(x: &[[L; 3]; PARTICLES]) -> ([L; 3], [[L; 3]; 3]) {
    let mut sum = [L::zero(); 3];
    let mut along = [[L::zero(); 3]; 3];
    for k in 0..3 {
        let (p0, p1, p2, p3) = (x[1][k] + x[0][k], x[3][k] + x[2][k], x[5][k] + x[4][k], x[7][k] + x[6][k]);
        let (m0, m1, m2, m3) = (x[1][k] - x[0][k], x[3][k] - x[2][k], x[5][k] - x[4][k], x[7][k] - x[6][k]);
        along[0][k] = (m0 + m1) + (m2 + m3);
        along[1][k] = (p1 - p0) + (p3 - p2);
        let (low, high) = (p0 + p1, p2 + p3);
        along[2][k] = high - low;
        sum[k] = low + high;
    }
    (sum, along)
}

#[inline(always)]
fn sum_of<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn difference<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// A vector and the columns of a matrix as the two rows of a body.
fn write_rows<R: Real>(to: &mut [Row<R>], x: DVec3, m: &DMat3) {
    to[0] = Row::of(x, m.x_axis);
    to[1] = Row::of(m.y_axis, m.z_axis);
}

/// Adds rows to those of B and takes them from those of A, `next` numbers behind the first of each.
#[inline(always)]
fn react_row<L: Lanes>(group: &Group<L::Scalar>, first: usize, next: u32, rows: L::Rows, force: &mut [Row<L::Scalar>]) {
    for (l, on_b) in rows.into_iter().enumerate() {
        let a = row_mut(force, group.a[first + l] + next);
        (L::Row::read(a) - on_b).write(a);
        let b = row_mut(force, group.b[first + l] + next);
        (L::Row::read(b) + on_b).write(b);
    }
}
