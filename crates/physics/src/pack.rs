//! Packing: from bodies and manifolds to the groups of the inner loop, and back.
//!
//! Only points that can touch before the next sync are packed. Entries of up to four points, fullest first, go to the first group of
//! eight in which there is room and neither body occurs. The order of the sums of forces follows from that
//! and is the same on every machine.

use glam::DVec3;

use crate::batch;
use crate::body::{Bodies, FLOOR, Shapes, world_tensor};
use crate::constants::{FLOOR_STEP_LIMIT, MAXWELL_TIME, STEP_LIMIT};
use crate::island::islands;
use crate::kernel::{BodyLanes, Group, Kernel, Lane, Law, QUARTER, Row, SLOTS, vector};
use crate::lanes::{LANES, ROW, Real};
use crate::manifold::Manifold;

/// Up to four points of a manifold.
#[derive(Debug, Clone, Copy)]
struct Entry {
    manifold: u32,
    count: usize,
    points: [u8; SLOTS],
}

/// The entries, sixteen to a group of the inner loop.
#[derive(Debug, Clone, Default)]
pub struct Packing {
    entries: Vec<Entry>,
    /// Bodies on which only their load acts: they fly in closed form, see [`crate::sync::fly`].
    pub free: Vec<bool>,
}

/// What the packing needs to know of the world besides bodies and manifolds.
#[derive(Debug, Clone)]
pub struct Batch {
    /// Substep, s.
    pub h: f64,
    /// Static and kinetic friction.
    pub mu: (f64, f64),
    /// Damping ratio.
    pub zeta: f64,
    /// Stiffness of the scene, N/m.
    pub stiffness: f64,
    /// How far a point of each body may get before the next sync, m.
    pub travel: Vec<f64>,
    /// Force and torque on each body other than from contacts, N and N m.
    pub load: Vec<(DVec3, DVec3)>,
    /// Bodies that forces do not move in this batch.
    pub held: Vec<bool>,
}

impl Packing {
    /// Chooses the points and lays out the groups. Points left out lose their history: they are open.
    pub fn plan(&mut self, manifolds: &mut [Manifold], batch: &Batch) {
        self.entries.clear();
        let still = |i: u32| i == FLOOR || batch.held[i as usize];
        let reach = |i: u32| if i == FLOOR { 0.0 } else { batch.travel[i as usize] };
        for (index, manifold) in manifolds.iter_mut().enumerate() {
            if still(manifold.a) && still(manifold.b) {
                continue;
            }
            let limit = reach(manifold.a) + reach(manifold.b);
            let mut entry = Entry { manifold: index as u32, count: 0, points: [0; SLOTS] };
            for (p, point) in manifold.points.iter_mut().enumerate() {
                if point.gap > limit {
                    point.forget();
                    continue;
                }
                if entry.count == SLOTS {
                    self.entries.push(entry);
                    entry.count = 0;
                }
                entry.points[entry.count] = p as u8;
                entry.count += 1;
            }
            if entry.count > 0 {
                self.entries.push(entry);
            }
        }
        self.entries.sort_by_key(|e| std::cmp::Reverse(e.count));

        self.free = batch.held.iter().map(|held| !held).collect();
        for entry in &self.entries {
            let manifold = &manifolds[entry.manifold as usize];
            for i in [manifold.a, manifold.b].into_iter().filter(|&i| i != FLOOR) {
                self.free[i as usize] = false;
            }
        }
    }

    /// Fills the inner loop.
    pub fn load<R: Real>(&self, kernel: &mut Kernel<R>, manifolds: &[Manifold], shapes: &Shapes, bodies: &Bodies, batch: &Batch) -> Law<R> {
        let references = self.references(manifolds, bodies, batch);
        load_bodies(kernel, shapes, bodies, batch, &self.free, &references);
        let floor = (kernel.velocity.len() - 1) as u32 * ROW as u32;
        kernel.groups.clear();
        for entries in self.entries.chunks(LANES) {
            let mut group = Group::new(floor);
            for (l, entry) in entries.iter().enumerate() {
                let manifold = &manifolds[entry.manifold as usize];
                let mover = if manifold.a == FLOOR || batch.held[manifold.a as usize] { manifold.b } else { manifold.a };
                load_entry(&mut group, l, manifold, bodies, references[mover as usize]);
                load_points(&mut group, l, entry, manifold, springs(manifold, shapes, batch));
            }
            kernel.groups.push(group);
        }
        Law {
            h: R::from_f64(batch.h),
            keep: R::from_f64(1.0 - batch.h / MAXWELL_TIME),
            mu_kinetic: R::from_f64(batch.mu.1),
            mu_excess: R::from_f64(batch.mu.0 - batch.mu.1),
        }
    }

    /// The reference point of each body's island, m: the mean of the centres of the bodies that the entries join. Near enough for
    /// single precision, and the same for both bodies of every entry that move.
    fn references(&self, manifolds: &[Manifold], bodies: &Bodies, batch: &Batch) -> Vec<DVec3> {
        let moves = |i: u32| i != FLOOR && !batch.held[i as usize];
        let joined = self.entries.iter().map(|e| &manifolds[e.manifold as usize]);
        let joined = joined.filter(|m| moves(m.a) && moves(m.b)).map(|m| (m.a, m.b));
        let island = islands(bodies.len(), joined);
        let mut sums = vec![(DVec3::ZERO, 0.0); bodies.len()];
        for (i, &root) in island.iter().enumerate() {
            let (sum, count) = &mut sums[root as usize];
            *sum += bodies.position[i];
            *count += 1.0;
        }
        island.iter().map(|&root| sums[root as usize].0 / sums[root as usize].1).collect()
    }

    /// Takes the springs back into the manifolds.
    pub fn unload<R: Real>(&self, kernel: &Kernel<R>, manifolds: &mut [Manifold]) {
        for (entries, group) in self.entries.chunks(LANES).zip(&kernel.groups) {
            for (l, entry) in entries.iter().enumerate() {
                let points = &mut manifolds[entry.manifold as usize].points;
                for (from, &p) in group.points.iter().zip(&entry.points[..entry.count]) {
                    let to = &mut points[p as usize];
                    to.stretch = [from.stretch[0].0[l].to_f64(), from.stretch[1].0[l].to_f64()];
                    to.creep = from.creep.0[l].to_f64();
                    to.force = from.normal.0[l].to_f64();
                }
            }
        }
    }
}

/// Puts the geometry of a manifold into lane `l`.
fn load_entry<R: Real>(group: &mut Group<R>, l: usize, manifold: &Manifold, bodies: &Bodies, reference: DVec3) {
    let (center_a, axes_a) = bodies.pose(manifold.a);
    let centroid = center_a + axes_a * manifold.centroid;
    let set = |to: &mut [Lane<R>; 3], x: DVec3| {
        for k in 0..3 {
            to[k].0[l] = R::from_f64(x[k]);
        }
    };
    for k in 0..3 {
        set(&mut group.frame[k], axes_a * manifold.frame[k]);
    }
    set(&mut group.arm, centroid - reference);
    group.b[l] = manifold.b * ROW as u32;
    if manifold.a != FLOOR {
        group.a[l] = manifold.a * ROW as u32;
    }
}

/// Puts the springs of an entry into lane `l`.
fn load_points<R: Real>(group: &mut Group<R>, l: usize, entry: &Entry, manifold: &Manifold, (stiffness, damping): (f64, f64)) {
    let levers = manifold.levers();
    let count = &mut group.counts[l / QUARTER];
    *count = (*count).max(entry.count as u32);
    group.relaxation.0[l] = R::from_f64(damping / stiffness);
    for (&p, to) in entry.points[..entry.count].iter().zip(&mut group.points) {
        let from = &manifold.points[p as usize];
        let put = |to: &mut Lane<R>, x: f64| to.0[l] = R::from_f64(x);
        let lever = levers(from);
        for (k, lever) in lever.into_iter().enumerate() {
            put(&mut to.arm[k], from.arm[k]);
            put(&mut to.lever[k], lever);
            put(&mut to.stretch[k], from.stretch[k]);
        }
        put(&mut to.gap, from.gap);
        put(&mut to.creep, from.creep);
        put(&mut to.stiffness, stiffness * from.weight);
    }
}

/// Stiffness (N/m) and damping (N s/m) of a manifold, as much of them as the explicit step can hold.
///
/// A mode of stiffness k and damping c on the mobility X is stable while 2 k X h² + 2 c X h < 4; the Maxwell element doubles k. In
/// a column of blocks that rock against each other each has a contact on both sides, which leaves 2 for one; the floor has but one
/// side. Crossed blocks are far below the limit, blocks lying flat on each other would be above it.
fn springs(manifold: &Manifold, shapes: &Shapes, batch: &Batch) -> (f64, f64) {
    let inv = |i: u32| if i == FLOOR { 0.0 } else { shapes.mass[i as usize].recip() };
    let mass = (inv(manifold.a) + inv(manifold.b)).recip();
    let limit = if manifold.a == FLOOR { FLOOR_STEP_LIMIT } else { STEP_LIMIT };
    let (h, x) = (batch.h, manifold.mobility);
    let stiffness = (batch.stiffness * manifold.area).min(0.6 * limit / (2.0 * h * h * x));
    let damping = 2.0 * batch.zeta * (stiffness * mass).sqrt();
    (stiffness, damping.min((limit - 2.0 * h * h * stiffness * x) / (2.0 * h * x)))
}

fn load_bodies<R: Real>(kernel: &mut Kernel<R>, shapes: &Shapes, bodies: &Bodies, batch: &Batch, free: &[bool], references: &[DVec3]) {
    let n = bodies.len();
    let blocks = n.div_ceil(LANES);
    // one beyond the bodies: the floor
    let rows = blocks * LANES + 1;
    kernel.len = n;
    kernel.velocity.clear();
    kernel.velocity.resize(rows, Row::default());
    kernel.load.clear();
    kernel.load.resize(rows, Row::default());
    kernel.force.resize(rows, Row::default());
    kernel.bodies.clear();
    kernel.bodies.resize(blocks, BodyLanes::default());
    let far = R::from_f64(1e30);
    for block in &mut kernel.bodies {
        block.travel_bound = Lane([far; LANES]);
        block.turn_bound = Lane([far; LANES]);
    }
    let row = |x: DVec3, y: DVec3| Row([x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0].map(R::from_f64));
    for (i, &free) in free.iter().enumerate() {
        let (block, l) = (&mut kernel.bodies[i / LANES], i % LANES);
        let offset = bodies.position[i] - references[i];
        let (v, w) = (bodies.velocity[i], bodies.spin[i]);
        kernel.velocity[i] = row(v - w.cross(offset), w);
        for k in 0..3 {
            block.velocity[k].0[l] = R::from_f64(v[k]);
            block.spin[k].0[l] = R::from_f64(w[k]);
            block.offset[k].0[l] = R::from_f64(offset[k]);
        }
        block.radius.0[l] = R::from_f64(shapes.radius[i]);
        block.travel_bound.0[l] = R::from_f64(batch.travel[i]);
        block.turn_bound.0[l] = R::from_f64(batch::turn(bodies, i, !free));
        if batch.held[i] || free {
            continue;
        }
        let (force, torque) = batch.load[i];
        kernel.load[i] = row(force, torque + offset.cross(force));
        block.inv_mass.0[l] = R::from_f64(shapes.mass[i].recip());
        let tensor = world_tensor(bodies.orientation[i], shapes.inertia[i].recip());
        let (x, y, z) = (tensor.x_axis, tensor.y_axis, tensor.z_axis);
        for (to, from) in block.inv_inertia.iter_mut().zip([x.x, y.y, z.z, x.y, x.z, y.z]) {
            to.0[l] = R::from_f64(from);
        }
    }
}

/// Displacement, turn, velocity and spin of a body after a batch.
pub fn motion<R: Real>(kernel: &Kernel<R>, i: usize) -> [DVec3; 4] {
    let (block, l) = (&kernel.bodies[i / LANES], i % LANES);
    let (velocity, spin) = kernel.motion(i);
    [vector(&block.shift, l), vector(&block.turn, l), velocity, spin]
}
