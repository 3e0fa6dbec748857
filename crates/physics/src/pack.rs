//! Packing: from bodies and manifolds to the groups of the inner loop, and back.
//!
//! Only points that can touch before the next sync are packed, as entries of up to four points of a manifold, an entry a lane. Where
//! all is laid out anew the fullest come first; otherwise entries of what has moved leave their lanes, and new ones take the first that
//! are free. The order of the sums of forces follows from that and is the same on every machine.

use arrayvec::ArrayVec;
use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::constants::{FLOOR_STEP_LIMIT, STEP_LIMIT};
use crate::contacts::Contacts;
use crate::form::{Form, Loading};
use crate::kernel::{Group, Kernel, Lane, Row, SLOTS, put3};
use crate::lattice::{Particles, Springs};
use crate::manifold::Manifold;
use crate::moved::Moved;
use crate::setup::Setup;
use crate::simd::lanes::{LANES, Real};
use crate::ways::Ways;

/// Neighbours in the order of manifolds share a body, and a sum that is added to twice in a row is waited for: entries follow each other
/// in steps of this many manifolds.
const SPREAD: usize = 7;

/// Up to four points of a manifold.
#[derive(Debug, Clone)]
struct Entry {
    a: u32,
    b: u32,
    /// Where their manifold was when it was packed.
    at: usize,
    points: ArrayVec<u8, SLOTS>,
}

/// What is in the inner loop, and how far it may go there.
#[derive(Debug, Clone, Default)]
pub struct Packing {
    /// The entry in each lane, group by group.
    lanes: Vec<Option<Entry>>,
    /// How many entries each body has.
    entries: Vec<u32>,
    /// Bodies on which only their load acts: they fly in closed form, see [`crate::sync::fly`].
    pub free: Vec<bool>,
    /// How far a point of each body may get before it must be synced, m.
    pub reach: Vec<f64>,
    /// How far each may turn, rad.
    pub turn: Vec<f64>,
    /// Force and torque on each other than from contacts, hand and drives, N and N m.
    pub load: Vec<(DVec3, DVec3)>,
    /// Substep of the frame at which the pose of each was made exact.
    pub since: Vec<usize>,
    /// The point at which velocities are compared, m.
    reference: DVec3,
}

impl Packing {
    /// Begins a frame: nothing is packed.
    pub fn begin(&mut self, bodies: &Bodies) {
        let n = bodies.len();
        self.lanes.clear();
        self.entries.clear();
        self.entries.resize(n, 0);
        self.free.clear();
        self.free.resize(n, false);
        self.reach.clear();
        self.reach.resize(n, 0.0);
        self.turn.clear();
        self.turn.resize(n, 0.0);
        self.load.clear();
        self.load.resize(n, (DVec3::ZERO, DVec3::ZERO));
        self.since.clear();
        self.since.resize(n, 0);
        self.reference = bodies.position.iter().sum::<DVec3>() / n as f64;
    }

    /// Takes the springs of what has moved back into the manifolds, and their entries out of their lanes.
    pub fn unload<R: Real, F: Form<R>>(
        &mut self,
        kernel: &mut Kernel<R, F>,
        contacts: &mut Contacts,
        moved: &Moved,
        ways: Option<&Ways<R>>,
    ) {
        let floor = kernel.floor();
        for (at, lane) in self.lanes.iter_mut().enumerate() {
            let Some(entry) = lane else { continue };
            if !moved.touches(entry.a, entry.b) {
                continue;
            }
            let (group, l) = (&mut kernel.groups[at / LANES], at % LANES);
            if let Some(place) = contacts.find_at(entry.at, (entry.a, entry.b)) {
                let points = &mut contacts.manifolds[place].points;
                for (slot, (from, &p)) in group.points.iter().zip(&entry.points).enumerate() {
                    let to = &mut points[p as usize];
                    let stretch = [from.stretch[0].0[l], from.stretch[1].0[l]];
                    to.stretch =
                        ways.map_or(stretch.map(R::to_f64), |ways| ways.stretched(to.stretch, stretch, (at, slot)));
                    to.creep = from.creep.0[l].to_f64();
                    to.force = 0.0 - from.pull.0[l].to_f64();
                }
            }
            if !moved.all {
                for i in [entry.a, entry.b].into_iter().filter(|&i| i != FLOOR) {
                    self.entries[i as usize] -= 1;
                }
                *lane = None;
                group.open(l, floor);
            }
        }
        if moved.all {
            self.lanes.clear();
            self.entries.fill(0);
            kernel.groups.clear();
        }
    }

    /// Chooses the points of what has moved and gives them lanes. Points left out lose their history: they are open.
    pub fn load<R: Real, F: Form<R>>(
        &mut self,
        kernel: &mut Kernel<R, F>,
        contacts: &mut Contacts,
        shapes: &Shapes,
        bodies: &Bodies,
        setup: &Setup,
        moved: &Moved,
    ) {
        let still = |i: u32| i == FLOOR || !bodies.moves(i as usize);
        let reach = |i: u32| if i == FLOOR { 0.0 } else { self.reach[i as usize] };
        let mut chosen: Vec<Entry> = Vec::new();
        for (at, manifold) in contacts.manifolds.iter_mut().enumerate() {
            let (a, b) = (manifold.a, manifold.b);
            if !moved.touches(a, b) || (still(a) && still(b)) {
                continue;
            }
            let limit = reach(a) + reach(b);
            let empty = Entry { a, b, at, points: ArrayVec::new() };
            let mut entry = empty.clone();
            for (p, point) in manifold.points.iter_mut().enumerate() {
                if point.gap > limit {
                    point.forget();
                    continue;
                }
                if entry.points.is_full() {
                    chosen.push(std::mem::replace(&mut entry, empty.clone()));
                }
                entry.points.push(p as u8);
            }
            if !entry.points.is_empty() {
                chosen.push(entry);
            }
        }
        chosen.sort_by_key(|e| (std::cmp::Reverse(e.points.len()), e.at % SPREAD));
        let mut place = 0;
        for entry in chosen {
            while self.lanes.get(place).is_some_and(Option::is_some) {
                place += 1;
            }
            if place == self.lanes.len() {
                self.lanes.resize_with(place + LANES, || None);
                kernel.groups.push(Group::new(kernel.floor()));
            }
            let manifold = &contacts.manifolds[entry.at];
            let (rows_a, rows_b) =
                (if manifold.a == FLOOR { kernel.floor() } else { kernel.place(manifold.a) }, kernel.place(manifold.b));
            let (group, l) = (&mut kernel.groups[place / LANES], place % LANES);
            (group.a[l], group.b[l]) = (rows_a, rows_b);
            self.load_geometry(group, l, manifold, bodies);
            load_points(group, l, &entry, manifold, springs(manifold, shapes, setup), setup.h);
            for i in [entry.a, entry.b].into_iter().filter(|&i| i != FLOOR) {
                self.entries[i as usize] += 1;
            }
            self.lanes[place] = Some(entry);
        }
    }

    /// Puts the geometry of a manifold into lane `l`.
    fn load_geometry<R: Real>(&self, group: &mut Group<R>, l: usize, manifold: &Manifold, bodies: &Bodies) {
        let (center_a, axes_a) = bodies.pose(manifold.a);
        let centroid = center_a + axes_a * manifold.centroid;
        for (to, axis) in group.frame.iter_mut().zip(manifold.frame_in_world(bodies, axes_a)) {
            put3(to, l, axis);
        }
        put3(&mut group.arm, l, centroid - self.reference);
    }

    /// Puts a body into its lane. `acted` says that something acts on it besides contacts and its load.
    pub fn load_body<R: Real, F: Form<R>>(
        &mut self,
        kernel: &mut Kernel<R, F>,
        shapes: &Shapes,
        bodies: &Bodies,
        lattice: Option<(&Particles, &Springs)>,
        i: usize,
        acted: bool,
    ) {
        let moves = bodies.moves(i);
        self.free[i] = moves && self.entries[i] == 0 && !acted;
        let (force, torque) = self.load[i];
        let body = Loading {
            h: kernel.h,
            moves,
            mass: shapes.mass[i],
            inertia: shapes.inertia[i],
            radius: shapes.radius[i],
            offset: bodies.position[i] - self.reference,
            orientation: bodies.orientation[i],
            velocity: bodies.velocity[i],
            spin: bodies.spin[i],
            reach: self.reach[i],
            turn: self.turn[i],
            force,
            torque,
            lattice: lattice.map(|(particles, springs)| (particles, shapes.particles[i], springs)),
        };
        let rows = F::ROWS * i..F::ROWS * (i + 1);
        kernel.bodies[i / LANES].load(i % LANES, &body, &mut kernel.velocity[rows.clone()], &mut kernel.load[rows]);
    }

    /// Whether a body has entries.
    pub fn touches(&self, i: usize) -> bool {
        self.entries[i] > 0
    }
}

/// Puts the springs of an entry into lane `l`.
fn load_points<R: Real>(
    group: &mut Group<R>,
    l: usize,
    entry: &Entry,
    manifold: &Manifold,
    (stiffness, damping): (f64, f64),
    h: f64,
) {
    let levers = manifold.levers();
    group.counts[l] = entry.points.len() as u8;
    group.relaxation.0[l] = R::from_f64(damping / stiffness / h);
    for (&p, to) in entry.points.iter().zip(&mut group.points) {
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
/// A mode of stiffness k and damping c on the mobility X is stable while 2 k X h² + 2 c X h < 4; the Maxwell element doubles k. That
/// is for a contact alone: [`STEP_LIMIT`] and [`FLOOR_STEP_LIMIT`] are what one may use that has others beside it. Stiffness is held to
/// 0.6 of that and damping to what stiffness leaves. Nominal blocks that cross are within it, for the substep follows from them, see
/// [`crate::setup`]; blocks lying flat on each other would be above it.
fn springs(manifold: &Manifold, shapes: &Shapes, setup: &Setup) -> (f64, f64) {
    let inv = |i: u32| if i == FLOOR { 0.0 } else { shapes.mass[i as usize].recip() };
    let mass = (inv(manifold.a) + inv(manifold.b)).recip();
    let limit = if manifold.a == FLOOR { FLOOR_STEP_LIMIT } else { STEP_LIMIT };
    let (h, x) = (setup.h, manifold.mobility);
    let stiffness = (setup.stiffness * manifold.area).min(0.6 * limit / (2.0 * h * h * x));
    let damping = 2.0 * setup.zeta * (stiffness * mass).sqrt();
    (stiffness, damping.min((limit - 2.0 * h * h * stiffness * x) / (2.0 * h * x)))
}

/// Makes room for `n` bodies, all at rest and without bounds, and substeps of `h` (s).
pub fn make_room<R: Real, F: Form<R>>(kernel: &mut Kernel<R, F>, n: usize, h: f64) {
    let blocks = n.div_ceil(LANES);
    // one beyond the bodies: the floor
    let rows = F::ROWS * (blocks * LANES + 1);
    (kernel.len, kernel.h) = (n, h);
    kernel.groups.clear();
    for all in [&mut kernel.velocity, &mut kernel.load, &mut kernel.force] {
        all.clear();
        all.resize(rows, Row::default());
    }
    kernel.bodies.clear();
    kernel.bodies.resize(blocks, F::empty());
}
