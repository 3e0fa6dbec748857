//! Packing: from bodies and manifolds to the groups of the inner loop, and back.
//!
//! Only points that can touch before the next sync are packed. An entry holds up to four points of
//! a manifold and occupies one lane. When everything is repacked, the fullest entries come first;
//! otherwise entries of synced bodies leave their lanes, and new ones take the first free lanes.
//! The order in which forces are summed follows from that and is the same on every machine.

use arrayvec::ArrayVec;
use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::collision::cached_pair::relative_speed;
use crate::collision::contacts::Contacts;
use crate::collision::friction_arms::friction_arms;
use crate::collision::manifold::Manifold;
use crate::collision::stable_spring::stable_spring;
use crate::constants::{RUNAWAY_SPEED, UNLIMITED};
use crate::derived::Derived;
use crate::kernel::body_model::{BodyModel, KernelBody, UniformMotion};
use crate::kernel::inner_loop::Kernel;
use crate::kernel::layout::{Group, SLOTS};
use crate::kernel::sync_set::SyncSet;
use crate::kernel::tangential_refine::TangentialRefine;
use crate::kernel::vector::{LaneArray, set3};
use crate::lattice::particles::Particles;
use crate::simd::lanes::{LANES, Real};

/// Stride in manifolds between consecutive entries. Neighbours in the order of manifolds share a
/// body, and adding to the same sum twice in a row would wait for the first addition.
const SPREAD: usize = 7;

/// Up to four points of a manifold.
#[derive(Debug, Clone)]
struct Entry {
    a: u32,
    b: u32,
    /// Index of the manifold when the entry was packed.
    manifold: usize,
    /// Indices of the points in the manifold.
    points: ArrayVec<u8, SLOTS>,
}

/// State of the bodies that packing reads.
#[derive(Debug, Clone, Copy)]
pub struct PackInput<'a> {
    pub shapes: &'a Shapes,
    pub bodies: &'a Bodies,
    /// Particles of each body; empty for rigid bodies.
    pub particles: &'a [Particles],
    pub derived: &'a Derived,
    /// Time until the next sync of all moving bodies, s.
    pub time: f64,
}

/// Entries in the lanes of a kernel, and budgets of the bodies.
#[derive(Debug, Clone, Default)]
pub struct Packing {
    /// Entry in each lane, group by group.
    lanes: Vec<Option<Entry>>,
    /// Number of entries of each body.
    entry_counts: Vec<u32>,
    /// True for bodies on which only their load acts: their flight has a closed form, see
    /// [`crate::cluster::sync::integrate_ballistic`].
    pub ballistic: Vec<bool>,
    /// Travel of each body's points until its next sync, m.
    pub travel_budget: Vec<f64>,
    /// Rotation of each body until its next sync, rad.
    pub rotation_budget: Vec<f64>,
    /// Deviation of each body's points from uniform motion until its next sync, m.
    pub deviation_budget: Vec<f64>,
    /// Motion of each body that its budgets predict.
    pub uniform: Vec<UniformMotion>,
    /// Weight and applied force (N) and torque (N m) on each body: all but contacts, hand and
    /// drives.
    pub load: Vec<(DVec3, DVec3)>,
    /// Substep of the frame at which each body was synced.
    pub synced_at: Vec<usize>,
    /// Reference point at which twists are compared, m.
    reference: DVec3,
}

/// Reference point of a cluster, m: the mean of the positions. Bodies that leave it fast are left
/// out: a reference far from the others would cost them digits.
fn reference_point(bodies: &Bodies) -> DVec3 {
    let slow = |i: &usize| bodies.velocity[*i].length_squared() < RUNAWAY_SPEED * RUNAWAY_SPEED;
    let count = (0..bodies.len()).filter(slow).count();
    if count == 0 {
        return bodies.position.iter().sum::<DVec3>() / bodies.len() as f64;
    }
    (0..bodies.len()).filter(slow).map(|i| bodies.position[i]).sum::<DVec3>() / count as f64
}

impl Packing {
    /// Resets the packing at the start of a frame.
    pub fn reset(&mut self, bodies: &Bodies) {
        let n = bodies.len();
        self.lanes.clear();
        self.entry_counts.clear();
        self.entry_counts.resize(n, 0);
        self.ballistic.clear();
        self.ballistic.resize(n, false);
        self.travel_budget.clear();
        self.travel_budget.resize(n, 0.0);
        self.rotation_budget.clear();
        self.rotation_budget.resize(n, 0.0);
        self.deviation_budget.clear();
        self.deviation_budget.resize(n, UNLIMITED);
        self.uniform.clear();
        self.uniform.resize(n, UniformMotion::default());
        self.load.clear();
        self.load.resize(n, (DVec3::ZERO, DVec3::ZERO));
        self.synced_at.clear();
        self.synced_at.resize(n, 0);
        self.reference = reference_point(bodies);
    }

    /// Stores the springs of synced bodies in the manifolds, and removes their entries from the
    /// lanes.
    pub fn unpack<R: Real, B: BodyModel<R>>(
        &mut self,
        kernel: &mut Kernel<R, B>,
        contacts: &mut Contacts,
        synced: &SyncSet,
        refine: Option<&TangentialRefine<R>>,
    ) {
        for (index, lane) in self.lanes.iter_mut().enumerate() {
            let Some(entry) = lane else { continue };
            if !synced.touches(entry.a, entry.b) {
                continue;
            }
            let (group, l) = (&mut kernel.groups[index / LANES], index % LANES);
            if let Some(manifold) = contacts.find_from(entry.manifold, (entry.a, entry.b)) {
                let Manifold { points, free_depth, .. } = &mut contacts.manifolds[manifold];
                for (slot, (from, &p)) in group.points.iter().zip(&entry.points).enumerate() {
                    let to = &mut points[p as usize];
                    let [x, y, turned] = &from.tangential;
                    let tangential = [x.0[l], y.0[l], turned.0[l]];
                    to.tangential = refine.map_or(tangential.map(R::to_f64), |refine| {
                        refine.refine(to.tangential, tangential, (index, slot))
                    });
                    to.maxwell = from.maxwell.0[l].to_f64();
                    let gap = from.gap.0[l].to_f64();
                    to.gap = gap - *free_depth;
                    let compression = -(gap + to.maxwell);
                    // The maximum of two zeros has a sign that depends on the target.
                    to.normal_force = if compression > 0.0 { from.stiffness.0[l].to_f64() * compression } else { 0.0 };
                }
            }
            if !synced.all {
                for i in [entry.a, entry.b].into_iter().filter(|&i| i != FLOOR) {
                    self.entry_counts[i as usize] -= 1;
                }
                *lane = None;
                group.clear_lane(l);
            }
        }
        if synced.all {
            self.lanes.clear();
            self.entry_counts.fill(0);
            kernel.groups.clear();
        }
    }

    /// Packs the contacts of synced bodies.
    pub fn pack<R: Real, B: BodyModel<R>>(
        &mut self,
        kernel: &mut Kernel<R, B>,
        contacts: &mut Contacts,
        input: &PackInput,
        synced: &SyncSet,
    ) {
        let mut index = 0;
        for entry in self.select_entries(contacts, input, synced) {
            while self.lanes.get(index).is_some_and(Option::is_some) {
                index += 1;
            }
            if index == self.lanes.len() {
                self.lanes.resize_with(index + LANES, || None);
                kernel.groups.push(Group::new(kernel.floor_offset()));
            }
            let manifold = &contacts.manifolds[entry.manifold];
            let (rows_a, rows_b) = (
                if manifold.a == FLOOR { kernel.floor_offset() } else { kernel.row_offset(manifold.a) },
                kernel.row_offset(manifold.b),
            );
            let (group, l) = (&mut kernel.groups[index / LANES], index % LANES);
            group.set_bodies(l, [rows_a, rows_b]);
            self.pack_geometry(group, l, manifold, input.bodies);
            let [kinetic, excess] = friction(manifold, input.shapes, input.derived);
            (group.mu_kinetic.0[l], group.mu_excess.0[l]) = (R::from_f64(kinetic), R::from_f64(excess));
            let (stiffness, damping) = stable_spring(manifold, input.shapes, input.bodies);
            pack_points(group, l, &entry, manifold, (stiffness, damping / stiffness / input.derived.h));
            pack_friction_arms(group, l, &entry, manifold, input);
            for i in [entry.a, entry.b].into_iter().filter(|&i| i != FLOOR) {
                self.entry_counts[i as usize] += 1;
            }
            self.lanes[index] = Some(entry);
        }
    }

    /// Selects the points of synced bodies that can touch before the next sync, as entries in the
    /// order in which they are packed. Points left out are open and lose their history.
    fn select_entries(&self, contacts: &mut Contacts, input: &PackInput, synced: &SyncSet) -> Vec<Entry> {
        let fixed = |i: u32| i == FLOOR || !input.bodies.is_active(i as usize);
        let mut entries: Vec<Entry> = Vec::new();
        for (index, manifold) in contacts.manifolds.iter_mut().enumerate() {
            let (a, b) = (manifold.a, manifold.b);
            if !synced.touches(a, b) || (fixed(a) && fixed(b)) {
                continue;
            }
            let limit = self.closing_bound(input, [a, b]);
            let empty = Entry { a, b, manifold: index, points: ArrayVec::new() };
            let mut entry = empty.clone();
            for (p, point) in manifold.points.iter_mut().enumerate() {
                if point.gap > limit {
                    point.reset();
                    continue;
                }
                if entry.points.is_full() {
                    entries.push(std::mem::replace(&mut entry, empty.clone()));
                }
                entry.points.push(p as u8);
            }
            if !entry.points.is_empty() {
                entries.push(entry);
            }
        }
        entries.sort_by_key(|e| (std::cmp::Reverse(e.points.len()), e.manifold % SPREAD));
        entries
    }

    /// Upper bound of what two bodies close before the next sync of either, m: their budgets of
    /// travel, or their uniform motion with their budgets of deviation.
    fn closing_bound(&self, input: &PackInput, [a, b]: [u32; 2]) -> f64 {
        let of = |budget: &[f64], i: u32| if i == FLOOR { 0.0 } else { budget[i as usize] };
        let travel = of(&self.travel_budget, a) + of(&self.travel_budget, b);
        // A quiet body has no budget of deviation and may go on for a frame, with less than its
        // budget of travel.
        let deviation = |i: u32| of(&self.deviation_budget, i).min(of(&self.travel_budget, i));
        let uniform = relative_speed(input.shapes, input.bodies, [a, b]) * input.time;
        travel.min(uniform + deviation(a) + deviation(b))
    }

    /// Packs the geometry of a manifold into lane `l`.
    fn pack_geometry<R: Real>(&self, group: &mut Group<R>, l: usize, manifold: &Manifold, bodies: &Bodies) {
        let (center_a, axes_a) = bodies.pose(manifold.a);
        let centroid = center_a + axes_a * manifold.centroid;
        for (to, axis) in group.frame.iter_mut().zip(manifold.frame_in_world(bodies, axes_a)) {
            set3(to, l, axis);
        }
        set3(&mut group.centroid, l, centroid - self.reference);
    }

    /// Loads body `i` into its lane; `actuated` is true if a hand, force or drive acts on it.
    pub fn load_body<R: Real, B: BodyModel<R>>(
        &mut self,
        kernel: &mut Kernel<R, B>,
        &PackInput { shapes, bodies, particles, derived, .. }: &PackInput,
        i: usize,
        actuated: bool,
    ) {
        let active = bodies.is_active(i);
        self.ballistic[i] = active && self.entry_counts[i] == 0 && !actuated;
        let (force, torque) = self.load[i];
        let lattice = particles.get(i).zip(derived.springs.as_ref());
        let body = KernelBody {
            h: kernel.h,
            active,
            mass: shapes.mass[i],
            inertia: shapes.inertia[i],
            radius: shapes.radius[i],
            offset: bodies.position[i] - self.reference,
            orientation: bodies.orientation[i],
            velocity: bodies.velocity[i],
            spin: bodies.spin[i],
            travel_budget: self.travel_budget[i],
            rotation_budget: self.rotation_budget[i],
            deviation_budget: self.deviation_budget[i],
            uniform: self.uniform[i],
            force,
            torque,
            lattice: lattice.map(|(particles, springs)| (particles, shapes.particles[i], springs)),
        };
        let rows = B::ROWS * i..B::ROWS * (i + 1);
        kernel.bodies[i / LANES].load(i % LANES, &body, &mut kernel.velocity[rows.clone()], &mut kernel.load[rows]);
    }

    /// Returns true if a body has packed contacts.
    pub fn has_contacts(&self, i: usize) -> bool {
        self.entry_counts[i] > 0
    }
}

/// Packs the points of an entry into lane `l`, with stiffness (N/m) and damping over stiffness
/// (substeps).
fn pack_points<R: Real>(
    group: &mut Group<R>,
    l: usize,
    entry: &Entry,
    manifold: &Manifold,
    (stiffness, damping_time): (f64, f64),
) {
    group.counts[l] = entry.points.len() as u8;
    group.damping_time.0[l] = R::from_f64(damping_time);
    for (&p, to) in entry.points.iter().zip(&mut group.points) {
        let from = &manifold.points[p as usize];
        let set = |to: &mut LaneArray<R>, x: f64| to.0[l] = R::from_f64(x);
        for (to, arm) in to.arm.iter_mut().zip(from.arm) {
            set(to, arm);
        }
        for (to, tangential) in to.tangential.iter_mut().zip(from.tangential) {
            set(to, tangential);
        }
        set(&mut to.gap, from.gap + manifold.free_depth);
        set(&mut to.maxwell, from.maxwell);
        set(&mut to.stiffness, stiffness * from.weight);
    }
}

/// Packs the levers of friction of an entry into lane `l`.
fn pack_friction_arms<R: Real>(group: &mut Group<R>, l: usize, entry: &Entry, manifold: &Manifold, input: &PackInput) {
    let friction_arms = friction_arms(manifold, input.shapes, input.bodies);
    for (&p, to) in entry.points.iter().zip(&mut group.points) {
        for (to, arm) in to.friction_arm.iter_mut().zip(friction_arms(&manifold.points[p as usize])) {
            to.0[l] = R::from_f64(arm);
        }
    }
}

/// Kinetic coefficient of friction of a manifold, and what the static one exceeds it by. A pair has
/// the geometric mean of its bodies.
fn friction(manifold: &Manifold, shapes: &Shapes, derived: &Derived) -> [f64; 2] {
    let of = |i: u32| if i == FLOOR { derived.friction } else { shapes.friction[i as usize] };
    let (a, b) = (of(manifold.a), of(manifold.b));
    // The root of a square is not always the number.
    let fixed = if a == b { a } else { (a * b).sqrt() };
    let kinetic = fixed * derived.kinetic_ratio;
    [kinetic, fixed - kinetic]
}
