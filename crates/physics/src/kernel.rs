//! The inner loop: many substeps of contact law and integration over packed groups of contacts, in single or double precision.
//!
//! A lane holds a contact (or a body) of its own, never a part of a sum, and forces are added to the bodies in the order of the
//! groups: how wide the machine's registers are changes nothing in the result. No position is held here, only the small
//! displacements since the last sync; a gap formed from f32 positions would be wrong by 30 nm.

use glam::DVec3;

use crate::constants::{GUARD_SUBSTEPS, STRIBECK_SPEED, TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS};
use crate::drive::Servo;
use crate::hand::Pull;
#[cfg(target_arch = "x86_64")]
use crate::lanes::portable;
use crate::lanes::{LANES, Lanes, ROW, Real, Row as _};
use crate::params::Width;

/// Points of an entry; a manifold with more has several entries.
pub const SLOTS: usize = 4;

/// Lanes whose counts of points are kept together: as many as the narrowest vector has.
pub const QUARTER: usize = 4;

/// One number a lane.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub struct Lane<R>(pub [R; LANES]);

/// A point of each contact of a group.
#[derive(Debug, Clone, Copy, Default)]
pub struct PointLanes<R> {
    /// Place from the centroid along the tangents, m.
    pub arm: [Lane<R>; 2],
    /// The same for friction, see [`crate::manifold::Manifold::levers`].
    pub lever: [Lane<R>; 2],
    /// Separation, m.
    pub gap: Lane<R>,
    /// Tangential spring, m.
    pub stretch: [Lane<R>; 2],
    /// Maxwell element, m.
    pub creep: Lane<R>,
    /// Stiffness, N/m.
    pub stiffness: Lane<R>,
    /// Normal force at the last look, N.
    pub normal: Lane<R>,
}

/// A contact a lane.
#[derive(Debug, Clone, Copy)]
pub struct Group<R> {
    /// Points of the fullest contact of each [`QUARTER`] lanes.
    pub counts: [u32; LANES / QUARTER],
    /// Where the rows of the bodies begin: [`ROW`] times the number of the row.
    pub a: [u32; LANES],
    pub b: [u32; LANES],
    /// Normal and tangents in the world.
    pub frame: [[Lane<R>; 3]; 3],
    /// Centroid from the island's reference point, m.
    pub arm: [Lane<R>; 3],
    /// Damping over stiffness, s.
    pub relaxation: Lane<R>,
    /// The points.
    pub points: [PointLanes<R>; SLOTS],
}

impl<R: Real> Group<R> {
    /// Open contacts of the floor with itself.
    pub fn new(floor: u32) -> Self {
        let open = PointLanes { gap: Lane([R::from_f64(1.0); LANES]), ..PointLanes::default() };
        Self {
            counts: [0; LANES / QUARTER],
            a: [floor; LANES],
            b: [floor; LANES],
            frame: Default::default(),
            arm: Default::default(),
            relaxation: Lane::default(),
            points: [open; SLOTS],
        }
    }

    /// Makes lane `l` an open contact of the floor with itself.
    pub fn open(&mut self, l: usize, floor: u32) {
        (self.a[l], self.b[l]) = (floor, floor);
        for axis in self.frame.iter_mut().flatten().chain(&mut self.arm).chain([&mut self.relaxation]) {
            axis.0[l] = R::default();
        }
        for p in &mut self.points {
            for number in p.arm.iter_mut().chain(&mut p.lever).chain(&mut p.stretch).chain([&mut p.creep, &mut p.stiffness, &mut p.normal])
            {
                number.0[l] = R::default();
            }
            p.gap.0[l] = R::from_f64(1.0);
        }
    }
}

/// A body's velocity and spin, or force and torque: x, y, z, 0, x, y, z, 0.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub struct Row<R>(pub [R; ROW]);

impl<R: Real> Row<R> {
    /// Adds to the two vectors.
    pub fn add(&mut self, x: DVec3, y: DVec3) {
        for k in 0..3 {
            self.0[k] = self.0[k] + R::from_f64(x[k]);
            self.0[k + 4] = self.0[k + 4] + R::from_f64(y[k]);
        }
    }
}

/// What acts on single bodies in each substep.
#[derive(Debug, Clone, Default)]
pub struct Actors {
    /// The hand.
    pub hand: Option<Pull>,
    /// The drives.
    pub drives: Vec<Servo>,
}

/// A body a lane.
#[derive(Debug, Clone, Copy, Default)]
pub struct BodyLanes<R> {
    /// Velocity of the centre and spin, m/s and rad/s.
    pub velocity: [Lane<R>; 3],
    pub spin: [Lane<R>; 3],
    /// Centre from the island's reference point, m.
    pub offset: [Lane<R>; 3],
    /// 1 / kg.
    pub inv_mass: Lane<R>,
    /// Inverse inertia in the world: xx, yy, zz, xy, xz, yz, 1 / (kg m²).
    pub inv_inertia: [Lane<R>; 6],
    /// Displacement and turn since the last sync, m and rad.
    pub shift: [Lane<R>; 3],
    pub turn: [Lane<R>; 3],
    /// Distance to the corners, m.
    pub radius: Lane<R>,
    /// Travel (m) and turn (rad) that end the batch.
    pub travel_bound: Lane<R>,
    pub turn_bound: Lane<R>,
}

/// Constants of a batch.
#[derive(Debug, Clone, Copy)]
pub struct Law<R> {
    /// Substep, s.
    pub h: R,
    /// What is left of the Maxwell element after a substep.
    pub keep: R,
    /// Kinetic friction, and by how much static friction is above it.
    pub mu_kinetic: R,
    pub mu_excess: R,
}

/// The packed world between two syncs.
#[derive(Debug, Clone, Default)]
pub struct Kernel<R> {
    /// Registers to work in.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "there is one width"))]
    pub width: Width,
    /// Contacts.
    pub groups: Vec<Group<R>>,
    /// Velocities as of a body that reaches to the reference point of its island, where the velocities of two bodies can be
    /// subtracted without asking where their centres are; the last row is the floor, at rest.
    pub velocity: Vec<Row<R>>,
    /// Forces other than contact, weight and applied ones, and their torques about the reference point.
    pub load: Vec<Row<R>>,
    /// Sums of forces of the present substep.
    pub force: Vec<Row<R>>,
    /// Everything else about the bodies.
    pub bodies: Vec<BodyLanes<R>>,
    /// How many bodies there are.
    pub len: usize,
}

impl<R: Real> Kernel<R> {
    /// An empty one that works in registers of the given width.
    pub fn new(width: Width) -> Self {
        Self { width, ..Self::default() }
    }

    /// Runs up to `substeps` substeps; fewer when a body reaches its bound. Returns how many.
    #[cfg(target_arch = "x86_64")]
    pub fn run(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        match self.width {
            Width::Portable => self.run_in::<portable::Plain<R>>(law, substeps, actors),
            // SAFETY: the processor has what is needed.
            Width::Auto | Width::Avx512 if Width::Avx512.available() => unsafe { self.run_avx512(law, substeps, actors) },
            // SAFETY: as above.
            Width::Auto | Width::Avx512 | Width::Avx2 if Width::Avx2.available() => unsafe { self.run_avx2(law, substeps, actors) },
            _ => self.run_in::<R::Base>(law, substeps, actors),
        }
    }

    /// Runs up to `substeps` substeps; fewer when a body reaches its bound. Returns how many.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn run(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        self.run_in::<R::Base>(law, substeps, actors)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw")]
    fn run_avx512(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        self.run_in::<R::Avx512>(law, substeps, actors)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn run_avx2(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        self.run_in::<R::Avx2>(law, substeps, actors)
    }

    #[inline(always)]
    fn run_in<L: Lanes<Number = R>>(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        for done in 0..substeps {
            let look = done % GUARD_SUBSTEPS == GUARD_SUBSTEPS - 1;
            let keep = look || done + 1 == substeps;
            self.force.copy_from_slice(&self.load);
            for group in &mut self.groups {
                for part in 0..LANES / L::WIDTH {
                    contact::<L>(group, part, keep, law, &self.velocity, &mut self.force);
                }
            }
            self.act(law.h, actors);
            for (i, bodies) in self.bodies.iter_mut().enumerate() {
                let filled = (self.len - LANES * i).min(LANES).div_ceil(L::WIDTH);
                for part in 0..filled {
                    let first = LANES * i + L::WIDTH * part;
                    let rows = first..first + L::WIDTH;
                    integrate::<L>(bodies, part, law.h, &mut self.velocity[rows.clone()], &self.force[rows]);
                }
            }
            if look && self.bodies.iter().any(beyond::<L>) {
                return done + 1;
            }
        }
        substeps
    }

    /// Adds the forces of hand and drives.
    fn act(&mut self, h: R, actors: &mut Actors) {
        if let Some(hand) = &mut actors.hand {
            let i = hand.body();
            let (force, torque) = hand.force(h.to_f64(), self.motion(i));
            self.push(i, force, torque);
        }
        for drive in &actors.drives {
            let i = drive.body();
            let (force, torque) = drive.force(h.to_f64(), self.motion(i));
            self.push(i, force, torque);
        }
    }

    /// Where the row of the floor begins.
    pub fn floor(&self) -> u32 {
        ((self.velocity.len() - 1) * ROW) as u32
    }

    /// Displacement (m) and turn (rad) of a body since its pose was made exact.
    pub fn displacement(&self, i: usize) -> (DVec3, DVec3) {
        let (bodies, l) = (&self.bodies[i / LANES], i % LANES);
        (vector(&bodies.shift, l), vector(&bodies.turn, l))
    }

    /// Velocity of the centre and spin of a body, m/s and rad/s.
    pub fn motion(&self, i: usize) -> (DVec3, DVec3) {
        let (bodies, l) = (&self.bodies[i / LANES], i % LANES);
        (vector(&bodies.velocity, l), vector(&bodies.spin, l))
    }

    /// Adds a force at the centre of a body and a torque about it.
    fn push(&mut self, i: usize, force: DVec3, torque: DVec3) {
        let offset = vector(&self.bodies[i / LANES].offset, i % LANES);
        self.force[i].add(force, torque + offset.cross(force));
    }
}

/// The vector in a lane.
pub fn vector<R: Real>(x: &[Lane<R>; 3], l: usize) -> DVec3 {
    DVec3::new(x[0].0[l].to_f64(), x[1].0[l].to_f64(), x[2].0[l].to_f64())
}

/// The row that begins at a place that is known to be one.
#[inline(always)]
fn row<R>(rows: &[Row<R>], start: u32) -> &[R; ROW] {
    debug_assert!((start as usize).is_multiple_of(ROW) && (start as usize) < ROW * rows.len());
    // SAFETY: `Packing::load` is what fills groups, and it lays out a row for every body it names and for the floor. The place is one
    // in numbers because a processor can multiply an index by the size of a number as it reads, but not by that of a row.
    unsafe { &*rows.as_ptr().cast::<R>().add(start as usize).cast() }
}

/// The same, to write to.
#[inline(always)]
fn row_mut<R>(rows: &mut [Row<R>], start: u32) -> &mut [R; ROW] {
    debug_assert!((start as usize).is_multiple_of(ROW) && (start as usize) < ROW * rows.len());
    // SAFETY: as for `row`.
    unsafe { &mut *rows.as_mut_ptr().cast::<R>().add(start as usize).cast() }
}

#[inline(always)]
fn load<L: Lanes>(from: &Lane<L::Number>, part: usize) -> L {
    L::load(&from.0, part)
}

#[inline(always)]
fn load3<L: Lanes>(from: &[Lane<L::Number>; 3], part: usize) -> [L; 3] {
    [load(&from[0], part), load(&from[1], part), load(&from[2], part)]
}

#[inline(always)]
fn cross<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Components along the axes of a frame.
#[inline(always)]
fn into_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    let along = |axis: &[L; 3]| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    [along(&frame[0]), along(&frame[1]), along(&frame[2])]
}

#[inline(always)]
fn out_of_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    let along = |i: usize| frame[0][i] * v[0] + frame[1][i] * v[1] + frame[2][i] * v[2];
    [along(0), along(1), along(2)]
}

/// The contact law on a part of a group: velocities in, forces out, springs advanced. Normal forces are kept where asked for.
#[inline(always)]
fn contact<L: Lanes>(
    group: &mut Group<L::Number>,
    part: usize,
    keep: bool,
    law: &Law<L::Number>,
    velocity: &[Row<L::Number>],
    force: &mut [Row<L::Number>],
) {
    let first = L::WIDTH * part;
    let quarters = first / QUARTER..(first + L::WIDTH).div_ceil(QUARTER);
    let count = group.counts[quarters].iter().fold(0, |most, &count| most.max(count));
    if count == 0 {
        return;
    }
    // relative velocity at the reference point and relative spin, B over A; then at the centroid, along the frame
    let d = L::columns(|l| L::Row::read(row(velocity, group.b[first + l])) - L::Row::read(row(velocity, group.a[first + l])));
    let (dv, dw): ([L; 3], [L; 3]) = ([d[0], d[1], d[2]], [d[4], d[5], d[6]]);
    let arm = load3::<L>(&group.arm, part);
    let frame = [load3(&group.frame[0], part), load3(&group.frame[1], part), load3(&group.frame[2], part)];
    let turning = cross(&dw, &arm);
    let v = into_frame(&frame, &[0, 1, 2].map(|k| dv[k] + turning[k]));
    let w = into_frame(&frame, &dw);

    let mut sum = Wrench { f: [L::zero(); 3], m: [L::zero(); 3] };
    let relaxation = load(&group.relaxation, part);
    for point in group.points.iter_mut().take(count as usize) {
        spring(point, part, keep, law, relaxation, &v, &w, &mut sum);
    }

    // one force and one moment about the reference point, equal and opposite on the two
    let f = out_of_frame(&frame, &sum.f);
    let m = out_of_frame(&frame, &sum.m);
    let t = cross(&arm, &f);
    let zero = L::zero();
    L::rows([f[0], f[1], f[2], zero, t[0] + m[0], t[1] + m[1], t[2] + m[2], zero], |l, on_b| {
        let a = row_mut(force, group.a[first + l]);
        (L::Row::read(a) - on_b).write(a);
        let b = row_mut(force, group.b[first + l]);
        (L::Row::read(b) + on_b).write(b);
    });
}

/// Force and moment about the centroid along normal, tangent, tangent.
struct Wrench<L> {
    f: [L; 3],
    m: [L; 3],
}

/// The springs of one point in each lane, from the relative velocity and spin along normal, tangent, tangent.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "they are what a point needs, and a struct of them would be taken apart at once")]
fn spring<L: Lanes>(
    p: &mut PointLanes<L::Number>,
    part: usize,
    keep: bool,
    law: &Law<L::Number>,
    relaxation: L,
    v: &[L; 3],
    w: &[L; 3],
    sum: &mut Wrench<L>,
) {
    let zero = L::zero();
    let h = L::splat(law.h);
    let load = |from: &Lane<L::Number>| load::<L>(from, part);
    let (r1, r2) = (load(&p.arm[0]), load(&p.arm[1]));
    let (q1, q2) = (load(&p.lever[0]), load(&p.lever[1]));
    let k = load(&p.stiffness);

    // velocity of the point, its torsional part on the shorter lever
    let vn = v[0] + (w[1] * r2 - w[2] * r1);
    let u = [v[1] - w[0] * q2, v[2] + w[0] * q1];

    // normal: a spring, a damper and a Maxwell element, that do not pull
    let step = vn * h;
    let gap = load(&p.gap) + step;
    let creep = load(&p.creep) * L::splat(law.keep) + step;
    let closed = gap.less(zero);
    let n = -(k * ((gap + creep) + relaxation * vn));
    let n = L::select(L::both(closed, zero.less(n)), n, zero);
    gap.store(&mut p.gap.0, part);
    L::select(closed, creep, zero).store(&mut p.creep.0, part);
    if keep {
        n.store(&mut p.normal.0, part);
    }

    // tangential: a spring and a damper within Coulomb's cone
    let kt = L::number(TANGENTIAL_STIFFNESS);
    let ct = L::number(TANGENTIAL_DAMPING) * relaxation;
    let mut s = [0, 1].map(|i| L::select(closed, load(&p.stretch[i]) + u[i] * h, zero));
    let mut g = [0, 1].map(|i| L::select(closed, k * (kt * s[i] + ct * u[i]), zero));
    let limit = L::splat(law.mu_kinetic) * n;
    if L::any((limit * limit).less(g[0] * g[0] + g[1] * g[1])) {
        slide(law, n, &u, &mut s, &mut g);
    }
    s[0].store(&mut p.stretch[0].0, part);
    s[1].store(&mut p.stretch[1].0, part);

    sum.f[0] += n;
    sum.f[1] -= g[0];
    sum.f[2] -= g[1];
    sum.m[0] -= q1 * g[1] - q2 * g[0];
    sum.m[1] += r2 * n;
    sum.m[2] -= r1 * n;
}

/// Brings friction `g` and its springs `s` back to Coulomb's cone. The cone narrows from static to kinetic with the speed of
/// sliding, mu = mu_k + (mu_s - mu_k) / (1 + (u / u_s)²), so that a sliding contact does not stick again at each substep.
#[inline(always)]
fn slide<L: Lanes>(law: &Law<L::Number>, n: L, u: &[L; 2], s: &mut [L; 2], g: &mut [L; 2]) {
    let one = L::number(1.0);
    let speed = (u[0] * u[0] + u[1] * u[1]) * L::number(1.0 / (STRIBECK_SPEED * STRIBECK_SPEED));
    let mu = L::splat(law.mu_kinetic) + L::splat(law.mu_excess) / (one + speed);
    let limit = mu * n;
    let size = (g[0] * g[0] + g[1] * g[1]).sqrt();
    let q = L::select(limit.less(size), limit / size, one);
    for i in 0..2 {
        s[i] = s[i] * q;
        g[i] = g[i] * q;
    }
}

/// Semi-implicit Euler: places with the velocity that the springs have just seen, then velocities with the forces.
#[inline(always)]
fn integrate<L: Lanes>(
    bodies: &mut BodyLanes<L::Number>,
    part: usize,
    h: L::Number,
    velocity: &mut [Row<L::Number>],
    force: &[Row<L::Number>],
) {
    let h = L::splat(h);
    let f = L::columns(|l| L::Row::read(&force[l].0));
    let (mut v, mut w) = (load3::<L>(&bodies.velocity, part), load3::<L>(&bodies.spin, part));
    let offset = load3::<L>(&bodies.offset, part);
    // torque about the centre
    let lever = cross(&offset, &[f[0], f[1], f[2]]);
    let t = [0, 1, 2].map(|k| f[k + 4] - lever[k]);
    let ease = load::<L>(&bodies.inv_mass, part);
    for k in 0..3 {
        (load::<L>(&bodies.shift[k], part) + h * v[k]).store(&mut bodies.shift[k].0, part);
        (load::<L>(&bodies.turn[k], part) + h * w[k]).store(&mut bodies.turn[k].0, part);
        v[k] += h * (ease * f[k]);
    }
    let [xx, yy, zz, xy, xz, yz] = [0, 1, 2, 3, 4, 5].map(|k| load::<L>(&bodies.inv_inertia[k], part));
    w[0] += h * (xx * t[0] + xy * t[1] + xz * t[2]);
    w[1] += h * (xy * t[0] + yy * t[1] + yz * t[2]);
    w[2] += h * (xz * t[0] + yz * t[1] + zz * t[2]);
    for k in 0..3 {
        v[k].store(&mut bodies.velocity[k].0, part);
        w[k].store(&mut bodies.spin[k].0, part);
    }
    let turning = cross(&w, &offset);
    let zero = L::zero();
    let at = [0, 1, 2].map(|k| v[k] - turning[k]);
    L::rows([at[0], at[1], at[2], zero, w[0], w[1], w[2], zero], |l, row| row.write(&mut velocity[l].0));
}

/// Whether a body has gone as far as it may between two syncs.
#[inline(always)]
fn beyond<L: Lanes>(bodies: &BodyLanes<L::Number>) -> bool {
    let length = |x: [L; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    (0..LANES / L::WIDTH).any(|part| {
        let turn = length(load3(&bodies.turn, part));
        let travel = length(load3(&bodies.shift, part)) + turn * load(&bodies.radius, part);
        L::any(load::<L>(&bodies.travel_bound, part).less(travel)) || L::any(load::<L>(&bodies.turn_bound, part).less(turn))
    })
}
