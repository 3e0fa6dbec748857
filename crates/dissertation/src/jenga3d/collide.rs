//! `CollideBlocks`: every pair of blocks, every point with every face and every edge with every
//! edge (section 5.4, Figure 5.5).

use super::block::{EDGE_CORNERS, FACE_CORNERS};
use super::bounds::{Bounds, BoundsArray};
use super::boxes::BlockBoxes;
use super::changes::Changes;
use super::constants::Constants;
use super::contact::{Contact, Kind};
use super::counters::{Counters, StepCounts, TESTS_OF_PAIR};
use super::edge_edge::{self, EdgeEdgeHit};
use super::field::Field;
use super::model::Model;
use super::options::Culling;
use super::pairs::Pairs;
use super::particle::State;
use super::point_face::{self, PointFaceHit};

/// Collision detection between blocks, with the boxes and events of the step.
#[derive(Debug, Clone, Default)]
pub struct Collider {
    /// Box of every block.
    blocks: Vec<Bounds>,
    /// Boxes of the parts of every block.
    boxes: Vec<BlockBoxes>,
    pairs: Pairs,
    changes: Changes,
}

/// Two blocks under test, and the event up to which they were tested.
#[derive(Debug, Clone, Copy)]
struct Pair {
    a: usize,
    b: usize,
    since: u32,
    /// Culling of the corners of `a`.
    corners: Culling,
}

impl Collider {
    /// Starts a step: computes the boxes of all paths and marks every pair as untested.
    pub fn begin(&mut self, model: &Model, constants: &Constants, curr: &[State], next: &[State]) {
        self.boxes.clear();
        self.boxes.extend(model.blocks.iter().map(|b| BlockBoxes::new(&curr[b.corners()], &next[b.corners()])));
        self.blocks.clear();
        self.blocks.extend(self.boxes.iter().map(BlockBoxes::block));
        self.pairs.reset(model, constants.order, curr);
        self.changes.reset(model.blocks.len());
    }

    /// Updates a block whose next states were changed elsewhere.
    pub fn update_block(&mut self, block: usize, curr: &[State], next: &[State]) {
        self.boxes[block] = BlockBoxes::new(curr, next);
        self.blocks[block] = self.boxes[block].block();
        self.changes.advance();
        self.changes.mark_block(block);
    }

    /// Tests all pairs in rounds until one finds no collision, and appends the contacts.
    pub fn collide(&mut self, field: &mut Field, counts: &mut StepCounts) {
        for sweep in 1..=field.constants.max_sweeps {
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
                counts.rounds.add_call(sweep, true);
                return;
            }
        }
        counts.rounds.add_call(field.constants.max_sweeps, false);
        counts.unresolved += 1;
        counts.rounds.unresolved_steps = 1;
    }

    fn sweep(&mut self, field: &mut Field, counters: &mut Counters) {
        let culling = field.constants.culling;
        for n in 0..self.pairs.len() {
            let [a, b] = self.pairs.blocks(n);
            let mut since = 0;
            if field.constants.skip_unchanged {
                since = self.pairs.tested(n);
                if self.changes.pair_unchanged(a, b, since) {
                    continue;
                }
                self.pairs.set_tested(n, self.changes.event());
            }
            if !field.model.blocks[a].active && !field.model.blocks[b].active {
                continue;
            }
            counters.potential += TESTS_OF_PAIR;
            if culling >= Culling::Blocks && !self.blocks[a].overlaps(&self.blocks[b]) {
                continue;
            }
            counters.after_blocks += TESTS_OF_PAIR;
            let listed = if field.constants.listed_boxes { culling.min(Culling::Blocks) } else { culling };
            self.points_and_faces(Pair { a, b, since, corners: listed }, field, counters);
            self.points_and_faces(Pair { a: b, b: a, since, corners: culling }, field, counters);
            self.edges(Pair { a, b, since, corners: culling }, field, counters);
        }
    }

    /// Tests the corners of block `a` with the faces of block `b`, where either has changed.
    fn points_and_faces(&mut self, pair: Pair, field: &mut Field, counters: &mut Counters) {
        let Pair { a, b, since, corners: corner_culling } = pair;
        let [first_a, first_b] = [a, b].map(|block| field.model.blocks[block].particles as usize);
        let mut faces = self.overlapping(|parts| &parts.faces, b, a, field.constants.culling);
        let overlapping_corners = |it: &Self| it.overlapping(|parts| &parts.corners, a, b, corner_culling);
        let (mut all_corners, mut event) = (overlapping_corners(self), self.changes.event());
        while let Some(n) = pop_lowest(&mut faces) {
            let face = FACE_CORNERS[n].map(|c| first_b + c);
            let face_unchanged = self.changes.corners_unchanged(b, FACE_CORNERS[n], since);
            if self.changes.event() != event {
                // A collision may have enlarged the boxes.
                (all_corners, event) = (overlapping_corners(self), self.changes.event());
            }
            let mut corners = all_corners;
            while let Some(corner) = pop_lowest(&mut corners) {
                if face_unchanged && self.changes.corners_unchanged(a, [corner], since) {
                    continue;
                }
                let face_box = self.boxes[b].faces.get(n);
                if corner_culling >= Culling::Boxes && !face_box.overlaps(&self.boxes[a].corners.get(corner)) {
                    continue;
                }
                let particle = first_a + corner;
                if let Some(hit) = test_point_face(particle, face, field, counters) {
                    let [w1, w2, w3] = hit.weights;
                    let contact = Contact {
                        kind: Kind::ParticleFace(particle as u32, field.model.blocks[b].faces + n as u32),
                        blocks: [a as u32, b as u32],
                        particles: [particle as u32, face[0] as u32, face[1] as u32, face[2] as u32],
                        weights: [1.0, -w1, -w2, -w3],
                        normal: hit.normal,
                        normal_force: 0.0,
                    };
                    self.respond(field, contact);
                }
            }
        }
    }

    /// Tests the edges of block `a` with those of block `b`, where either has changed.
    fn edges(&mut self, pair: Pair, field: &mut Field, counters: &mut Counters) {
        let Pair { a, b, since, .. } = pair;
        let culling = field.constants.culling;
        let [first_a, first_b] = [a, b].map(|block| field.model.blocks[block].particles as usize);
        let mut edges_a = self.overlapping(|parts| &parts.edges, a, b, culling);
        let overlapping_edges = |it: &Self| it.overlapping(|parts| &parts.edges, b, a, culling);
        let (mut all_edges_b, mut event) = (overlapping_edges(self), self.changes.event());
        while let Some(n) = pop_lowest(&mut edges_a) {
            let edge_a = EDGE_CORNERS[n].map(|c| first_a + c);
            let edge_unchanged = self.changes.corners_unchanged(a, EDGE_CORNERS[n], since);
            if self.changes.event() != event {
                (all_edges_b, event) = (overlapping_edges(self), self.changes.event());
            }
            let mut edges_b = all_edges_b;
            while let Some(m) = pop_lowest(&mut edges_b) {
                if edge_unchanged && self.changes.corners_unchanged(b, EDGE_CORNERS[m], since) {
                    continue;
                }
                let edge_box = self.boxes[a].edges.get(n);
                if culling >= Culling::Boxes && !edge_box.overlaps(&self.boxes[b].edges.get(m)) {
                    continue;
                }
                let edge_b = EDGE_CORNERS[m].map(|c| first_b + c);
                if let Some(hit) = test_edges(edge_a, edge_b, field, counters) {
                    let [spring_a, spring_b] = [(a, n), (b, m)].map(|(k, e)| field.model.blocks[k].springs + e as u32);
                    let contact = Contact {
                        kind: Kind::EdgeEdge(spring_a, spring_b),
                        blocks: [b as u32, a as u32],
                        particles: [edge_b[0] as u32, edge_b[1] as u32, edge_a[0] as u32, edge_a[1] as u32],
                        weights: [1.0 - hit.mu_2, hit.mu_2, hit.mu_1 - 1.0, -hit.mu_1],
                        normal: hit.normal,
                        normal_force: 0.0,
                    };
                    self.respond(field, contact);
                }
            }
        }
    }

    /// Returns a mask of the parts of block `of` that overlap the box of block `with`; all of them
    /// where culling stops before the boxes of parts.
    #[inline]
    fn overlapping<const N: usize>(
        &self,
        parts: impl Fn(&BlockBoxes) -> &BoundsArray<N>,
        of: usize,
        with: usize,
        culling: Culling,
    ) -> u16 {
        if culling < Culling::Boxes {
            return (1 << N) - 1;
        }
        parts(&self.boxes[of]).overlapping(&self.blocks[with])
    }

    /// Resolves a contact and updates the boxes of its particles.
    fn respond(&mut self, field: &mut Field, contact: Contact) {
        field.respond(contact);
        self.changes.advance();
        for (p, _) in contact.parts() {
            let block = field.model.particles[p].block as usize;
            let corner = p - field.model.blocks[block].particles as usize;
            self.boxes[block].update_corner(corner, &field.curr[p], &field.next[p]);
            self.blocks[block] = self.boxes[block].block();
            self.changes.mark_corner(block, corner);
        }
    }
}

/// Tests a particle against a face: planes first, then the roots of the cubic.
fn test_point_face(particle: usize, face: [usize; 3], field: &Field, counters: &mut Counters) -> Option<PointFaceHit> {
    counters.after_boxes += 1;
    let (point, corners) = (field.path(particle), face.map(|i| field.path(i)));
    let distance = point_face::distance(&point, &corners);
    if field.constants.culling >= Culling::Planes && !distance.may_have_root() {
        return None;
    }
    counters.after_planes += 1;
    let hit = point_face::first_hit(&distance, &point, &corners, field.constants.tolerance)?;
    counters.collisions += 1;
    Some(hit)
}

/// Tests two edges: lines first, then the roots of the cubic.
fn test_edges(edge_a: [usize; 2], edge_b: [usize; 2], field: &Field, counters: &mut Counters) -> Option<EdgeEdgeHit> {
    counters.after_boxes += 1;
    let (ends_a, ends_b) = (edge_a.map(|i| field.path(i)), edge_b.map(|i| field.path(i)));
    let distance = edge_edge::distance(&ends_a, &ends_b);
    if field.constants.culling >= Culling::Planes && !distance.may_have_root() {
        return None;
    }
    counters.after_planes += 1;
    let hit = edge_edge::first_hit(&distance, &ends_a, &ends_b, field.constants.tolerance)?;
    counters.collisions += 1;
    Some(hit)
}

/// Removes and returns the lowest bit of a mask.
#[inline]
fn pop_lowest(mask: &mut u16) -> Option<usize> {
    let lowest = (*mask != 0).then(|| mask.trailing_zeros() as usize);
    *mask &= mask.wrapping_sub(1);
    lowest
}
