//! `CollideBlocks`: every pair of blocks, every point with every face and every edge with every
//! edge (section 5.4, Figure 5.5).

use super::block::CORNERS;
use super::bounds::Bounds;
use super::boxes::{self, CornerBoxes};
use super::changes::Changes;
use super::constants::Constants;
use super::contact::Contact;
use super::counters::{Counters, StepCounts, TESTS_OF_PAIR};
use super::field::Field;
use super::model::Model;
use super::near::{NearPair, NearPairs, Row, RowKind};
use super::options::Culling;
use super::part_pair::{EdgeEdge, FaceCorner, OUTER_PARTS, PartPair};
use super::particle::State;
use super::path::Path;

/// Collision detection between blocks, with the boxes and events of the step.
#[derive(Debug, Clone, Default)]
pub struct Collider {
    /// Box of every block.
    blocks: Vec<Bounds>,
    /// Boxes of the corners of every block.
    boxes: Vec<CornerBoxes>,
    /// Paths of the corners of every block.
    paths: Vec<[Path; CORNERS]>,
    near: NearPairs,
    changes: Changes,
    /// Event at which the previous round began.
    previous_round: u32,
}

/// Pass over one kind of parts of a pair of blocks.
#[derive(Debug, Clone, Copy)]
struct Pass {
    pair: NearPair,
    /// Version of the list of pairs from which the pair is.
    version: u32,
    kind: RowKind,
    /// Blocks of the outer and of the inner loop.
    blocks: [usize; 2],
    /// Culling of the inner parts.
    inner: Culling,
}

/// Parts that a pass tests: as in Figure 5.5, the outer ones overlap the other block at its start,
/// the inner ones at the start of their loop.
#[derive(Debug, Clone, Copy)]
struct Parts {
    outer: u16,
    inner: u16,
    /// Event up to which `inner` holds.
    event: u32,
}

impl Collider {
    /// Starts a step: computes the boxes of all paths and marks every pair as untested.
    pub fn begin(&mut self, model: &Model, constants: &Constants, curr: &[State], next: &[State]) {
        self.boxes.resize(model.blocks.len(), [Bounds::ALL; CORNERS]);
        self.paths.clear();
        self.blocks.clear();
        for (corners, block) in self.boxes.iter_mut().zip(&model.blocks) {
            let (curr, next) = (&curr[block.corners()], &next[block.corners()]);
            boxes::update(corners, 0xff, curr, next);
            self.paths.push(paths(curr, next));
            self.blocks.push(boxes::of_block(corners));
        }
        self.near.begin(&self.boxes, constants, |block| model.blocks[block].centre(curr).z);
        self.changes.reset(model.blocks.len());
        self.previous_round = 0;
    }

    /// Updates a block whose next states were changed elsewhere.
    pub fn update_block(&mut self, block: usize, curr: &[State], next: &[State]) {
        self.changes.advance();
        self.update_corners(block, 0xff, curr, next);
    }

    /// Tests all pairs in rounds until one finds no collision, and appends the contacts.
    pub fn collide(&mut self, field: &mut Field, counts: &mut StepCounts) {
        for sweep in 1..=field.constants.max_sweeps {
            let before = counts.all;
            self.sweep(field, &mut counts.all);
            if sweep == 1 {
                counts.first += counts.all.since(&before);
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
        counters.potential += TESTS_OF_PAIR * self.count_pairs(field);
        self.previous_round = self.changes.event();
        let mut n = 0;
        while n < self.near.len() {
            let pair = self.near.pair(n);
            let [a, b] = pair.blocks.map(|block| block as usize);
            n += 1;
            let mut since = 0;
            if field.constants.skip_unchanged {
                since = pair.tested;
                if !self.changes.changed(a, since) && !self.changes.changed(b, since) {
                    continue;
                }
                self.near.set_tested(n - 1, self.changes.event());
            }
            if !field.model.blocks[a].active && !field.model.blocks[b].active {
                continue;
            }
            counters.near += TESTS_OF_PAIR;
            if culling >= Culling::Blocks && !self.blocks[a].overlaps(&self.blocks[b]) {
                continue;
            }
            counters.after_blocks += TESTS_OF_PAIR;
            let version = self.near.version();
            let pair = pair.tested_up_to(since);
            let listed = if field.constants.listed_boxes { culling.min(Culling::Blocks) } else { culling };
            let pass = Pass { pair, version, kind: RowKind::FacesOfSecond, blocks: [b, a], inner: listed };
            self.test_parts::<FaceCorner>(pass, field, counters);
            let pass = Pass { kind: RowKind::FacesOfFirst, blocks: [a, b], inner: culling, ..pass };
            self.test_parts::<FaceCorner>(pass, field, counters);
            self.test_parts::<EdgeEdge>(Pass { kind: RowKind::Edges, ..pass }, field, counters);
            if self.near.version() != version {
                n = self.near.index_after(&pair);
            }
        }
    }

    /// Number of pairs, near or not, with an enabled block and, where unchanged ones are skipped, a
    /// block that has changed since the previous round began.
    fn count_pairs(&self, field: &Field) -> u64 {
        let (mut both, mut enabled, mut changed, mut neither) = (0u64, 0u64, 0u64, 0u64);
        for (n, block) in field.model.blocks.iter().enumerate() {
            let has_changed = !field.constants.skip_unchanged || self.changes.changed(n, self.previous_round);
            match (block.active, has_changed) {
                (true, true) => both += 1,
                (true, false) => enabled += 1,
                (false, true) => changed += 1,
                (false, false) => neither += 1,
            }
        }
        both * both.saturating_sub(1) / 2 + both * (enabled + changed + neither) + enabled * changed
    }

    /// Tests the listed parts of a pair of blocks of which one has changed.
    ///
    /// Figure 5.5 compares each part with the other block before it compares parts. While a pass
    /// has found nothing, parts that overlap do overlap the other block as well; a collision may
    /// enlarge boxes, and from then on those comparisons count.
    fn test_parts<P: PartPair>(&mut self, pass: Pass, field: &mut Field, counters: &mut Counters) {
        let mut version = pass.version;
        let mut rows = self.near.rows_of(&pass.pair, pass.kind, version);
        version = self.near.version();
        let are_boxed = pass.inner >= Culling::Boxes;
        let mut parts = (!are_boxed && field.constants.culling >= Culling::Boxes).then(|| self.parts::<P>(&pass));
        let mut changed = self.changed_corners(&pass);
        while !rows.is_empty() {
            let mut row = self.near.row(rows.start);
            rows.start += 1;
            if let Some(parts) = &mut parts {
                if parts.outer >> row.part & 1 == 0 {
                    continue;
                }
                self.update_inner::<P>(parts, &pass);
                row.others &= parts.inner;
            }
            let outer_changed = P::OUTER_CORNERS[usize::from(row.part)] & changed[0] != 0;
            loop {
                let others = if outer_changed { u16::MAX } else { P::inner_of(changed[1]) };
                let tested = Row { others: row.others & others, ..row };
                let Some((inner, contact)) = self.first_contact::<P>(&pass, tested, field, counters) else { break };
                if field.constants.culling >= Culling::Boxes {
                    let parts = parts.get_or_insert_with(|| self.parts::<P>(&pass));
                    row.others &= parts.inner;
                }
                row.others &= !1 << inner;
                self.respond(field, contact);
                changed = self.changed_corners(&pass);
                if self.near.version() != version {
                    // The list has changed: go on behind the parts at hand.
                    rows = self.near.rows_of(&pass.pair, pass.kind, version);
                    version = self.near.version();
                    let of_part = rows.clone().find(|index| self.near.row(*index).part == row.part);
                    row.others &= of_part.map_or(0, |index| self.near.row(index).others);
                    rows.start = rows.clone().find(|index| self.near.row(*index).part > row.part).unwrap_or(rows.end);
                }
            }
        }
    }

    /// Returns the first contact of a part with the others of a row, and the index of the other.
    fn first_contact<P: PartPair>(
        &self,
        pass: &Pass,
        row: Row,
        field: &Field,
        counters: &mut Counters,
    ) -> Option<(usize, Contact)> {
        let [outer_block, inner_block] = pass.blocks;
        let part = usize::from(row.part);
        let mut others = row.others;
        if pass.inner >= Culling::Boxes {
            let (outer, corners) = (P::outer_box(&self.boxes[outer_block], part), &self.boxes[inner_block]);
            others = overlapping(others, |n| P::inner_box(corners, n), &outer);
        }
        if others == 0 {
            return None;
        }
        let planes = field.constants.culling >= Culling::Planes;
        let (outer, corners) = (P::outer(&self.paths[outer_block], part), &self.paths[inner_block]);
        while others != 0 {
            let inner = others.trailing_zeros() as usize;
            others &= others - 1;
            counters.after_boxes += 1;
            let distance = P::distance(&outer, corners, inner);
            if planes && !distance.may_have_root() {
                continue;
            }
            counters.after_planes += 1;
            if let Some(contact) = P::contact(field, pass.blocks, [part, inner], &distance) {
                counters.collisions += 1;
                return Some((inner, contact));
            }
        }
        None
    }

    /// Returns the parts that overlap the other block.
    fn parts<P: PartPair>(&self, pass: &Pass) -> Parts {
        let [outer_block, inner_block] = pass.blocks;
        let corners = &self.boxes[outer_block];
        let outer = overlapping((1 << OUTER_PARTS) - 1, |n| P::outer_box(corners, n), &self.blocks[inner_block]);
        let mut parts = Parts { outer, inner: u16::MAX, event: 0 };
        self.update_inner::<P>(&mut parts, pass);
        parts
    }

    /// Updates the inner parts if a collision may have enlarged boxes.
    fn update_inner<P: PartPair>(&self, parts: &mut Parts, pass: &Pass) {
        if parts.event != self.changes.event() && pass.inner >= Culling::Boxes {
            let [outer_block, inner_block] = pass.blocks;
            let (all, corners) = ((1 << P::INNER_PARTS) - 1, &self.boxes[inner_block]);
            parts.inner = overlapping(all, |n| P::inner_box(corners, n), &self.blocks[outer_block]);
        }
        parts.event = self.changes.event();
    }

    /// Returns masks of the corners of both blocks that have changed since the test of the pair.
    #[inline]
    fn changed_corners(&self, pass: &Pass) -> [u8; 2] {
        pass.blocks.map(|block| self.changes.changed_corners(block, pass.pair.tested))
    }

    /// Resolves a contact and updates the boxes of its particles.
    fn respond(&mut self, field: &mut Field, contact: Contact) {
        field.respond(contact);
        self.changes.advance();
        for block in contact.blocks {
            let corners = field.model.blocks[block as usize].corners();
            let of_block = contact.parts().filter(|(p, _)| corners.contains(p));
            let changed = of_block.fold(0, |mask, (p, _)| mask | 1u8 << (p - corners.start));
            self.update_corners(block as usize, changed, &field.curr[corners.clone()], &field.next[corners]);
        }
    }

    /// Updates the boxes of a block after a change of some corners, a mask.
    fn update_corners(&mut self, block: usize, changed: u8, curr: &[State], next: &[State]) {
        boxes::update(&mut self.boxes[block], changed, curr, next);
        for n in (0..CORNERS).filter(|n| changed >> n & 1 == 1) {
            self.paths[block][n] = Path::between(curr[n].position, next[n].position);
        }
        self.blocks[block] = boxes::of_block(&self.boxes[block]);
        self.changes.mark_corners(block, changed);
        self.near.update(block, changed, &self.boxes);
    }
}

/// Returns the paths of the corners of a block.
#[inline]
fn paths(curr: &[State], next: &[State]) -> [Path; CORNERS] {
    std::array::from_fn(|n| Path::between(curr[n].position, next[n].position))
}

/// Returns those parts of a mask whose boxes overlap another.
#[inline]
fn overlapping(mask: u16, of: impl Fn(usize) -> Bounds, with: &Bounds) -> u16 {
    let (mut rest, mut overlapping) = (mask, 0);
    while rest != 0 {
        let n = rest.trailing_zeros();
        rest &= rest - 1;
        overlapping |= u16::from(of(n as usize).overlaps(with)) << n;
    }
    overlapping
}
