//! Changes of blocks within a step, numbered by event.

use super::block::CORNERS;

/// Events of the last change of every block and corner. An event is one change of the next states.
#[derive(Debug, Clone, Default)]
pub struct Changes {
    event: u32,
    blocks: Vec<u32>,
    corners: Vec<[u32; CORNERS]>,
}

impl Changes {
    /// Starts a step in which every corner of `blocks` blocks has changed.
    pub fn reset(&mut self, blocks: usize) {
        self.event = 1;
        self.blocks.clear();
        self.blocks.resize(blocks, 1);
        self.corners.clear();
        self.corners.resize(blocks, [1; CORNERS]);
    }

    /// Number of the last event.
    #[inline]
    pub fn event(&self) -> u32 {
        self.event
    }

    /// Starts a new event.
    pub fn advance(&mut self) {
        self.event += 1;
    }

    /// Records a change of one corner at the current event.
    pub fn mark_corner(&mut self, block: usize, corner: usize) {
        self.blocks[block] = self.event;
        self.corners[block][corner] = self.event;
    }

    /// Records a change of all corners of a block at the current event.
    pub fn mark_block(&mut self, block: usize) {
        self.blocks[block] = self.event;
        self.corners[block] = [self.event; CORNERS];
    }

    /// Returns true if neither block has changed after an event.
    #[inline]
    pub fn pair_unchanged(&self, a: usize, b: usize, since: u32) -> bool {
        self.blocks[a].max(self.blocks[b]) <= since
    }

    /// Returns true if no given corner of a block has changed after an event.
    #[inline]
    pub fn corners_unchanged<const N: usize>(&self, block: usize, corners: [usize; N], since: u32) -> bool {
        corners.iter().all(|&c| self.corners[block][c] <= since)
    }
}
