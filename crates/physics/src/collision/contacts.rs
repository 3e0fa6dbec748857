//! Contact manifolds of a cluster, sorted by their keys, and the detection that updates them.

use arrayvec::ArrayVec;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR, Shapes, rotate_tensor};
use crate::collision::box_box::box_box;
use crate::collision::box_floor::box_floor;
use crate::collision::broad_phase::{Aabb, Neighbours, overlapping_pairs};
use crate::collision::cached_pair::{CachedPair, reach};
use crate::collision::cuboid::Cuboid;
use crate::collision::manifold::{MAX_POINTS, Manifold, key};
use crate::collision::pair_status::{PairStatus, Range};
use crate::collision::passivity::{SpringEnergy, thickness};
use crate::collision::separating_axis::LastAxis;
use crate::constants::{
    BUDGET_CHECK_INTERVAL, MARGIN_RANGE, MARGIN_SHARE, MARGIN_TIME, MIN_SUNK_DEPTH, STRAIN_INERTIA,
};

/// Largest number of new entries that are inserted one by one; more are appended and sorted.
const MAX_INSERTIONS: usize = 8;

/// Manifolds of a cluster, sorted by [`Manifold::key`], and the bounds of its bodies.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Contacts {
    pub manifolds: Vec<Manifold>,
    /// Pairs that are near, sorted by [`CachedPair::key`]: those with a manifold, and others.
    pub cache: Vec<CachedPair>,
    /// Bounds of the bodies at their last detection, grown by their margins: a body stays within
    /// them until its next detection.
    pub bounds: Vec<Aabb>,
    /// Swept bounds of each body for a frame or longer, see [`crate::cluster::partition`]; they
    /// contain `bounds`.
    pub swept: Vec<Aabb>,
    /// True if swept bounds have grown since the clusters were last updated.
    #[serde(skip)]
    pub outgrown: bool,
    /// Pairs of bodies of which the swept bounds overlap.
    #[serde(skip)]
    neighbours: Neighbours,
}

/// Which entries of a list are kept.
struct Kept {
    /// None where nothing is known.
    flags: Vec<Option<bool>>,
    at: usize,
}

impl Kept {
    fn new(len: usize) -> Self {
        Self { flags: vec![None; len], at: 0 }
    }

    fn set(&mut self, i: usize, kept: bool) {
        self.flags[i] = Some(kept);
    }

    /// Returns true if the next entry is kept; `default` decides where nothing is known.
    fn next(&mut self, default: impl Fn() -> bool) -> bool {
        self.at += 1;
        self.flags[self.at - 1].unwrap_or_else(default)
    }
}

/// Inserts entries into a list that is sorted by a key.
fn insert_sorted<T>(list: &mut Vec<T>, mut new: Vec<T>, key: impl Fn(&T) -> (u32, u32)) {
    if new.len() > MAX_INSERTIONS {
        list.append(&mut new);
        list.sort_by_key(&key);
    }
    for entry in new {
        let index = list.partition_point(|other| key(other) < key(&entry));
        list.insert(index, entry);
    }
}

impl Contacts {
    /// Recomputes the neighbours after a change of `swept`.
    pub fn update_neighbours(&mut self) {
        self.neighbours = Neighbours::new(self.swept.len(), &overlapping_pairs(&self.swept));
    }

    /// Sets the neighbours from pairs that the caller has computed.
    pub fn set_neighbours(&mut self, pairs: &[(u32, u32)]) {
        self.neighbours = Neighbours::new(self.swept.len(), pairs);
    }

    /// Index of the manifold of a pair; `hint` is tried first.
    pub fn find_from(&self, hint: usize, (low, high): (u32, u32)) -> Option<usize> {
        let found = self.manifolds.get(hint).is_some_and(|m| m.key() == key(low, high));
        if found { Some(hint) } else { self.find((low, high)) }
    }

    /// Index of the manifold of a pair.
    pub fn find(&self, (low, high): (u32, u32)) -> Option<usize> {
        self.manifolds.binary_search_by_key(&key(low, high), Manifold::key).ok()
    }

    /// Renews margins and bounds of the bodies in `due` (sorted) and returns the pairs of which the
    /// bounds overlap, lower index or floor first.
    ///
    /// A body hit harder than any body moved before leaves its swept bounds. These are then grown
    /// by `growth` (m), and `outgrown` is set.
    pub fn candidate_pairs(
        &mut self,
        shapes: &Shapes,
        bodies: &mut Bodies,
        due: &[u32],
        growth: f64,
    ) -> Vec<(u32, u32)> {
        let mut swept_changed = false;
        for i in due.iter().map(|&i| i as usize) {
            bodies.margin[i] = (bodies.max_point_speed(shapes, i) * MARGIN_TIME).clamp(MARGIN_RANGE.0, MARGIN_RANGE.1);
            bodies.detection_pose[i] = (bodies.position[i], bodies.orientation[i]);
            self.bounds[i] = Aabb::new(shapes, bodies, i, bodies.margin[i]);
            if !self.swept[i].contains(&self.bounds[i]) {
                self.swept[i] = self.bounds[i].grown(growth);
                swept_changed = true;
            }
        }
        if swept_changed {
            self.outgrown = true;
            self.update_neighbours();
        }
        let mut pairs = Vec::new();
        for &i in due {
            let bound = &self.bounds[i as usize];
            if bound.min.z <= 0.0 {
                pairs.push((FLOOR, i));
            }
            for &j in self.neighbours.of(i as usize) {
                // A pair of two due bodies is listed by its lower one.
                if (j > i || due.binary_search(&j).is_err()) && bound.overlaps(&self.bounds[j as usize]) {
                    pairs.push((i.min(j), i.max(j)));
                }
            }
        }
        pairs
    }

    /// Cached pairs that are to be tested again, of those that `is_synced` takes; pairs of a body
    /// in `due` (sorted) are left out.
    pub fn due_pairs(
        &self,
        shapes: &Shapes,
        bodies: &Bodies,
        due: &[u32],
        is_synced: impl Fn(u32, u32) -> bool,
    ) -> Vec<(u32, u32)> {
        let pairs = self.cache.iter().filter(|cached| {
            let [low, high] = cached.pair;
            is_synced(low, high)
                && due.binary_search(&low).is_err()
                && due.binary_search(&high).is_err()
                && cached.is_due(shapes, bodies)
        });
        pairs.map(|cached| cached.pair.into()).collect()
    }

    /// Tests the pairs, which must contain all candidate pairs of the bodies in `due` (sorted),
    /// unless their last test still holds, and updates the manifolds. The history of a persisting
    /// contact is preserved. Returns the number of pairs that were tested.
    pub fn detect(&mut self, shapes: &Shapes, bodies: &Bodies, due: &[u32], pairs: &[(u32, u32)]) -> usize {
        let (mut new_manifolds, mut new_pairs) = (Vec::new(), Vec::new());
        let (mut manifolds_kept, mut pairs_kept) = (Kept::new(self.manifolds.len()), Kept::new(self.cache.len()));
        let mut next = Manifold::new();
        let mut tested = 0;
        for &(low, high) in pairs {
            let index = self.find((low, high));
            let cached = self.cache.binary_search_by_key(&key(low, high), CachedPair::key).ok();
            if let Some(c) = cached
                && !self.cache[c].is_due(shapes, bodies)
            {
                pairs_kept.set(c, true);
                index.into_iter().for_each(|i| manifolds_kept.set(i, true));
                continue;
            }
            tested += 1;
            let reach = reach(shapes, bodies, [low, high]);
            let status = test_pair(shapes, bodies, [low, high], (reach, index.map(|i| &self.manifolds[i])), &mut next);
            let touches = matches!(status, PairStatus::Touching(_));
            if touches {
                limit_energy(&mut next, index.map(|i| &mut self.manifolds[i]), shapes, bodies);
            }
            match index {
                Some(i) if touches => self.manifolds[i].copy_from(&next),
                None if touches => new_manifolds.push(next.clone()),
                _ => {}
            }
            index.into_iter().for_each(|i| manifolds_kept.set(i, touches));
            let near = CachedPair::new(bodies, [low, high], reach, status);
            cached.into_iter().for_each(|c| pairs_kept.set(c, near.is_some()));
            match (cached, near) {
                (Some(c), Some(near)) => self.cache[c] = near,
                (None, Some(near)) => new_pairs.push(near),
                (_, None) => {}
            }
        }
        // What due bodies had and was not found again is removed.
        let is_due = |i: u32| i != FLOOR && due.binary_search(&i).is_ok();
        self.manifolds.retain(|m| manifolds_kept.next(|| !is_due(m.a) && !is_due(m.b)));
        self.cache.retain(|cached| pairs_kept.next(|| !cached.pair.into_iter().any(is_due)));
        insert_sorted(&mut self.manifolds, new_manifolds, Manifold::key);
        insert_sorted(&mut self.cache, new_pairs, CachedPair::key);
        tested
    }

    /// Detects all contacts of all bodies.
    pub fn detect_all(&mut self, shapes: &Shapes, bodies: &mut Bodies) {
        let all: Vec<u32> = (0..bodies.len() as u32).collect();
        let pairs = self.candidate_pairs(shapes, bodies, &all, 0.0);
        self.detect(shapes, bodies, &all, &pairs);
    }

    /// Detects all contacts of a new world, in which contacts hold what the scene presses them.
    pub fn detect_initial(&mut self, shapes: &Shapes, bodies: &mut Bodies) {
        self.detect_all(shapes, bodies);
        self.manifolds.iter_mut().for_each(|manifold| manifold.free_depth = 0.0);
    }

    /// Recomputes the gaps of a manifold after its bodies have moved; returns the deepest
    /// penetration, m.
    ///
    /// The loop integrates gaps to first order in the rotation, so the exact gap of a block that
    /// rolls is always smaller. That difference exerts no force, or each sync would add energy.
    pub fn update_gaps(shapes: &Shapes, bodies: &Bodies, manifold: &mut Manifold) -> f64 {
        let before: ArrayVec<f64, MAX_POINTS> = manifold.points.iter().map(|p| p.gap.min(0.0)).collect();
        set_gaps(shapes, bodies, manifold);
        // By the forces of the points: the springs then hold what they held before.
        let (mut work, mut force) = (0.0, 0.0);
        for (before, point) in before.into_iter().zip(&manifold.points).filter(|(_, point)| point.gap < 0.0) {
            let pressed = point.weight * (-point.gap - manifold.free_depth).max(0.0);
            work += pressed * (before - point.gap);
            force += pressed;
        }
        let deepest = manifold.deepest();
        // What rocks to and fro sinks and rises by the same, and gathers no free depth.
        let sunk = if force > 0.0 { work / force } else { 0.0 };
        if manifold.free_depth > 0.0 || sunk > MIN_SUNK_DEPTH * thickness(manifold, shapes) {
            // Bodies that move apart leave none behind.
            manifold.free_depth = (manifold.free_depth + sunk).clamp(0.0, deepest);
        }
        deepest
    }
}

/// Sets the gaps of a manifold from the poses. Its points follow B over the face of A, as far as
/// that reaches, and its levers turn with them.
fn set_gaps(shapes: &Shapes, bodies: &Bodies, manifold: &mut Manifold) {
    let (center_a, axes_a) = bodies.pose(manifold.a);
    let (center_b, axes_b) = bodies.affine(manifold.b);
    let [normal, tangents @ ..] = manifold.frame_in_world(bodies, axes_a);
    let axes_a = bodies.strained(manifold.a, axes_a);
    let half = shapes.half.get(manifold.a as usize).copied().unwrap_or(DVec3::INFINITY);
    let before = diagonal(manifold);
    for point in &mut manifold.points {
        let on_a = center_a + axes_a * point.anchor_a;
        let on_b = center_b + axes_b * point.anchor_b;
        let apart = on_b - on_a;
        point.gap = normal.dot(apart);
        if point.follows == [false; 2] {
            continue;
        }
        let mut to = point.anchor_a;
        for k in (0..2).filter(|&k| point.follows[k]) {
            to += manifold.frame[1 + k] * tangents[k].dot(apart);
        }
        point.move_on_a(to.clamp(-half, half), &manifold.frame, manifold.centroid);
    }
    if let (Some(before), Some(after)) = (before, diagonal(manifold)) {
        turn_levers(manifold, before, after);
    }
}

/// Vector between two opposite corners of a patch that is a face of B, along the tangents, m.
fn diagonal(manifold: &Manifold) -> Option<DVec2> {
    let [p, _, q, _] = manifold.points.as_slice() else { return None };
    let is_face = manifold.points.iter().all(|p| p.follows == [true; 2]);
    is_face.then(|| DVec2::from_array(q.arm) - DVec2::from_array(p.arm))
}

/// Turns the levers of a manifold as its diagonal has turned from `before` to `after` (m).
fn turn_levers(manifold: &mut Manifold, before: DVec2, after: DVec2) {
    let turn = DVec2::new(before.dot(after), before.perp_dot(after));
    if turn.length() > 0.0 {
        manifold.levers = manifold.levers.turned((turn / turn.length()).to_array());
    }
}

/// Limits the energy of a new manifold to that of the last one of its pair.
fn limit_energy(next: &mut Manifold, last: Option<&mut Manifold>, shapes: &Shapes, bodies: &Bodies) {
    // Strained blocks have other gaps than the boxes that detection takes them for.
    set_gaps(shapes, bodies, next);
    if next.deepest() == 0.0 {
        return;
    }
    let energy = last.map_or_else(SpringEnergy::default, |last| {
        Contacts::update_gaps(shapes, bodies, last);
        SpringEnergy::of(last, shapes, bodies)
    });
    energy.limit(next, shapes, bodies);
}

/// Returns true if a body has moved by [`MARGIN_SHARE`] of its margin since its last detection.
pub fn needs_detection(shapes: &Shapes, bodies: &Bodies, i: usize) -> bool {
    !bodies.asleep[i] && bodies.travel_since(shapes, i, bodies.detection_pose[i]) > MARGIN_SHARE * bodies.margin[i]
}

/// Box of a body in the world; that of the floor has no size.
pub fn cuboid(shapes: &Shapes, bodies: &Bodies, i: u32) -> Cuboid {
    let (center, axes) = bodies.pose(i);
    let mut cuboid = Cuboid { body: i, center, axes, ..Cuboid::default() };
    if i != FLOOR {
        let i = i as usize;
        (cuboid.half, cuboid.radius) = (bodies.half(shapes, i), shapes.edge_radius[i]);
        cuboid.rounded = shapes.rounded;
        (cuboid.velocity, cuboid.spin) = (bodies.velocity[i], bodies.spin[i]);
        cuboid.lookahead = BUDGET_CHECK_INTERVAL as f64 * shapes.spring.h;
        cuboid.softness = shapes.mass[i] / shapes.spring.stiffness;
    }
    cuboid
}

/// Tests a pair with a reach (m). Where it touches, `to` becomes its manifold, with the history of
/// `last`.
fn test_pair(
    shapes: &Shapes,
    bodies: &Bodies,
    [low, high]: [u32; 2],
    (reach, last): (f64, Option<&Manifold>),
    to: &mut Manifold,
) -> PairStatus {
    let (low_box, high_box) = (cuboid(shapes, bodies, low), cuboid(shapes, bodies, high));
    let status = if low == FLOOR {
        box_floor(&high_box, Range { limit: bodies.margin[high as usize], reach }, last.map(|m| m.axis), to)
    } else {
        let limit = bodies.margin[low as usize] + bodies.margin[high as usize];
        let last = last.map(|m| {
            let (axes, sign) = if m.a == low { (low_box.axes, 1.0) } else { (high_box.axes, -1.0) };
            LastAxis { axis: m.axis, normal: axes * m.frame[0] * sign }
        });
        box_box(&low_box, &high_box, Range { limit, reach }, last, to)
    };
    if !matches!(status, PairStatus::Touching(_)) {
        return status;
    }
    unstrain_anchors(to, shapes, bodies);
    let of = |i: u32| if i == low { &low_box } else { &high_box };
    if let Some(last) = last {
        let (r, last_r) = (of(to.a).axes, of(last.a).axes);
        to.inherit_history(last, |d| r * d, |d| last_r * d);
    }
    to.mobility = mobility(to, shapes, bodies, [of(to.a), of(to.b)]);
    status
}

/// Maps the anchors of a new manifold from the strained blocks to the unstrained ones.
fn unstrain_anchors(manifold: &mut Manifold, shapes: &Shapes, bodies: &Bodies) {
    let scale = |i: u32| bodies.stretch_of(i).map(|_| shapes.half[i as usize] / bodies.half(shapes, i as usize));
    if let Some(scale) = scale(manifold.a) {
        manifold.points.iter_mut().for_each(|p| p.anchor_a *= scale);
    }
    if let Some(scale) = scale(manifold.b) {
        manifold.points.iter_mut().for_each(|p| p.anchor_b *= scale);
    }
}

/// Inverse effective mass of the two bodies of a manifold at its patch, 1/kg; that of the floor and
/// of fixed bodies is zero.
fn mobility(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies, [a, b]: [&Cuboid; 2]) -> f64 {
    let centroid = a.center + a.axes * manifold.centroid;
    let of = |c: &Cuboid| {
        if c.body == FLOOR || bodies.fixed[c.body as usize] {
            return 0.0;
        }
        let i = c.body as usize;
        let arm = centroid - c.center;
        let inv_inertia = rotate_tensor(c.axes, shapes.inertia[i].recip());
        let rigid = manifold.rigid_mobility(shapes.mass[i], inv_inertia, arm, |d| a.axes * d);
        let Some(&half) = shapes.particles.get(i) else { return rigid };
        let inv_squares = rotate_tensor(c.axes, (half * half).recip());
        let affine = manifold.affine_mobility(shapes.mass[i], inv_squares, arm, |d| a.axes * d);
        rigid + (affine - rigid) / STRAIN_INERTIA
    };
    of(b) + of(a)
}
