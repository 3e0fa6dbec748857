//! The manifolds of a world, in the order of their keys, and their detection.

use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR, Shapes};
use crate::box_box::{Cuboid, Meeting, box_box, box_floor};
use crate::broad_phase::{Bound, overlapping};
use crate::constants::{LEAST_NEAR, MARGIN_RANGE, MARGIN_SHARE, MARGIN_TIME};
use crate::manifold::{Manifold, key};

/// The manifolds of a world, sorted by [`Manifold::key`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Contacts {
    pub manifolds: Vec<Manifold>,
    /// Bounds of the bodies at their last detection: each stays within its own until the next.
    bounds: Vec<Bound>,
}

impl Contacts {
    /// No contacts yet of `n` bodies.
    pub fn new(n: usize) -> Self {
        Self { manifolds: Vec::new(), bounds: vec![Bound::default(); n] }
    }

    /// Detects anew the contacts of the bodies in `due`, which have moved by a share of their margins; returns the number of pairs
    /// looked at. The history of a contact that stays goes over.
    pub fn detect(&mut self, shapes: &Shapes, bodies: &mut Bodies, due: &[u32]) -> u32 {
        let mut is_due = vec![false; bodies.len()];
        for &i in due {
            is_due[i as usize] = true;
        }
        for i in due.iter().map(|&i| i as usize) {
            bodies.margin[i] = (bodies.point_speed(shapes, i) * MARGIN_TIME).clamp(MARGIN_RANGE.0, MARGIN_RANGE.1);
            bodies.detected[i] = (bodies.position[i], bodies.orientation[i]);
            self.bounds[i] = Bound::new(shapes, bodies, i);
        }
        let pairs = overlapping(&self.bounds, due, &is_due);
        let mut found: Vec<Manifold> = Vec::new();
        let mut seen = vec![false; self.manifolds.len()];
        for &(low, high) in &pairs {
            let place = self.manifolds.binary_search_by_key(&key(low, high), Manifold::key);
            let last = place.ok().map(|i| &self.manifolds[i]);
            let manifold = match look(shapes, bodies, low, high, last) {
                Meeting::Touching(manifold) => manifold,
                Meeting::Apart => continue,
                Meeting::Near(distance) => {
                    shorten(shapes, bodies, [low, high], distance);
                    continue;
                }
            };
            match place {
                Ok(i) => {
                    seen[i] = true;
                    self.manifolds[i] = manifold;
                }
                Err(_) => found.push(manifold),
            }
        }
        // what was not seen again is no more
        let is_due = |i: u32| i != FLOOR && is_due[i as usize];
        let mut seen = seen.into_iter();
        self.manifolds.retain(|m| seen.next().unwrap_or(true) || !(is_due(m.a) || is_due(m.b)));
        if !found.is_empty() {
            self.manifolds.extend(found);
            self.manifolds.sort_by_key(Manifold::key);
        }
        pairs.len() as u32
    }

    /// Makes the gaps exact again from the poses.
    pub fn measure(&mut self, bodies: &Bodies) {
        for manifold in &mut self.manifolds {
            let (center_a, axes_a) = bodies.pose(manifold.a);
            let (center_b, axes_b) = bodies.pose(manifold.b);
            let normal = axes_a * manifold.frame[0];
            for point in &mut manifold.points {
                let on_a = center_a + axes_a * point.anchor_a;
                let on_b = center_b + axes_b * point.anchor_b;
                point.gap = normal.dot(on_b - on_a);
            }
        }
    }
}

/// The bodies that have moved by [`MARGIN_SHARE`] of their margins since their last detection.
pub fn due(shapes: &Shapes, bodies: &Bodies) -> Vec<u32> {
    (0..bodies.len())
        .filter(|&i| !bodies.asleep[i] && bodies.travel(shapes, i, bodies.detected[i]) > MARGIN_SHARE * bodies.margin[i])
        .map(|i| i as u32)
        .collect()
}

/// The box of a body.
pub fn cuboid(shapes: &Shapes, bodies: &Bodies, i: u32) -> Cuboid {
    let (center, axes) = bodies.pose(i);
    Cuboid { body: i, center, axes, half: shapes.half[i as usize] }
}

/// How a pair is to each other; a manifold has the history of the last one.
fn look(shapes: &Shapes, bodies: &Bodies, low: u32, high: u32, last: Option<&Manifold>) -> Meeting {
    let axis = last.map(|m| m.axis);
    let high_box = cuboid(shapes, bodies, high);
    let meeting = if low == FLOOR {
        box_floor(&high_box, bodies.margin[high as usize], axis).map_or(Meeting::Apart, Meeting::Touching)
    } else {
        let limit = bodies.margin[low as usize] + bodies.margin[high as usize];
        box_box(&cuboid(shapes, bodies, low), &high_box, limit, axis)
    };
    let Meeting::Touching(mut manifold) = meeting else { return meeting };
    if let Some(last) = last {
        let (_, r) = bodies.pose(manifold.a);
        let (_, last_r) = bodies.pose(last.a);
        manifold.inherit(last, |d| r * d, |d| last_r * d);
    }
    manifold.mobility = mobility(&manifold, shapes, bodies);
    Meeting::Touching(manifold)
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
fn mobility(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> f64 {
    let (center, axes) = bodies.pose(manifold.a);
    let centroid = center + axes * manifold.centroid;
    let of = |i: u32| {
        let i = i as usize;
        let arm = centroid - bodies.position[i];
        manifold.mobility_of(shapes.mass[i], bodies.inv_inertia(shapes, i), arm, |d| axes * d)
    };
    of(manifold.b) + if manifold.a == FLOOR { 0.0 } else { of(manifold.a) }
}
