//! Pairs of blocks that may meet, with the parts of each that may, cached over steps.
//!
//! Each block has reference boxes: those of its parts at some step, enlarged by a margin. While the
//! boxes of its corners stay within them, no part can overlap another whose reference box its own
//! does not. So a step tests the listed parts only, and finds all that it would find without the
//! list. A block that leaves its reference boxes gets new ones at once.

use std::ops::Range;

use super::bounds::{Bounds, overlapping};
use super::boxes::{self, CornerBoxes, PartBoxes};
use super::constants::Constants;
use super::options::{Culling, Order};

/// Minimum margin of reference boxes, m: a corner at rest moves by less in hundreds of steps, and
/// few more parts are listed.
const MIN_MARGIN: f64 = 8e-5;
/// Margin over the path of a corner in the step: steps for which a fast block keeps its boxes.
const MARGIN_STEPS: f64 = 16.0;

/// Parts of one block that a part of another may meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Index of the part: a face, or an edge of the first block.
    pub part: u8,
    /// Mask of the parts it may meet: corners, or edges of the second block.
    pub others: u16,
}

/// Kinds of rows of a pair (a, b), in the order of their tests (Figure 5.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowKind {
    /// Faces of b with corners of a.
    FacesOfSecond,
    /// Faces of a with corners of b.
    FacesOfFirst,
    /// Edges of a with edges of b.
    Edges,
}

/// Pair of blocks that may meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearPair {
    /// Indices of the blocks, in the order of their tests.
    pub blocks: [u32; 2],
    /// Event up to which the pair was tested.
    pub tested: u32,
    /// Ranks of the blocks.
    ranks: [u32; 2],
    /// Ends of its rows of each kind, after their start.
    rows: [u32; 4],
}

impl NearPair {
    /// Returns the pair as tested up to another event.
    pub fn tested_up_to(self, event: u32) -> Self {
        Self { tested: event, ..self }
    }
}

/// Cache of the pairs.
#[derive(Debug, Clone, Default)]
pub struct NearPairs {
    /// Reference boxes of the parts of every block.
    reference: Vec<PartBoxes>,
    /// Reference boxes of the blocks.
    outer: Vec<Bounds>,
    /// Rank of every block in the order of tests.
    ranks: Vec<u32>,
    pairs: Vec<NearPair>,
    rows: Vec<Row>,
    /// Options for which the rows were listed.
    culling: Option<(Culling, bool)>,
    version: u32,
    stale: Vec<bool>,
}

impl NearPairs {
    /// Starts a step, none of whose pairs is tested: updates the reference boxes that the boxes of
    /// a block have left, and the pairs of those blocks.
    pub fn begin(&mut self, boxes: &[CornerBoxes], constants: &Constants, height: impl Fn(usize) -> f64) {
        let culling = Some((constants.culling, constants.listed_boxes));
        let is_new = self.culling != culling || self.reference.len() != boxes.len();
        if is_new {
            *self = Self { culling, version: self.version, ..Self::default() };
            self.reference.resize(boxes.len(), PartBoxes::all());
            self.outer.resize(boxes.len(), Bounds::ALL);
        }
        let are_ranked = self.rank(constants.order, boxes.len(), height);
        self.stale.clear();
        self.stale.extend(boxes.iter().zip(&self.reference).map(|(boxes, reference)| !reference.enclose(boxes, 0xff)));
        if is_new || are_ranked {
            self.stale.fill(true);
        }
        if self.stale.contains(&true) {
            self.refresh(boxes);
        }
        for pair in &mut self.pairs {
            pair.tested = 0;
        }
    }

    /// Ranks the blocks by an order (section 3.3.4), and returns true if a rank has changed.
    fn rank(&mut self, order: Order, count: usize, height: impl Fn(usize) -> f64) -> bool {
        if order == Order::Naive && self.ranks.len() == count && self.ranks.is_sorted() {
            return false;
        }
        let mut blocks: Vec<u32> = (0..count as u32).collect();
        let by_height = |a: &u32, b: &u32| height(*a as usize).total_cmp(&height(*b as usize));
        match order {
            Order::Naive => {}
            Order::BottomUp => blocks.sort_by(by_height),
            Order::TopDown => blocks.sort_by(|a, b| by_height(b, a)),
        }
        let mut ranks = vec![0; count];
        for (rank, block) in blocks.into_iter().enumerate() {
            ranks[block as usize] = rank as u32;
        }
        let has_changed = ranks != self.ranks;
        self.ranks = ranks;
        has_changed
    }

    /// Updates the pairs of one block within a step if the boxes of some corners, a mask, have left
    /// its reference boxes.
    pub fn update(&mut self, block: usize, corners: u8, boxes: &[CornerBoxes]) {
        if !self.reference[block].enclose(&boxes[block], corners) {
            self.stale.fill(false);
            self.stale[block] = true;
            self.refresh(boxes);
        }
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Pair by index.
    #[inline]
    pub fn pair(&self, n: usize) -> NearPair {
        self.pairs[n]
    }

    /// Records that a pair was tested up to an event.
    #[inline]
    pub fn set_tested(&mut self, n: usize, event: u32) {
        self.pairs[n].tested = event;
    }

    /// Version of the list, which changes with its pairs and rows.
    #[inline]
    pub fn version(&self) -> u32 {
        self.version
    }

    /// Index of the first pair after another, in the order of tests.
    pub fn index_after(&self, pair: &NearPair) -> usize {
        self.pairs.partition_point(|other| other.ranks <= pair.ranks)
    }

    /// Indices of the rows of a pair, also of one of an earlier version.
    #[inline]
    pub fn rows_of(&self, pair: &NearPair, kind: RowKind, version: u32) -> Range<usize> {
        let current = if version == self.version { Some(pair) } else { self.find(pair) };
        let kind = kind as usize;
        current.map_or(0..0, |pair| pair.rows[kind] as usize..pair.rows[kind + 1] as usize)
    }

    fn find(&self, pair: &NearPair) -> Option<&NearPair> {
        self.pairs.binary_search_by(|other| other.ranks.cmp(&pair.ranks)).ok().map(|n| &self.pairs[n])
    }

    /// Row by index.
    #[inline]
    pub fn row(&self, index: usize) -> Row {
        self.rows[index]
    }

    /// Replaces the reference boxes and the pairs of the stale blocks.
    fn refresh(&mut self, boxes: &[CornerBoxes]) {
        self.version = self.version.wrapping_add(1);
        let cached = self.culling.is_some_and(|(culling, _)| culling >= Culling::Boxes);
        for (block, corners) in boxes.iter().enumerate().filter(|(block, _)| self.stale[*block]) {
            // Without boxes every pair is tested, and all of its parts.
            self.reference[block] =
                if cached { PartBoxes::enlarged(corners, margin(corners)) } else { PartBoxes::all() };
            self.outer[block] = boxes::of_block(&self.reference[block].corners);
        }
        let (old_pairs, old_rows) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.rows));
        for pair in &old_pairs {
            if pair.blocks.iter().any(|block| self.stale[*block as usize]) {
                continue;
            }
            let start = self.rows.len() as u32;
            self.rows.extend_from_slice(&old_rows[pair.rows[0] as usize..pair.rows[3] as usize]);
            self.pairs.push(NearPair { rows: pair.rows.map(|end| end - pair.rows[0] + start), ..*pair });
        }
        for block in (0..boxes.len()).filter(|block| self.stale[*block]).collect::<Vec<_>>() {
            for other in 0..boxes.len() {
                // A pair of two stale blocks is listed once, by the first.
                let is_first = other > block || (other != block && !self.stale[other]);
                if is_first && self.outer[block].overlaps(&self.outer[other]) {
                    self.list(block, other);
                }
            }
        }
        self.pairs.sort_by_key(|pair| pair.ranks);
        for old in old_pairs {
            if let Ok(n) = self.pairs.binary_search_by(|pair| pair.ranks.cmp(&old.ranks)) {
                self.pairs[n].tested = old.tested;
            }
        }
    }

    /// Lists a pair of blocks with the parts of each that may meet.
    fn list(&mut self, block: usize, other: usize) {
        let [a, b] = if self.ranks[block] < self.ranks[other] { [block, other] } else { [other, block] };
        let is_listed = self.culling.is_some_and(|(_, listed)| listed);
        let mut rows = [self.rows.len() as u32; 4];
        self.list_faces(b, a, is_listed);
        rows[1] = self.rows.len() as u32;
        self.list_faces(a, b, false);
        rows[2] = self.rows.len() as u32;
        let (first, second) = (&self.reference[a], &self.reference[b]);
        for (part, edge) in first.edges.iter().enumerate().filter(|(_, edge)| edge.overlaps(&self.outer[b])) {
            let others = overlapping(&second.edges, edge);
            if others != 0 {
                self.rows.push(Row { part: part as u8, others });
            }
        }
        rows[3] = self.rows.len() as u32;
        let ranks = [self.ranks[a], self.ranks[b]];
        self.pairs.push(NearPair { blocks: [a as u32, b as u32], tested: 0, ranks, rows });
    }

    /// Lists the faces of one block with the corners of another, all of them for a comparison of
    /// boxes as Figure 5.5 lists it.
    fn list_faces(&mut self, of: usize, corners_of: usize, all_corners: bool) {
        let corners = &self.reference[corners_of].corners;
        for (part, face) in self.reference[of].faces.iter().enumerate() {
            if face.overlaps(&self.outer[corners_of]) {
                let others = if all_corners { 0xff } else { overlapping(corners, face) };
                if others != 0 {
                    self.rows.push(Row { part: part as u8, others });
                }
            }
        }
    }
}

/// Margin of the reference boxes of a block with these boxes, m.
fn margin(corners: &CornerBoxes) -> f64 {
    let path = corners.iter().map(Bounds::max_extent).fold(0.0, f64::max);
    MIN_MARGIN + MARGIN_STEPS * path
}
