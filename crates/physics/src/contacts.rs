//! The manifolds of a cluster, in the order of their keys, and their detection.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR, Shapes, tensor};
use crate::box_box::{Cuboid, Meeting, box_box, box_floor};
use crate::broad_phase::{Bound, Near, overlapping};
use crate::constants::{LEAST_NEAR, MARGIN_RANGE, MARGIN_SHARE, MARGIN_TIME};
use crate::lattice::STRAIN_INERTIA;
use crate::manifold::{Manifold, key};

/// Up to so many new manifolds are put in their places one by one; more are sorted in.
const FEW: usize = 8;

/// The manifolds of a cluster, sorted by [`Manifold::key`], and the bounds by which they are found.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Contacts {
    pub manifolds: Vec<Manifold>,
    /// Bounds of the bodies at their last detection, grown by their margins: each stays within its own until the next.
    pub bounds: Vec<Bound>,
    /// What each body sweeps in a frame and longer, see [`crate::regroup`]; holds its bounds.
    pub swept: Vec<Bound>,
    /// Bodies of which these overlap.
    #[serde(skip)]
    near: Near,
}

impl Contacts {
    /// Finds again who is near whom, after `swept` has changed.
    pub fn renew_near(&mut self) {
        self.near = Near::new(self.swept.len(), &overlapping(&self.swept));
    }

    /// Takes who is near whom from who has found it.
    pub fn set_near(&mut self, pairs: &[(u32, u32)]) {
        self.near = Near::new(self.swept.len(), pairs);
    }

    /// The manifold of a pair, which may well be where it was.
    pub fn find_at(&self, was: usize, (low, high): (u32, u32)) -> Option<usize> {
        let is = self.manifolds.get(was).is_some_and(|m| m.key() == key(low, high));
        if is { Some(was) } else { self.find((low, high)) }
    }

    /// The manifold of a pair.
    pub fn find(&self, (low, high): (u32, u32)) -> Option<usize> {
        self.manifolds.binary_search_by_key(&key(low, high), Manifold::key).ok()
    }

    /// Gives the bodies in `due` new margins and bounds where they are, and returns the pairs to look at: lower index first, or the
    /// floor. Bodies outgrow what they were expected to sweep when they are hit harder than any of them moved before; `reach` (m) is
    /// what they are then granted, and the second result says that it happened.
    pub fn candidates(
        &mut self,
        shapes: &Shapes,
        bodies: &mut Bodies,
        due: &[u32],
        reach: f64,
    ) -> (Vec<(u32, u32)>, bool) {
        let mut outgrown = false;
        for i in due.iter().map(|&i| i as usize) {
            bodies.margin[i] = (bodies.point_speed(shapes, i) * MARGIN_TIME).clamp(MARGIN_RANGE.0, MARGIN_RANGE.1);
            bodies.detected[i] = (bodies.position[i], bodies.orientation[i]);
            self.bounds[i] = Bound::new(shapes, bodies, i, bodies.margin[i]);
            if !self.swept[i].contains(&self.bounds[i]) {
                self.swept[i] = self.bounds[i].grown(reach);
                outgrown = true;
            }
        }
        if outgrown {
            self.renew_near();
        }
        let mut pairs = Vec::new();
        for &i in due {
            let bound = &self.bounds[i as usize];
            if bound.min.z <= 0.0 {
                pairs.push((FLOOR, i));
            }
            for &j in self.near.of(i as usize) {
                // a pair of two due bodies is seen from its lower one
                if (j > i || due.binary_search(&j).is_err()) && bound.overlaps(&self.bounds[j as usize]) {
                    pairs.push((i.min(j), i.max(j)));
                }
            }
        }
        (pairs, outgrown)
    }

    /// Looks at the pairs, which are all that bodies in `due` (sorted) can have. The history of a contact that stays goes over.
    pub fn detect(&mut self, shapes: &Shapes, bodies: &mut Bodies, due: &[u32], pairs: &[(u32, u32)]) {
        let mut found: Vec<Manifold> = Vec::new();
        let mut seen = vec![false; self.manifolds.len()];
        let mut next = Manifold::new();
        for &(low, high) in pairs {
            let place = self.find((low, high));
            let last = place.map(|i| &self.manifolds[i]);
            match (look(shapes, bodies, low, high, last, &mut next), place) {
                (Meeting::Apart, _) => {}
                (Meeting::Near(distance), _) => shorten(shapes, bodies, [low, high], distance),
                (Meeting::Touching, Some(i)) => {
                    seen[i] = true;
                    self.manifolds[i].copy(&next);
                }
                (Meeting::Touching, None) => found.push(next.clone()),
            }
        }
        // what was not seen again is no more
        let is_due = |i: u32| i != FLOOR && due.binary_search(&i).is_ok();
        let mut seen = seen.into_iter();
        self.manifolds.retain(|m| seen.next().unwrap_or(true) || !(is_due(m.a) || is_due(m.b)));
        if found.len() > FEW {
            self.manifolds.append(&mut found);
            self.manifolds.sort_by_key(Manifold::key);
        }
        for manifold in found {
            let key = manifold.key();
            let place = self.manifolds.partition_point(|m| m.key() < key);
            self.manifolds.insert(place, manifold);
        }
    }

    /// Detects everything anew.
    pub fn detect_all(&mut self, shapes: &Shapes, bodies: &mut Bodies) {
        let all: Vec<u32> = (0..bodies.len() as u32).collect();
        let (pairs, _) = self.candidates(shapes, bodies, &all, 0.0);
        self.detect(shapes, bodies, &all, &pairs);
    }

    /// Makes the gaps of a manifold exact again from the poses; returns the deepest overlap, m.
    pub fn measure(bodies: &Bodies, manifold: &mut Manifold) -> f64 {
        let (center_a, axes_a) = bodies.pose(manifold.a);
        let (center_b, axes_b) = bodies.affine(manifold.b);
        let normal = manifold.normal_in_world(bodies, axes_a);
        let axes_a = bodies.strained(manifold.a, axes_a);
        let mut deepest: f64 = 0.0;
        for point in &mut manifold.points {
            let on_a = center_a + axes_a * point.anchor_a;
            let on_b = center_b + axes_b * point.anchor_b;
            point.gap = normal.dot(on_b - on_a);
            deepest = deepest.max(-point.gap);
        }
        deepest
    }
}

/// Whether a body has moved by [`MARGIN_SHARE`] of its margin since its last detection.
pub fn due(shapes: &Shapes, bodies: &Bodies, i: usize) -> bool {
    !bodies.asleep[i] && bodies.travel(shapes, i, bodies.detected[i]) > MARGIN_SHARE * bodies.margin[i]
}

/// The box of a body; that of the floor has no size.
pub fn cuboid(shapes: &Shapes, bodies: &Bodies, i: u32) -> Cuboid {
    let (center, axes) = bodies.pose(i);
    let half = if i == FLOOR { DVec3::ZERO } else { bodies.half(shapes, i as usize) };
    Cuboid { body: i, center, axes, half }
}

/// How a pair is to each other; `to` becomes its manifold, with the history of the last one.
fn look(shapes: &Shapes, bodies: &Bodies, low: u32, high: u32, last: Option<&Manifold>, to: &mut Manifold) -> Meeting {
    let axis = last.map(|m| m.axis);
    let (low_box, high_box) = (cuboid(shapes, bodies, low), cuboid(shapes, bodies, high));
    let meeting = if low == FLOOR {
        box_floor(&high_box, bodies.margin[high as usize], axis, to)
    } else {
        let limit = bodies.margin[low as usize] + bodies.margin[high as usize];
        box_box(&low_box, &high_box, limit, axis, to)
    };
    if meeting != Meeting::Touching {
        return meeting;
    }
    unstrain(to, shapes, bodies);
    let of = |i: u32| if i == low { &low_box } else { &high_box };
    if let Some(last) = last {
        let (r, last_r) = (of(to.a).axes, of(last.a).axes);
        to.inherit(last, |d| r * d, |d| last_r * d);
    }
    to.mobility = mobility(to, shapes, of(to.a), of(to.b));
    meeting
}

/// Makes the anchors of a new manifold places in blocks that are not strained.
fn unstrain(manifold: &mut Manifold, shapes: &Shapes, bodies: &Bodies) {
    let scale = |i: u32| bodies.stretch_of(i).map(|_| shapes.half[i as usize] / bodies.half(shapes, i as usize));
    if let Some(scale) = scale(manifold.a) {
        manifold.points.iter_mut().for_each(|p| p.anchor_a *= scale);
    }
    if let Some(scale) = scale(manifold.b) {
        manifold.points.iter_mut().for_each(|p| p.anchor_b *= scale);
    }
}

/// Takes care that two bodies which are near but have no manifold are looked at again before they have closed `distance` (m):
/// otherwise a block that comes in past an edge would be found only when it is inside by a whole margin.
fn shorten(shapes: &Shapes, bodies: &mut Bodies, pair: [u32; 2], distance: f64) {
    for i in pair.map(|i| i as usize) {
        let gone = bodies.travel(shapes, i, bodies.detected[i]);
        bodies.margin[i] = bodies.margin[i].min(gone + (0.5 * distance).max(LEAST_NEAR));
    }
}

/// How easily the two bodies of a manifold give way at its patch, 1/kg; the floor does not.
fn mobility(manifold: &Manifold, shapes: &Shapes, a: &Cuboid, b: &Cuboid) -> f64 {
    let centroid = a.center + a.axes * manifold.centroid;
    let of = |c: &Cuboid| {
        let i = c.body as usize;
        let arm = centroid - c.center;
        let inertia = tensor(c.axes, shapes.inertia[i].recip());
        let rigid = manifold.mobility_of(shapes.mass[i], inertia, arm, |d| a.axes * d);
        let Some(&half) = shapes.particles.get(i) else { return rigid };
        let levers = tensor(c.axes, (half * half).recip());
        let affine = manifold.affine_mobility_of(shapes.mass[i], levers, arm, |d| a.axes * d);
        rigid + (affine - rigid) / STRAIN_INERTIA
    };
    of(b) + if manifold.a == FLOOR { 0.0 } else { of(a) }
}
