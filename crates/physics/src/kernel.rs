//! The inner loop: many substeps of contact law and integration over packed groups of contacts, in single or double precision.
//!
//! A lane holds a contact (or a body) of its own, never a part of a sum, and forces are added to the bodies in the order of the
//! lanes, group by group: how wide the machine's registers are changes nothing in the result. No position is held here, only the small
//! displacements since the last sync; a gap formed from f32 positions would be wrong by 30 nm. Velocities are ways in a substep, which
//! saves the multiplications by its length.
//!
//! Results are written where they are wanted one by one, as soon as they are reckoned: engines of WebAssembly load all that is needed up to
//! the next write before they reckon anything, and put aside what their registers cannot hold. See [`write_in_turn`].
//!
//! Arrays are written out here and not mapped: a closure given to `map` is not always put in its place, which costs ten times the
//! time where wider registers are used than the program was built for.

use glam::DVec3;

use crate::constants::GUARD_SUBSTEPS;
use crate::drive::Servo;
use crate::form::{Form, Motion, Push, Taken};
use crate::hand::Pull;
use crate::params::Width;
use crate::simd::lanes::{LANES, Lanes, ROW_LEN, Real};
#[cfg(target_arch = "x86_64")]
use crate::simd::portable;

/// Points of an entry; a manifold with more has several entries.
pub const SLOTS: usize = 4;

/// Lanes of groups that are taken through each stage of the law at a time: their data stay in the nearest cache.
const STAGE: usize = 128;

/// One number a lane.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(target_arch = "x86_64", repr(align(64)))]
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
    /// Pull along the normal, N: what it pushes is below zero.
    pub pull: Lane<R>,
}

/// A contact a lane.
#[derive(Debug, Clone, Copy)]
pub struct Group<R> {
    /// Points of each contact.
    pub counts: [u8; LANES],
    /// Where the rows of the bodies begin: [`ROW_LEN`] times the number of the row.
    pub a: [u32; LANES],
    pub b: [u32; LANES],
    /// Normal and tangents in the world.
    pub frame: [[Lane<R>; 3]; 3],
    /// Centroid from the cluster's reference point, m.
    pub arm: [Lane<R>; 3],
    /// Damping over stiffness, substeps.
    pub relaxation: Lane<R>,
    /// The points.
    pub points: [PointLanes<R>; SLOTS],
}

impl<R: Real> Group<R> {
    /// Open contacts of the floor with itself.
    pub fn new(floor: u32) -> Self {
        let open = PointLanes { gap: Lane([R::from_f64(1.0); LANES]), ..PointLanes::default() };
        Self {
            counts: [0; LANES],
            a: [floor; LANES],
            b: [floor; LANES],
            frame: Default::default(),
            arm: Default::default(),
            relaxation: Lane::default(),
            points: [open; SLOTS],
        }
    }

    /// Normal and tangents in the world, of a part.
    #[inline(always)]
    pub fn frame_of<L: Lanes<Scalar = R>>(&self, part: usize) -> [[L; 3]; 3] {
        [load3(&self.frame[0], part), load3(&self.frame[1], part), load3(&self.frame[2], part)]
    }

    /// What normal and tangents have along axis `k` of the world, of a part.
    #[inline(always)]
    pub fn axes_along<L: Lanes<Scalar = R>>(&self, k: usize, part: usize) -> [L; 3] {
        [load(&self.frame[0][k], part), load(&self.frame[1][k], part), load(&self.frame[2][k], part)]
    }

    /// Writes the components of a vector along normal and tangents, of a part.
    #[inline(always)]
    pub fn resolve<L: Lanes<Scalar = R>>(&self, part: usize, v: &[L; 3], to: &mut [L; 3]) {
        for (axis, to) in self.frame.iter().zip(to) {
            write_in_turn(to, dot(&load3(axis, part), v));
        }
    }

    /// Makes lane `l` an open contact of the floor with itself.
    pub fn open(&mut self, l: usize, floor: u32) {
        (self.a[l], self.b[l], self.counts[l]) = (floor, floor, 0);
        for axis in self.frame.iter_mut().flatten().chain(&mut self.arm).chain([&mut self.relaxation]) {
            axis.0[l] = R::default();
        }
        for p in &mut self.points {
            for number in p.arm.iter_mut().chain(&mut p.lever).chain(&mut p.stretch).chain([
                &mut p.creep,
                &mut p.stiffness,
                &mut p.pull,
            ]) {
                number.0[l] = R::default();
            }
            p.gap.0[l] = R::from_f64(1.0);
        }
    }
}

/// A body's velocity and spin (m and rad per substep), or force and torque (N and N m): x, y, z, 0, x, y, z, 0.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub struct Row<R>(pub [R; ROW_LEN]);

impl<R: Real> Row<R> {
    /// The row of two vectors.
    pub fn of(x: DVec3, y: DVec3) -> Self {
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

/// What acts on single bodies in each substep.
#[derive(Debug, Clone, Default)]
pub struct Actors {
    /// The hand.
    pub hand: Option<Pull>,
    /// The drives.
    pub drives: Vec<Servo>,
}

/// Constants of a batch.
#[derive(Debug, Clone, Copy)]
pub struct Law<R> {
    /// What is left of the Maxwell element after a substep.
    pub keep: R,
    /// Tangential over normal stiffness, and damping over stiffness tangentially over normally.
    pub tangential: R,
    pub tangential_relaxation: R,
    /// Kinetic friction, and by how much static friction is above it.
    pub mu_kinetic: R,
    pub mu_excess: R,
    /// Square of a substep over the way that [`crate::constants::STRIBECK_SPEED`] makes in it, 1/m².
    pub stribeck: R,
}

/// The packed cluster, for a frame, of bodies of one form.
#[derive(Debug, Clone, Default)]
pub struct Kernel<R, F> {
    /// Registers to work in.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "there is one width"))]
    pub width: Width,
    /// Contacts.
    pub groups: Vec<Group<R>>,
    /// Velocities as of a body that reaches to the reference point of the cluster, where the velocities of two bodies can be
    /// subtracted without asking where their centres are. [`Form::ROWS`] a body; the last are the floor's, at rest.
    pub velocity: Vec<Row<R>>,
    /// Weight and applied forces, the same in each substep of a run, and their moments about the reference point.
    pub load: Vec<Row<R>>,
    /// Sums of forces of the present substep.
    pub force: Vec<Row<R>>,
    /// Everything else about the bodies.
    pub bodies: Vec<F>,
    /// How many bodies there are.
    pub len: usize,
    /// Substep, s.
    pub h: f64,
}

impl<R: Real, F: Form<R>> Kernel<R, F> {
    /// An empty one that works in registers of the given width.
    pub fn new(width: Width) -> Self {
        Self {
            width,
            groups: Vec::new(),
            velocity: Vec::new(),
            load: Vec::new(),
            force: Vec::new(),
            bodies: Vec::new(),
            len: 0,
            h: 0.0,
        }
    }

    /// Runs up to `substeps` substeps; fewer when a body reaches its bound. Returns how many.
    #[cfg(target_arch = "x86_64")]
    pub fn run(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        match self.width {
            Width::Portable => self.run_in::<portable::Plain<R>>(law, substeps, actors),
            // SAFETY: the processor has what is needed.
            Width::Auto | Width::Avx512 if Width::Avx512.available() => unsafe {
                self.run_avx512(law, substeps, actors)
            },
            // SAFETY: as above.
            Width::Auto | Width::Avx512 | Width::Avx2 if Width::Avx2.available() => unsafe {
                self.run_avx2(law, substeps, actors)
            },
            _ => self.run_in::<R::Base>(law, substeps, actors),
        }
    }

    /// Runs up to `substeps` substeps; fewer when a body reaches its bound. Returns how many.
    ///
    /// A function of its own: engines of WebAssembly move what a branch alone needs into it, be it out of a frame into its inner loop.
    #[cfg(not(target_arch = "x86_64"))]
    #[inline(never)]
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
    fn run_in<L: Lanes<Scalar = R>>(&mut self, law: &Law<R>, substeps: usize, actors: &mut Actors) -> usize {
        self.force.copy_from_slice(&self.load);
        let mut parts: Vec<Part<L, F::Motion<L>>> = self.groups.iter().flat_map(Part::of).collect();
        for done in 0..substeps {
            let look = done % GUARD_SUBSTEPS == GUARD_SUBSTEPS - 1;
            for (groups, parts) in self.groups.chunks_mut(STAGE / LANES).zip(parts.chunks_mut(STAGE / L::WIDTH)) {
                contacts::<L, F>(groups, parts, law, &self.velocity, &mut self.force);
            }
            self.act(actors);
            let mut beyond = false;
            let velocity = self.velocity.chunks_exact_mut(F::ROWS * L::WIDTH);
            let rows = velocity
                .zip(self.force.chunks_exact_mut(F::ROWS * L::WIDTH))
                .zip(self.load.chunks_exact(F::ROWS * L::WIDTH));
            for (i, ((velocity, force), load)) in rows.take(self.len.div_ceil(L::WIDTH)).enumerate() {
                let (bodies, part) = (&mut self.bodies[i / (LANES / L::WIDTH)], i % (LANES / L::WIDTH));
                bodies.integrate::<L>(part, velocity, force, load);
                beyond |= look && bodies.beyond::<L>(part);
            }
            if beyond {
                return done + 1;
            }
        }
        substeps
    }

    /// Adds the forces of hand and drives.
    fn act(&mut self, actors: &mut Actors) {
        if let Some(hand) = &mut actors.hand {
            let i = hand.body();
            let push = hand.force(self.h, self.motion(i));
            self.push(i, &push);
        }
        for drive in &actors.drives {
            let i = drive.body();
            let push = drive.force(self.h, self.motion(i));
            self.push(i, &push);
        }
    }

    /// Where the rows of a body begin.
    pub fn place(&self, i: u32) -> u32 {
        i * (F::ROWS * ROW_LEN) as u32
    }

    /// Where the rows of the floor begin.
    pub fn floor(&self) -> u32 {
        ((self.velocity.len() - F::ROWS) * ROW_LEN) as u32
    }

    /// Displacement (m) and turn (rad) of a body since its pose was made exact.
    pub fn displacement(&self, i: usize) -> (DVec3, DVec3) {
        self.bodies[i / LANES].displacement(i % LANES)
    }

    /// Velocity of the centre and spin of a body, m/s and rad/s.
    pub fn motion(&self, i: usize) -> (DVec3, DVec3) {
        let (v, w) = self.bodies[i / LANES].motion(i % LANES);
        (v / self.h, w / self.h)
    }

    /// All that a body has done since its pose was made exact.
    pub fn taken(&self, i: usize) -> Taken {
        self.bodies[i / LANES].taken(i % LANES, self.h)
    }

    /// Adds what pushes a body to the forces of this substep.
    fn push(&mut self, i: usize, push: &Push) {
        let rows = F::ROWS * i..F::ROWS * (i + 1);
        self.bodies[i / LANES].push(i % LANES, push, &mut self.force[rows]);
    }
}

/// The vector in a lane.
pub fn vector<R: Real>(x: &[Lane<R>; 3], l: usize) -> DVec3 {
    DVec3::new(x[0].0[l].to_f64(), x[1].0[l].to_f64(), x[2].0[l].to_f64())
}

/// Puts a vector into a lane.
pub fn put3<R: Real>(to: &mut [Lane<R>; 3], l: usize, x: DVec3) {
    for k in 0..3 {
        to[k].0[l] = R::from_f64(x[k]);
    }
}

/// The row that begins at a place that is known to be one.
#[inline(always)]
pub fn row<R>(rows: &[Row<R>], start: u32) -> &[R; ROW_LEN] {
    debug_assert!((start as usize).is_multiple_of(ROW_LEN) && (start as usize) < ROW_LEN * rows.len());
    // SAFETY: `Packing::load` is what fills groups, and it lays out a row for every body it names and for the floor. The place is one
    // in numbers because a processor can multiply an index by the size of a number as it reads, but not by that of a row.
    unsafe { &*rows.as_ptr().cast::<R>().add(start as usize).cast() }
}

/// The same, to write to.
#[inline(always)]
pub fn row_mut<R>(rows: &mut [Row<R>], start: u32) -> &mut [R; ROW_LEN] {
    debug_assert!((start as usize).is_multiple_of(ROW_LEN) && (start as usize) < ROW_LEN * rows.len());
    // SAFETY: as for `row`.
    unsafe { &mut *rows.as_mut_ptr().cast::<R>().add(start as usize).cast() }
}

/// Writes before anything is written that comes later in the program.
///
/// For WebAssembly alone: there compilers otherwise move writes to other places past each other, and each moved write makes the engine hold more
/// numbers at a time than it has registers.
#[inline(always)]
pub fn write_in_turn<T: Copy>(to: &mut T, x: T) {
    if cfg!(target_arch = "wasm32") {
        // SAFETY: a reference can be written to, and a copy has nothing to be dropped.
        unsafe { std::ptr::write_volatile(to, x) }
    } else {
        *to = x;
    }
}

#[inline(always)]
pub fn load<L: Lanes>(from: &Lane<L::Scalar>, part: usize) -> L {
    L::load(&from.0, part)
}

#[inline(always)]
pub fn load3<L: Lanes>(from: &[Lane<L::Scalar>; 3], part: usize) -> [L; 3] {
    [load(&from[0], part), load(&from[1], part), load(&from[2], part)]
}

#[inline(always)]
pub fn store3<L: Lanes>(to: &mut [Lane<L::Scalar>; 3], part: usize, x: &[L; 3]) {
    x[0].store(&mut to[0].0, part);
    x[1].store(&mut to[1].0, part);
    x[2].store(&mut to[2].0, part);
}

#[inline(always)]
pub fn add<L: Lanes>(to: &mut [Lane<L::Scalar>; 3], part: usize, x: &[L; 3]) {
    let at = load3::<L>(to, part);
    store3(to, part, &[at[0] + x[0], at[1] + x[1], at[2] + x[2]]);
}

#[inline(always)]
pub fn cross<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Components along the axes of a frame.
#[inline(always)]
pub fn into_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    [dot(&frame[0], v), dot(&frame[1], v), dot(&frame[2], v)]
}

#[inline(always)]
pub fn dot<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The sum of the vectors of a frame times the components along them.
#[inline(always)]
pub fn out_of_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    let [x, y, z] = frame;
    [
        x[0] * v[0] + y[0] * v[1] + z[0] * v[2],
        x[1] * v[0] + y[1] * v[1] + z[1] * v[2],
        x[2] * v[0] + y[2] * v[1] + z[2] * v[2],
    ]
}

/// What happens in a substep at as many contacts of a group as a register holds.
struct Part<L: Lanes, M: Motion<L>> {
    /// Points in the fullest lane.
    count: u8,
    motion: M,
    sum: M::Wrench,
}

impl<L: Lanes, M: Motion<L>> Part<L, M> {
    /// Those of a group.
    fn of(group: &Group<L::Scalar>) -> impl Iterator<Item = Self> {
        group.counts.chunks_exact(L::WIDTH).map(|counts| {
            let count = counts.iter().fold(0, |most, &count| most.max(count));
            Self { count, motion: M::still(), sum: M::no_force() }
        })
    }
}

/// The contact law on some groups: velocities in, forces out, springs advanced.
///
/// Each stage is done for all of them before the next is begun: its loop is short, and a processor looks ahead from one contact into others.
/// Parts are lent to `zip`, or it would walk both by one index and multiply that at each step.
#[inline(always)]
fn contacts<L: Lanes, F: Form<L::Scalar>>(
    groups: &mut [Group<L::Scalar>],
    parts: &mut [Part<L, F::Motion<L>>],
    law: &Law<L::Scalar>,
    velocity: &[Row<L::Scalar>],
    force: &mut [Row<L::Scalar>],
) {
    for (group, parts) in groups.iter().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            if LANES == L::WIDTH || part.count > 0 {
                F::relative::<L>(group, i, velocity, &mut part.motion);
            }
        }
    }
    for (group, parts) in groups.iter_mut().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            part.sum = springs(group, i, part.count, law, &part.motion);
        }
    }
    for (group, parts) in groups.iter().zip(&mut parts.chunks_exact_mut(LANES / L::WIDTH)) {
        for (i, part) in parts.iter_mut().enumerate() {
            if LANES == L::WIDTH || part.count > 0 {
                F::react::<L>(group, i, &mut part.sum, force);
            }
        }
    }
}

/// The springs of a part of a group of which the fullest lane has `count` points. Written out, for a compiler keeps a loop over them.
#[inline(always)]
fn springs<L: Lanes, M: Motion<L>>(
    group: &mut Group<L::Scalar>,
    part: usize,
    count: u8,
    law: &Law<L::Scalar>,
    motion: &M,
) -> M::Wrench {
    let mut sum = M::no_force();
    let relaxation = load(&group.relaxation, part);
    let [p, q, r, s] = &mut group.points;
    if count > 0 {
        spring(p, part, law, relaxation, motion, &mut sum);
    }
    if count > 1 {
        spring(q, part, law, relaxation, motion, &mut sum);
    }
    if count > 2 {
        spring(r, part, law, relaxation, motion, &mut sum);
    }
    if count > 3 {
        spring(s, part, law, relaxation, motion, &mut sum);
    }
    sum
}

/// The springs of one point in each lane, from the motion of B relative to A along normal, tangent, tangent.
#[inline(always)]
fn spring<L: Lanes, M: Motion<L>>(
    p: &mut PointLanes<L::Scalar>,
    part: usize,
    law: &Law<L::Scalar>,
    relaxation: L,
    motion: &M,
    sum: &mut M::Wrench,
) {
    let zero = L::zero();
    let arm = [load::<L>(&p.arm[0], part), load::<L>(&p.arm[1], part)];
    let lever = [load::<L>(&p.lever[0], part), load::<L>(&p.lever[1], part)];

    // velocity of the point, its torsional part on the shorter lever; in a substep it is a way
    let [vn, u1, u2] = motion.at(&arm, &lever);

    // normal: a spring, a damper and a Maxwell element, that do not pull; an open point has no stiffness
    let gap = load::<L>(&p.gap, part) + vn;
    let closed = gap.less_than(zero);
    gap.store(&mut p.gap.0, part);
    // a wider register is hardly ever open in all lanes
    if L::WIDTH == 1 && !L::any(closed) {
        zero.store(&mut p.creep.0, part);
        zero.store(&mut p.stretch[0].0, part);
        zero.store(&mut p.stretch[1].0, part);
        zero.store(&mut p.pull.0, part);
        return;
    }
    let creep = L::mask(closed, load::<L>(&p.creep, part) * L::splat(law.keep) + vn);
    let k = L::mask(closed, load::<L>(&p.stiffness, part));
    // towards each other is negative here
    let pull = k * ((gap + creep) + relaxation * vn);
    let pull = L::mask(pull.less_than(zero), pull);
    creep.store(&mut p.creep.0, part);
    pull.store(&mut p.pull.0, part);

    // tangential: a spring and a damper within Coulomb's cone
    let kt = L::splat(law.tangential) * k;
    let ct = L::splat(law.tangential_relaxation) * relaxation;
    let mut s1 = L::mask(closed, load::<L>(&p.stretch[0], part) + u1);
    let mut s2 = L::mask(closed, load::<L>(&p.stretch[1], part) + u2);
    let (mut g1, mut g2) = (kt * (s1 + ct * u1), kt * (s2 + ct * u2));
    let limit = L::splat(law.mu_kinetic) * pull;
    let square = g1 * g1 + g2 * g2;
    if L::any((limit * limit).less_than(square)) {
        let q = slide(law, -pull, u1 * u1 + u2 * u2, square);
        (s1, s2, g1, g2) = (s1 * q, s2 * q, g1 * q, g2 * q);
    }
    s1.store(&mut p.stretch[0].0, part);
    s2.store(&mut p.stretch[1].0, part);

    M::add(sum, &[pull, g1, g2], &arm, &lever);
}

/// What brings friction and its springs back to Coulomb's cone, from the squares of speed and friction. The cone narrows from static to
/// kinetic with the speed of sliding, mu = mu_k + (mu_s - mu_k) / (1 + (u / u_s)²), so that a sliding contact does not stick again at
/// each substep.
#[inline(always)]
fn slide<L: Lanes>(law: &Law<L::Scalar>, n: L, speed: L, friction: L) -> L {
    let one = L::splat_f64(1.0);
    let mu = L::splat(law.mu_kinetic) + L::splat(law.mu_excess) / (one + speed * L::splat(law.stribeck));
    let limit = mu * n;
    let size = friction.sqrt();
    L::select(limit.less_than(size), limit / size, one)
}
