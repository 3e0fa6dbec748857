//! Counts of tests (Table 5.2).

use serde::Serialize;

/// Potential collisions left after each kind of test.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Without any test: 336 a pair of blocks, 8 x 12 points and faces both ways and 12 x 12 edges.
    pub potential: u64,
    /// After the boxes of blocks.
    pub after_blocks: u64,
    /// After the boxes of faces, edges and particles.
    pub after_boxes: u64,
    /// After the tests of planes and lines.
    pub after_planes: u64,
    /// Collisions.
    pub collisions: u64,
}

impl std::ops::AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.potential += other.potential;
        self.after_blocks += other.after_blocks;
        self.after_boxes += other.after_boxes;
        self.after_planes += other.after_planes;
        self.collisions += other.collisions;
    }
}

/// Tests of one pair of blocks, each pair looked at once: 2 (8 x 12) + 12 x 12.
pub const TESTS_OF_PAIR: u64 = 336;

/// Tests of `blocks` blocks without culling, each pair looked at once: 168 n (n - 1) of section 4.4.3.
pub fn tests(blocks: u64) -> u64 {
    blocks * blocks.saturating_sub(1) * 168
}

/// What one step of integrating and colliding did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct StepCounts {
    /// Tests of the first round of each call of `CollideBlocks`.
    pub first: Counters,
    /// Tests of all rounds.
    pub all: Counters,
    /// Rounds over the pairs of the call that needed most; the last finds nothing.
    pub sweeps: u32,
    /// Calls that ended with collisions left.
    pub unresolved: u32,
}
