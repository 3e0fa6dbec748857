//! Lattice body model: 24 displacements and velocities for each block, with unrolled code for the
//! 28 springs.

#![allow(clippy::needless_range_loop, reason = "one index for several arrays of components")]

use glam::{DMat3, DVec3};

use crate::body::BodyForce;
use crate::constants::{SPIN_STRAIN, STRAIN_INERTIA, UNLIMITED};
use crate::kernel::affine_motion::{AffineMotion, AffineWrench};
use crate::kernel::body_model::{BodyDelta, BodyModel, KernelBody};
use crate::kernel::edge_rotation::{EdgeInertia, common_rotation};
use crate::kernel::layout::{Group, Row, row, row_mut};
use crate::kernel::spring::spring;
use crate::kernel::uniform_motion::Deviation;
use crate::kernel::vector::{LaneArray, cross, get3, into_frame, load, load3, out_of_frame, set3, store3};
use crate::lattice::affine::{PARTICLES, outer, rest_position, sign, torque_moment};
use crate::lattice::springs::{KINDS, SPRINGS, Springs, ends};
use crate::simd::lanes::{Lanes, ROW_LEN, Real, RowRegister as _};

/// Blocks of springs, one for each lane. Lengths and velocities are in the world, relative to the
/// pose at the last sync.
#[derive(Debug, Clone, Copy)]
pub struct Lattice<R> {
    /// Displacements of the particles from their rest positions in that pose, m, and velocities, m
    /// per substep.
    displacement: [[LaneArray<R>; 3]; PARTICLES],
    velocity: [[LaneArray<R>; 3]; PARTICLES],
    /// Displacements at the last sync, m.
    initial: [[LaneArray<R>; 3]; PARTICLES],
    /// Strain of each spring in the last substep, m².
    strain: [LaneArray<R>; SPRINGS],
    /// Edges between particles along the axes of the body, m.
    edge: [[LaneArray<R>; 3]; 3],
    /// Stiffness and damping of each kind of spring, as in [`spring`], times h² over the mass of a
    /// particle and [`STRAIN_INERTIA`], 1/m².
    stiffness: [LaneArray<R>; KINDS],
    damping: [LaneArray<R>; KINDS],
    /// Axes over eight times the distances of the particles from the centre, 1/m.
    dual: [[LaneArray<R>; 3]; 3],
    /// Centre, from the cluster's reference point, m.
    offset: [LaneArray<R>; 3],
    /// h² over the mass of a particle.
    h2_inv_mass: LaneArray<R>,
    /// Sums of the displacements times the signs of the particles, at the last sync, m.
    initial_sums: [[LaneArray<R>; 3]; 3],
    /// Half edges of the block over eight times the distances of the particles.
    extent: LaneArray<R>,
    /// Travel (m) and rotation (rad) that end the batch.
    travel_budget: LaneArray<R>,
    rotation_budget: LaneArray<R>,
    /// Uniform motion, and the deviation from it that ends the batch.
    deviation: Deviation<R>,
    /// 1 / (|e_k|² Σ |e_j|²) with the sum over the two other edges: rotation of the edges over the
    /// torque along an edge, 1/m⁴.
    inv_rotation: [LaneArray<R>; 3],
    /// 1 / (8 g) along each axis, 1/m.
    inv_distance: [LaneArray<R>; 3],
    /// Part of the centripetal acceleration that needs no force, for blocks that spin fast; zero
    /// for others.
    centripetal: LaneArray<R>,
}

impl<R: Real> BodyModel<R> for Lattice<R> {
    /// Velocity and its change along x; its changes along y and z. Force and its moments likewise.
    const ROWS: usize = 2;
    type Motion<L: Lanes<Scalar = R>> = AffineMotion<L>;

    fn empty() -> Self {
        let (zero, unlimited) = (LaneArray::default(), LaneArray::splat(UNLIMITED));
        Self {
            displacement: [[zero; 3]; PARTICLES],
            velocity: [[zero; 3]; PARTICLES],
            initial: [[zero; 3]; PARTICLES],
            strain: [zero; SPRINGS],
            edge: [[zero; 3]; 3],
            stiffness: [zero; KINDS],
            damping: [zero; KINDS],
            dual: [[zero; 3]; 3],
            offset: [zero; 3],
            h2_inv_mass: zero,
            initial_sums: [[zero; 3]; 3],
            extent: zero,
            travel_budget: unlimited,
            rotation_budget: unlimited,
            deviation: Deviation::empty(),
            inv_rotation: [zero; 3],
            inv_distance: [zero; 3],
            centripetal: zero,
        }
    }

    fn load(&mut self, l: usize, body: &KernelBody, velocity: &mut [Row<R>], load: &mut [Row<R>]) {
        let Some((particles, half, springs)) = body.lattice else { return };
        let h = body.h;
        let axes = DMat3::from_quat(body.orientation);
        let edges = [axes.x_axis * (2.0 * half.x), axes.y_axis * (2.0 * half.y), axes.z_axis * (2.0 * half.z)];
        let mut displacement = [DVec3::ZERO; PARTICLES];
        let mut rate = [DVec3::ZERO; PARTICLES];
        for i in 0..PARTICLES {
            displacement[i] = axes * particles.displacement[i];
            rate[i] = if body.active { particles.velocity[i] * h } else { DVec3::ZERO };
            set3(&mut self.displacement[i], l, displacement[i]);
            set3(&mut self.initial[i], l, displacement[i]);
            set3(&mut self.velocity[i], l, rate[i]);
        }
        for (n, strain) in self.strain.iter_mut().enumerate() {
            let (i, j, _) = ends(n);
            let rest = axes * (rest_position(half, j) - rest_position(half, i));
            let d = displacement[j] - displacement[i];
            strain.0[l] = R::from_f64((rest + 0.5 * d).dot(d));
        }
        self.load_springs(l, body, springs, &edges);
        for k in 0..3 {
            set3(&mut self.edge[k], l, edges[k]);
            set3(&mut self.dual[k], l, axes.col(k) / (8.0 * half[k]));
            set3(&mut self.initial_sums[k], l, (0..PARTICLES).map(|i| displacement[i] * sign(i, k)).sum());
            self.inv_distance[k].0[l] = R::from_f64(1.0 / (8.0 * half[k]));
            let square = |j: usize| edges[j % 3].length_squared();
            self.inv_rotation[k].0[l] = R::from_f64(1.0 / (square(k) * (square(k + 1) + square(k + 2))));
        }
        let spins = body.active && body.spin.length_squared() * body.mass > SPIN_STRAIN * springs.stiffness;
        self.centripetal.0[l] = R::from_f64(if spins { 1.0 - 1.0 / STRAIN_INERTIA } else { 0.0 });
        set3(&mut self.offset, l, body.offset);
        self.extent.0[l] = R::from_f64(1.0 / (8.0 * springs.inset));
        self.travel_budget.0[l] = R::from_f64(body.travel_budget);
        self.rotation_budget.0[l] = R::from_f64(body.rotation_budget);
        self.deviation.load(l, body);

        let center: DVec3 = rate.iter().sum::<DVec3>() / PARTICLES as f64;
        let gradient = (0..3).fold(DMat3::ZERO, |sum, k| {
            let along: DVec3 = (0..PARTICLES).map(|i| rate[i] * sign(i, k)).sum();
            sum + outer(along, axes.col(k) / (8.0 * half[k]))
        });
        set_rows(velocity, center - gradient * body.offset, &gradient);
        // The sync replaces the motion of a centre in free flight by a parabola. The loop
        // integrates it all the same, to see when the body uses up its budget.
        let (force, torque) = if body.active { (body.force, body.torque) } else { (DVec3::ZERO, DVec3::ZERO) };
        set_rows(load, force, &(outer(force, body.offset) + torque_moment(torque, &edges)));
    }

    #[inline(always)]
    unsafe fn relative_motion<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        velocity: &[Row<R>],
        motion: &mut AffineMotion<L>,
    ) {
        let first = L::WIDTH * part;
        // SAFETY: as for this function.
        let of = |offset| L::Row::read(unsafe { row(velocity, offset) });
        let d = L::columns(|l| {
            let [a, b] = group.bodies(first + l);
            of(b) - of(a)
        });
        let next = ROW_LEN as u32;
        let e = L::columns(|l| {
            let [a, b] = group.bodies(first + l);
            of(b + next) - of(a + next)
        });
        let gradient = [[d[4], d[5], d[6]], [e[0], e[1], e[2]], [e[4], e[5], e[6]]];
        for (to, tangent) in motion.gradient.iter_mut().zip(&group.frame[1..]) {
            group.resolve(part, &out_of_frame(&gradient, &load3(tangent, part)), to);
        }
        let [x, y, z] = out_of_frame(&gradient, &load3(&group.centroid, part));
        group.resolve(part, &[d[0] + x, d[1] + y, d[2] + z], &mut motion.v);
    }

    #[inline(always)]
    unsafe fn apply_wrench<L: Lanes<Scalar = R>>(
        group: &Group<R>,
        part: usize,
        wrench: &mut AffineWrench<L>,
        force: &mut [Row<R>],
    ) {
        let first = L::WIDTH * part;
        let (arm, frame) = (&load3(&group.centroid, part), &group.frame_part(part));
        let f = out_of_frame(frame, &wrench.f);
        let m = [f, out_of_frame(frame, &wrench.moments[0]), out_of_frame(frame, &wrench.moments[1])];
        let zero = L::zero();
        let x = out_of_frame(&m, &[arm[0], frame[1][0], frame[2][0]]);
        let rows = L::rows([f[0], f[1], f[2], zero, x[0], x[1], x[2], zero]);
        // SAFETY: as for this function.
        unsafe { add_rows::<L>(group, first, 0, rows, force) };
        let y = out_of_frame(&m, &[arm[1], frame[1][1], frame[2][1]]);
        let z = out_of_frame(&m, &[arm[2], frame[1][2], frame[2][2]]);
        let rows = L::rows([y[0], y[1], y[2], zero, z[0], z[1], z[2], zero]);
        // SAFETY: as for this function.
        unsafe { add_rows::<L>(group, first, ROW_LEN as u32, rows, force) };
    }

    /// Semi-implicit Euler, as for rigid bodies: displacements, spring forces there, then
    /// velocities.
    #[inline(always)]
    fn integrate<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        velocity: &mut [Row<R>],
        force: &mut [Row<R>],
        load: &[Row<R>],
    ) {
        let mut change = self.external_change::<L>(part, force);
        for (to, from) in force.iter_mut().zip(load) {
            *to = *from;
        }
        let mut v = [[L::zero(); 3]; PARTICLES];
        let mut u = [[L::zero(); 3]; PARTICLES];
        for i in 0..PARTICLES {
            (v[i], u[i]) = (load3::<L>(&self.velocity[i], part), load3::<L>(&self.displacement[i], part));
            for k in 0..3 {
                u[i][k] += v[i][k];
            }
            store3(&mut self.displacement[i], part, &u[i]);
        }
        self.add_springs::<L>(part, &u, &mut change);
        if L::any(L::zero().less_than(self::load(&self.centripetal, part))) {
            self.add_centripetal::<L>(part, [&u, &v], &mut change);
        }
        for i in 0..PARTICLES {
            for k in 0..3 {
                v[i][k] += change[i][k];
            }
            store3(&mut self.velocity[i], part, &v[i]);
        }
        self.write_velocity_rows::<L>(part, &v, velocity);
    }

    #[inline(always)]
    fn exceeds_budget<L: Lanes<Scalar = R>>(&self, part: usize, substeps: usize) -> bool {
        let length = |x: [L; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        let mut u = [[L::zero(); 3]; PARTICLES];
        for i in 0..PARTICLES {
            u[i] = load3(&self.displacement[i], part);
        }
        let (sum, along) = signed_sums(&u);
        // Displacement of the ends of the axes against the centre; divided by their length, the
        // rotation.
        let (mut ends, mut rotation, mut change) = (L::zero(), L::zero(), [[L::zero(); 3]; 3]);
        for k in 0..3 {
            change[k] = difference(&along[k], &load3::<L>(&self.initial_sums[k], part));
            let displacement = length(change[k]);
            ends += displacement;
            rotation += displacement * self::load(&self.inv_distance[k], part);
        }
        let travel = length(sum) * L::splat_f64(1.0 / PARTICLES as f64) + ends * self::load(&self.extent, part);
        if self.deviation.is_limited() {
            let mut moved = [sum, [L::zero(); 3]];
            for k in 0..3 {
                moved[0][k] = sum[k] * L::splat_f64(1.0 / PARTICLES as f64);
                let turned = cross(&load3(&self.dual[k], part), &change[k]);
                moved[1] = self::sum(&moved[1], &turned);
            }
            for turned in &mut moved[1] {
                *turned = *turned * L::splat_f64(0.5);
            }
            if self.deviation.exceeds_budget(part, substeps, &moved) {
                return true;
            }
        }
        // A rotation about one axis displaces the ends of the two others.
        let rotation = rotation * L::splat_f64(0.5);
        L::any(self::load::<L>(&self.travel_budget, part).less_than(travel))
            || L::any(self::load::<L>(&self.rotation_budget, part).less_than(rotation))
    }

    fn add_substeps(&mut self, substeps: usize) {
        self.deviation.add_substeps(substeps);
    }

    fn deviation(&self, l: usize) -> (DVec3, DVec3) {
        self.deviation.after(l, self.displacement(l))
    }

    fn displacement(&self, l: usize) -> (DVec3, DVec3) {
        let mut initial = [DVec3::ZERO; 3];
        for k in 0..3 {
            initial[k] = get3(&self.initial_sums[k], l);
        }
        self.mean_motion(l, &self.displacement, initial)
    }

    fn displacement_rows(&self, l: usize, rows: &mut [Row<R>]) -> f64 {
        let (mut center, mut gradient, mut largest) = (DVec3::ZERO, DMat3::ZERO, 0.0f64);
        for (i, (now, initial)) in self.displacement.iter().zip(&self.initial).enumerate() {
            let initial = get3(initial, l);
            let displacement = get3(now, l) - initial;
            center += displacement / PARTICLES as f64;
            gradient += (0..3).map(|k| outer(displacement * sign(i, k), get3(&self.dual[k], l))).sum::<DMat3>();
            largest = largest.max(initial.abs().max_element());
        }
        set_rows(rows, center - gradient * get3(&self.offset, l), &gradient);
        largest
    }

    fn twist(&self, l: usize) -> (DVec3, DVec3) {
        self.mean_motion(l, &self.velocity, [DVec3::ZERO; 3])
    }

    fn delta(&self, l: usize, h: f64) -> BodyDelta {
        let ((displacement, rotation), (v, w)) = (self.displacement(l), self.twist(l));
        let mut particles = [(DVec3::ZERO, DVec3::ZERO); PARTICLES];
        for (i, particle) in particles.iter_mut().enumerate() {
            *particle = (get3(&self.displacement[i], l), get3(&self.velocity[i], l) / h);
        }
        BodyDelta { displacement, rotation, velocity: v / h, spin: w / h, particles: Some(particles) }
    }

    fn add_force(&self, l: usize, applied: &BodyForce, force: &mut [Row<R>]) {
        let edges = [get3(&self.edge[0], l), get3(&self.edge[1], l), get3(&self.edge[2], l)];
        let arm = get3(&self.offset, l) + applied.arm;
        let moment = outer(applied.force, arm) + torque_moment(applied.torque, &edges);
        force[0].add(applied.force, moment.x_axis);
        force[1].add(moment.y_axis, moment.z_axis);
    }
}

impl<R: Real> Lattice<R> {
    /// Sets the constants of the springs of the block in lane `l`; `edges` join its particles, m.
    fn load_springs(&mut self, l: usize, body: &KernelBody, springs: &Springs, edges: &[DVec3; 3]) {
        let h = body.h;
        let h2_inv_mass = if body.active { PARTICLES as f64 * h * h / body.mass } else { 0.0 };
        let beta = springs.damper(body.mass) / (springs.stiffness * h);
        for kind in 1..=KINDS {
            let along = |k: usize| if kind >> k & 1 == 1 { edges[k].length_squared() } else { 0.0 };
            let k = h2_inv_mass / STRAIN_INERTIA * springs.stiffness / (along(0) + along(1) + along(2));
            self.stiffness[kind - 1].0[l] = R::from_f64(k * (1.0 + beta));
            self.damping[kind - 1].0[l] = R::from_f64(k * beta);
        }
        self.h2_inv_mass.0[l] = R::from_f64(h2_inv_mass);
    }

    /// Change of the velocity of each particle in a substep by contacts and load.
    #[inline(always)]
    fn external_change<L: Lanes<Scalar = R>>(&self, part: usize, force: &[Row<R>]) -> [[L; 3]; PARTICLES] {
        let f = L::columns(|l| L::Row::read(&force[2 * l].0));
        let g = L::columns(|l| L::Row::read(&force[2 * l + 1].0));
        let offset = load3::<L>(&self.offset, part);
        let h2_inv_mass = load::<L>(&self.h2_inv_mass, part);
        let share = h2_inv_mass * L::splat_f64(1.0 / PARTICLES as f64);
        let mut change = [[L::zero(); 3]; PARTICLES];
        let mut along = [[L::zero(); 3]; 3];
        let dual = [load3::<L>(&self.dual[0], part), load3::<L>(&self.dual[1], part), load3::<L>(&self.dual[2], part)];
        for k in 0..3 {
            // Moments about the centre.
            let m = [f[4 + k] - f[k] * offset[0], g[k] - f[k] * offset[1], g[4 + k] - f[k] * offset[2]];
            let [x, y, z] = into_frame(&dual, &m);
            for (along, x) in along.iter_mut().zip([x, y, z]) {
                along[k] = h2_inv_mass * x;
            }
        }
        self.reduce_strain(part, &mut along);
        let [x, y, z] = along;
        for k in 0..3 {
            let (x, y, z) = (x[k], y[k], z[k]);
            let mean = f[k] * share;
            let (low, high) = (mean - z, mean + z);
            let rows = [low - y, low + y, high - y, high + y];
            for (i, row) in rows.into_iter().enumerate() {
                change[2 * i][k] = row - x;
                change[2 * i + 1][k] = row + x;
            }
        }
        change
    }

    /// Edges of the unstrained blocks, m.
    #[inline(always)]
    fn rest_edges<L: Lanes<Scalar = R>>(&self, part: usize) -> [[L; 3]; 3] {
        [load3::<L>(&self.edge[0], part), load3::<L>(&self.edge[1], part), load3::<L>(&self.edge[2], part)]
    }

    /// Divides the change of the axes' velocities by [`STRAIN_INERTIA`], except for their common
    /// rotation.
    #[inline(always)]
    fn reduce_strain<L: Lanes<Scalar = R>>(&self, part: usize, along: &mut [[L; 3]; 3]) {
        let edge = self.rest_edges::<L>(part);
        // h² times half the angular acceleration.
        let rotation = common_rotation(&edge, &load3::<L>(&self.inv_rotation, part), along);
        let (strain, rigid) = (L::splat_f64(1.0 / STRAIN_INERTIA), L::splat_f64(1.0 - 1.0 / STRAIN_INERTIA));
        for k in 0..3 {
            let rotated = cross(&rotation, &edge[k]);
            for (x, rotated) in along[k].iter_mut().zip(rotated) {
                *x = strain * *x + rigid * rotated;
            }
        }
    }

    /// Adds the part of the centripetal acceleration that springs need not give to particles with
    /// displacements u and velocities v.
    ///
    /// A particle without force goes straight, and [`STRAIN_INERTIA`] weakens the springs that turn
    /// it: a block that spins would be strained eight times too much, with 64 times the energy.
    #[inline(always)]
    fn add_centripetal<L: Lanes<Scalar = R>>(
        &self,
        part: usize,
        [u, v]: [&[[L; 3]; PARTICLES]; 2],
        change: &mut [[L; 3]; PARTICLES],
    ) {
        // The sums along the axes are four times the changes of the edges.
        let ((sum, moved), (_, mut rate)) = (signed_sums(u), signed_sums(v));
        let (eighth, quarter) = (L::splat_f64(1.0 / PARTICLES as f64), L::splat_f64(2.0 / PARTICLES as f64));
        let rest = self.rest_edges::<L>(part);
        let mut edge = rest;
        for k in 0..3 {
            for i in 0..3 {
                edge[k][i] = rest[k][i] + moved[k][i] * quarter;
                rate[k][i] = rate[k][i] * quarter;
            }
        }
        let inertia = EdgeInertia::new(&edge, &rest);
        let spin = inertia.common_rotation(&edge, &rate);
        let inward = [0, 1, 2].map(|k| cross(&spin, &cross(&spin, &edge[k])));
        // The rotation as a whole has no part in it: the angular momentum stays.
        let rotation = inertia.common_rotation(&edge, &inward);
        let (centripetal, half) = (load::<L>(&self.centripetal, part), L::splat_f64(0.5));
        for (particle, change) in change.iter_mut().enumerate() {
            let mut x = [L::zero(); 3];
            for i in 0..3 {
                x[i] = u[particle][i] - sum[i] * eighth;
                for k in 0..3 {
                    let to_side = half * rest[k][i];
                    x[i] = if sign(particle, k) > 0.0 { x[i] + to_side } else { x[i] - to_side };
                }
            }
            let (inward, rotated) = (cross(&spin, &cross(&spin, &x)), cross(&rotation, &x));
            for i in 0..3 {
                change[i] += centripetal * (inward[i] - rotated[i]);
            }
        }
    }

    /// Adds the change of the velocity of each particle in a substep by the springs.
    #[inline(always)]
    fn add_springs<L: Lanes<Scalar = R>>(
        &mut self,
        part: usize,
        u: &[[L; 3]; PARTICLES],
        change: &mut [[L; 3]; PARTICLES],
    ) {
        let [x, y, z] = self.rest_edges::<L>(part);
        // Rest vectors from the lower to the higher particle: positive along the highest axis that
        // they span.
        let (y_plus, y_minus) = (sum(&y, &x), difference(&y, &x));
        let (zx_plus, zx_minus) = (sum(&z, &x), difference(&z, &x));
        let (zy_plus, zy_minus) = (sum(&z, &y), difference(&z, &y));
        let (pp, pm) = (sum(&zy_plus, &x), difference(&zy_plus, &x));
        let (mp, mm) = (sum(&zy_minus, &x), difference(&zy_minus, &x));
        macro_rules! springs {
            ($($n:literal: $rest:expr),* $(,)?) => {
                $({
                    const ENDS: (usize, usize, usize) = ends($n);
                    let (i, j, kind) = ENDS;
                    let strain = &mut self.strain[$n];
                    let (k, c) = (load::<L>(&self.stiffness[kind - 1], part), load::<L>(&self.damping[kind - 1], part));
                    let (force, now) = spring([&u[i], &u[j]], $rest, (k, c), load::<L>(strain, part));
                    now.store(&mut strain.0, part);
                    for k in 0..3 {
                        change[i][k] += force[k];
                        change[j][k] -= force[k];
                    }
                })*
            };
        }
        springs! {
            // From particle 0 (- - -) to 1 (+ - -), 2 (- + -), ... 7 (+ + +).
            0: &x, 1: &y, 2: &y_plus, 3: &z, 4: &zx_plus, 5: &zy_plus, 6: &pp,
            // From 1.
            7: &y_minus, 8: &y, 9: &zx_minus, 10: &z, 11: &pm, 12: &zy_plus,
            // From 2.
            13: &x, 14: &zy_minus, 15: &mp, 16: &z, 17: &zx_plus,
            // From 3.
            18: &mm, 19: &zy_minus, 20: &zx_minus, 21: &z,
            // From 4, 5, 6.
            22: &x, 23: &y, 24: &y_plus,
            25: &y_minus, 26: &y,
            27: &x,
        }
    }

    /// Writes the velocity rows from the velocities of the particles.
    #[inline(always)]
    fn write_velocity_rows<L: Lanes<Scalar = R>>(&self, part: usize, v: &[[L; 3]; PARTICLES], velocity: &mut [Row<R>]) {
        let (sum, along) = signed_sums(v);
        let dual = [load3::<L>(&self.dual[0], part), load3::<L>(&self.dual[1], part), load3::<L>(&self.dual[2], part)];
        let offset = load3::<L>(&self.offset, part);
        let eighth = L::splat_f64(1.0 / PARTICLES as f64);
        let zero = L::zero();
        // Gradient along the axes of the world.
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

    /// Mean of vectors at the particles of the block in lane `l`, and their rotation, less that of
    /// the sums `initial`.
    fn mean_motion(&self, l: usize, of: &[[LaneArray<R>; 3]; PARTICLES], initial: [DVec3; 3]) -> (DVec3, DVec3) {
        let mut sum = DVec3::ZERO;
        let mut rotation = DVec3::ZERO;
        for k in 0..3 {
            let along: DVec3 = (0..PARTICLES).map(|i| get3(&of[i], l) * sign(i, k)).sum();
            rotation += 0.5 * get3(&self.dual[k], l).cross(along - initial[k]);
        }
        for of in of {
            sum += get3(of, l);
        }
        (sum / PARTICLES as f64, rotation)
    }
}

/// Sum of vectors at the particles, and their sums with the signs of the particles along each axis.
#[inline(always)]
fn signed_sums<L: Lanes>(x: &[[L; 3]; PARTICLES]) -> ([L; 3], [[L; 3]; 3]) {
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
fn sum<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn difference<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Sets the two rows of a body to a vector and the columns of a matrix.
fn set_rows<R: Real>(to: &mut [Row<R>], x: DVec3, m: &DMat3) {
    to[0] = Row::new(x, m.x_axis);
    to[1] = Row::new(m.y_axis, m.z_axis);
}

/// Adds rows to those of A and subtracts them from those of B, `next` scalars behind the first of
/// each.
///
/// # Safety
/// As for [`BodyModel::apply_wrench`], and `next` is the length of a row or zero.
#[inline(always)]
unsafe fn add_rows<L: Lanes>(
    group: &Group<L::Scalar>,
    first: usize,
    next: u32,
    rows: L::Rows,
    force: &mut [Row<L::Scalar>],
) {
    for (l, on_a) in rows.into_iter().enumerate() {
        let [a, b] = group.bodies(first + l);
        // SAFETY: as for this function; a body has two rows.
        let a = unsafe { row_mut(force, a + next) };
        (L::Row::read(a) + on_a).write(a);
        // SAFETY: as for this function; a body has two rows.
        let b = unsafe { row_mut(force, b + next) };
        (L::Row::read(b) - on_a).write(b);
    }
}
