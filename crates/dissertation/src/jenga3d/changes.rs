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

    /// Records a change of some corners of a block, a mask, at the current event.
    pub fn mark_corners(&mut self, block: usize, corners: u8) {
        self.blocks[block] = self.event;
        for (corner, event) in self.corners[block].iter_mut().enumerate() {
            if corners >> corner & 1 == 1 {
                *event = self.event;
            }
        }
    }

    /// Returns true if a block has changed after an event.
    #[inline]
    pub fn changed(&self, block: usize, since: u32) -> bool {
        self.blocks[block] > since
    }

    /// Returns a mask of the corners of a block that have changed after an event.
    #[inline]
    pub fn changed_corners(&self, block: usize, since: u32) -> u8 {
        if since == 0 {
            return 0xff;
        }
        self.corners[block].iter().enumerate().fold(0, |mask, (n, event)| mask | u8::from(*event > since) << n)
    }
}
