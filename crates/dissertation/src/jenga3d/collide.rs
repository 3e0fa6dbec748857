//! `CollideBlocks`: every pair of blocks, every point with every face and every edge with every edge (section 5.4, Figure 5.5).

use serde::{Deserialize, Serialize};

use super::block::{CORNERS, EDGE_CORNERS, FACE_CORNERS};
use super::bounds::{Bounds, BoundsOf};
use super::boxes::BlockBoxes;
use super::constants::Constants;
use super::contact::{Contact, Kind};
use super::counters::{Counters, StepCounts, TESTS_OF_PAIR};
use super::edge_edge;
use super::model::Model;
use super::particle::State;
use super::point_face::{self, Way};
use super::response::respond;

/// Order in which pairs are looked at (section 3.3.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// In order of creation.
    Naive,
    /// The lowest blocks first.
    BottomUp,
    /// The highest blocks first.
    TopDown,
}

/// Which tests come before the exact one; each level includes those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Culling {
    /// None: the roots of every cubic are looked for.
    None,
    /// Boxes of blocks.
    Blocks,
    /// Boxes of faces, edges and particles.
    Boxes,
    /// Whether a point can pass the plane of a face, or a line another line.
    Planes,
}

/// What pairs of blocks need while they collide.
#[derive(Debug, Clone, Default)]
pub struct Collider {
    /// Boxes of every block,
    blocks: Vec<Bounds>,
    /// and of its parts.
    boxes: Vec<BlockBoxes>,
    /// Pairs of blocks, the first before the second, in the order in which they are looked at.
    pairs: Vec<[u32; 2]>,
    /// For every pair, the event up to which it has been looked at.
    seen: Vec<u32>,
    /// For every block, the event at which it changed last,
    changed: Vec<u32>,
    /// and each of its corners.
    corner_changed: Vec<[u32; CORNERS]>,
    /// Counts changes.
    event: u32,
}

impl Collider {
    /// Begins a step: boxes around all ways, and no pair looked at yet.
    pub fn begin(&mut self, model: &Model, constants: &Constants, curr: &[State], next: &[State]) {
        self.boxes.clear();
        self.boxes.extend(model.blocks.iter().map(|b| BlockBoxes::new(&curr[b.corners()], &next[b.corners()])));
        self.blocks.clear();
        self.blocks.extend(self.boxes.iter().map(BlockBoxes::block));
        let n = model.blocks.len() as u32;
        let pair_count = (n as usize * (n as usize).saturating_sub(1)) / 2;
        if self.pairs.len() != pair_count || constants.order != Order::Naive {
            self.pairs.clear();
            let mut ranked: Vec<u32> = (0..n).collect();
            let height = |b: u32| model.blocks[b as usize].centre(curr).z;
            match constants.order {
                Order::Naive => {}
                Order::BottomUp => ranked.sort_by(|&a, &b| height(a).total_cmp(&height(b))),
                Order::TopDown => ranked.sort_by(|&a, &b| height(b).total_cmp(&height(a))),
            }
            self.pairs.extend((0..ranked.len()).flat_map(|i| {
                let (a, above) = (ranked[i], &ranked[i + 1..]);
                above.iter().map(move |&b| [a, b])
            }));
        }
        self.event = 1;
        self.seen.clear();
        self.seen.resize(self.pairs.len(), 0);
        self.changed.clear();
        self.changed.resize(n as usize, 1);
        self.corner_changed.clear();
        self.corner_changed.resize(n as usize, [1; CORNERS]);
    }

    /// Tells that the next states of a block have been changed from outside.
    pub fn touch(&mut self, block: usize, curr: &[State], next: &[State]) {
        self.boxes[block] = BlockBoxes::new(curr, next);
        self.blocks[block] = self.boxes[block].block();
        self.event += 1;
        self.changed[block] = self.event;
        self.corner_changed[block] = [self.event; CORNERS];
    }

    /// Looks at all pairs, round after round until a round finds no collision, and appends the contacts.
    pub fn collide(&mut self, field: &mut Field, counts: &mut StepCounts) {
        let most = field.constants.max_sweeps;
        for sweep in 1..=most {
            let before = counts.all;
            self.sweep(field, &mut counts.all);
            if sweep == 1 {
                let mut first = counts.all;
                first.potential -= before.potential;
                first.after_blocks -= before.after_blocks;
                first.after_boxes -= before.after_boxes;
                first.after_planes -= before.after_planes;
                first.collisions -= before.collisions;
                counts.first += first;
            }
            counts.sweeps = counts.sweeps.max(sweep);
            if counts.all.collisions == before.collisions {
                return;
            }
        }
        counts.unresolved += 1;
    }

    fn sweep(&mut self, field: &mut Field, counters: &mut Counters) {
        let culling = field.constants.culling;
        for n in 0..self.pairs.len() {
            let [a, b] = self.pairs[n].map(|b| b as usize);
            let mut since = 0;
            if field.constants.skip_unchanged {
                since = self.seen[n];
                if self.changed[a].max(self.changed[b]) <= since {
                    continue;
                }
                self.seen[n] = self.event;
            }
            if !field.model.blocks[a].active && !field.model.blocks[b].active {
                continue;
            }
            counters.potential += TESTS_OF_PAIR;
            if culling >= Culling::Blocks && !self.blocks[a].meets(&self.blocks[b]) {
                continue;
            }
            counters.after_blocks += TESTS_OF_PAIR;
            self.points_and_faces(a, b, since, !field.constants.listed_boxes, field, counters);
            self.points_and_faces(b, a, since, true, field, counters);
            self.edges(a, b, since, field, counters);
        }
    }

    /// The corners of block `p` with the faces of block `f`, where either has changed since that event. Without `corner_boxes` the boxes of
    /// corners are not looked at.
    fn points_and_faces(
        &mut self,
        p: usize,
        f: usize,
        since: u32,
        corner_boxes: bool,
        field: &mut Field,
        counters: &mut Counters,
    ) {
        let culling = field.constants.culling;
        let of_corners = if corner_boxes { culling } else { culling.min(Culling::Blocks) };
        let first = field.model.blocks[p].particles as usize;
        let first_of_face = field.model.blocks[f].particles as usize;
        let mut faces = self.meeting(|b| &b.faces, f, p, culling);
        let (mut all_corners, mut event) = (self.meeting(|b| &b.corners, p, f, of_corners), self.event);
        while let Some(n) = take(&mut faces) {
            let face = FACE_CORNERS[n].map(|c| first_of_face + c);
            let old_face = self.unchanged(f, FACE_CORNERS[n], since);
            if self.event != event {
                // A collision may have widened the boxes.
                (all_corners, event) = (self.meeting(|b| &b.corners, p, f, of_corners), self.event);
            }
            let mut corners = all_corners;
            while let Some(corner) = take(&mut corners) {
                if old_face && self.unchanged(p, [corner], since) {
                    continue;
                }
                if of_corners >= Culling::Boxes && !self.boxes[f].faces.get(n).meets(&self.boxes[p].corners.get(corner))
                {
                    continue;
                }
                counters.after_boxes += 1;
                let particle = first + corner;
                let (point, ways) = (field.way(particle), face.map(|i| field.way(i)));
                let distance = point_face::distance(&point, &ways);
                if culling >= Culling::Planes && !distance.may_vanish() {
                    continue;
                }
                counters.after_planes += 1;
                let Some(hit) = point_face::first_hit(&distance, &point, &ways, field.constants.tolerance) else {
                    continue;
                };
                counters.collisions += 1;
                let [w1, w2, w3] = hit.weights;
                let index = field.model.blocks[f].faces + n as u32;
                self.respond(
                    field,
                    Contact {
                        kind: Kind::ParticleFace(particle as u32, index),
                        blocks: [p as u32, f as u32],
                        particles: [particle as u32, face[0] as u32, face[1] as u32, face[2] as u32],
                        weights: [1.0, -w1, -w2, -w3],
                        normal: hit.normal,
                        normal_force: 0.0,
                    },
                );
            }
        }
    }

    /// The edges of block `a` with those of block `b`, where either has changed since that event.
    fn edges(&mut self, a: usize, b: usize, since: u32, field: &mut Field, counters: &mut Counters) {
        let culling = field.constants.culling;
        let (first_a, first_b) = (field.model.blocks[a].particles as usize, field.model.blocks[b].particles as usize);
        let mut edges_a = self.meeting(|b| &b.edges, a, b, culling);
        let (mut all_edges_b, mut event) = (self.meeting(|b| &b.edges, b, a, culling), self.event);
        while let Some(n) = take(&mut edges_a) {
            let edge_a = EDGE_CORNERS[n].map(|c| first_a + c);
            let old_edge = self.unchanged(a, EDGE_CORNERS[n], since);
            if self.event != event {
                (all_edges_b, event) = (self.meeting(|b| &b.edges, b, a, culling), self.event);
            }
            let mut edges_b = all_edges_b;
            while let Some(m) = take(&mut edges_b) {
                if old_edge && self.unchanged(b, EDGE_CORNERS[m], since) {
                    continue;
                }
                if culling >= Culling::Boxes && !self.boxes[a].edges.get(n).meets(&self.boxes[b].edges.get(m)) {
                    continue;
                }
                counters.after_boxes += 1;
                let edge_b = EDGE_CORNERS[m].map(|c| first_b + c);
                let (ways_a, ways_b) = (edge_a.map(|i| field.way(i)), edge_b.map(|i| field.way(i)));
                let distance = edge_edge::distance(&ways_a, &ways_b);
                if culling >= Culling::Planes && !distance.may_vanish() {
                    continue;
                }
                counters.after_planes += 1;
                let Some(hit) = edge_edge::first_hit(&distance, &ways_a, &ways_b, field.constants.tolerance) else {
                    continue;
                };
                counters.collisions += 1;
                let springs = [field.model.blocks[a].springs + n as u32, field.model.blocks[b].springs + m as u32];
                self.respond(
                    field,
                    Contact {
                        kind: Kind::EdgeEdge(springs[0], springs[1]),
                        blocks: [b as u32, a as u32],
                        particles: [edge_b[0] as u32, edge_b[1] as u32, edge_a[0] as u32, edge_a[1] as u32],
                        weights: [1.0 - hit.mu_2, hit.mu_2, hit.mu_1 - 1.0, -hit.mu_1],
                        normal: hit.normal,
                        normal_force: 0.0,
                    },
                );
            }
        }
    }

    /// Whether some corners of a block are as they were at an event.
    #[inline]
    fn unchanged<const N: usize>(&self, block: usize, corners: [usize; N], since: u32) -> bool {
        corners.iter().all(|&c| self.corner_changed[block][c] <= since)
    }

    /// Which parts of a block meet the box of another block, as bits; all where boxes are not looked at.
    #[inline]
    fn meeting<const N: usize>(
        &self,
        parts: impl Fn(&BlockBoxes) -> &BoundsOf<N>,
        of: usize,
        with: usize,
        culling: Culling,
    ) -> u16 {
        if culling < Culling::Boxes {
            return (1 << N) - 1;
        }
        parts(&self.boxes[of]).meeting(&self.blocks[with])
    }

    fn respond(&mut self, field: &mut Field, contact: Contact) {
        field.respond(contact);
        self.event += 1;
        for (p, _) in contact.parts() {
            let block = field.model.particles[p].block as usize;
            let corner = p - field.model.blocks[block].particles as usize;
            self.boxes[block].renew_corner(corner, &field.curr[p], &field.next[p]);
            self.blocks[block] = self.boxes[block].block();
            self.changed[block] = self.event;
            self.corner_changed[block][corner] = self.event;
        }
    }
}

/// The lowest of some bits, which it clears.
#[inline]
fn take(bits: &mut u16) -> Option<usize> {
    let lowest = (*bits != 0).then(|| bits.trailing_zeros() as usize);
    *bits &= bits.wrapping_sub(1);
    lowest
}

/// What collisions read and change.
#[derive(Debug)]
pub struct Field<'a> {
    /// The lists; collisions enable blocks.
    pub model: &'a mut Model,
    /// The constants.
    pub constants: &'a Constants,
    /// The last valid states.
    pub curr: &'a [State],
    /// The states that are made valid.
    pub next: &'a mut [State],
    /// Where contacts are noted for the friction of the next step.
    pub contacts: &'a mut Vec<Contact>,
}

impl Field<'_> {
    #[inline]
    fn way(&self, particle: usize) -> Way {
        Way::between(self.curr[particle].position, self.next[particle].position)
    }

    /// Resolves a contact. One of a disabled block that is strong enough enables it first (section 4.7).
    pub fn respond(&mut self, contact: Contact) {
        let mut contact = contact;
        for block in contact.blocks {
            let disabled = self.model.blocks.get(block as usize).is_some_and(|b| !b.active);
            if disabled && self.impulse_if_free(&contact) > self.constants.reactivation_impulse {
                self.model.blocks[block as usize].active = true;
            }
        }
        let blocks = &self.model.blocks;
        let moves = |block: u32| blocks[block as usize].active;
        let impulse = respond(&contact, &self.constants.law(), &self.model.particles, self.curr, self.next, moves);
        contact.normal_force = impulse / self.constants.step();
        self.contacts.push(contact);
    }

    /// The impulse that a contact would have if no block were fixed, N s.
    fn impulse_if_free(&self, contact: &Contact) -> f64 {
        let approach = contact.velocity(self.next).dot(contact.normal);
        -(1.0 + self.constants.restitution) * approach.min(0.0) / contact.inverse_mass(&self.model.particles, |_| true)
    }
}
