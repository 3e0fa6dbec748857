//! Counters of tests (Table 5.2).

use serde::Serialize;

/// Potential collisions that remain after each kind of test.
///
/// ```
/// use teeter_dissertation::jenga3d::counters::Counters;
///
/// let mut sum = Counters::default();
/// sum += Counters { potential: 336, ..Counters::default() };
/// assert_eq!(sum.potential, 336);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Before any test: 336 a pair of blocks, 8 x 12 points and faces in both directions and 12 x
    /// 12 edges.
    pub potential: u64,
    /// After the boxes of blocks.
    pub after_blocks: u64,
    /// After the boxes of faces, edges and particles.
    pub after_boxes: u64,
    /// After the tests of planes and lines.
    pub after_planes: u64,
    /// Collisions found.
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

/// Tests of one pair of blocks: 2 (8 x 12) + 12 x 12.
pub const TESTS_OF_PAIR: u64 = 336;

/// Returns the number of tests of `blocks` blocks without culling, each pair once: 168 n (n - 1) of
/// section 4.4.3.
pub fn tests(blocks: u64) -> u64 {
    blocks * blocks.saturating_sub(1) * 168
}

/// Counters of one step of integrating and colliding.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("column").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// assert_eq!(simulator.step(None).first.potential, 336 * 45); // 45 pairs
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct StepCounts {
    /// Tests of the first round of each call of `CollideBlocks`.
    pub first: Counters,
    /// Tests of all rounds.
    pub all: Counters,
    /// Maximum number of rounds over the pairs in a call; the last finds nothing.
    pub sweeps: u32,
    /// Calls that ended with collisions left.
    pub unresolved: u32,
}
