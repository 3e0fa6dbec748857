//! Interface of the simulators that the report compares.

use glam::DVec3;
use teeter_dissertation::jenga3d::counters::Rounds;

/// Block held by a hand.
#[derive(Debug, Clone, Copy)]
pub struct Grasp {
    /// Index of the block.
    pub block: u32,
    /// Target of its centre, m.
    pub target: DVec3,
    /// True when the block is carried, false when it slides out of the tower.
    pub carried: bool,
}

/// Result of a frame.
#[derive(Debug, Clone, Default)]
pub struct FrameReport {
    /// Floating-point operations.
    pub operations: f64,
    /// True for each block that is disabled or asleep.
    pub resting: Vec<bool>,
    /// Rounds over the pairs; all zero for the engine, which has none.
    pub rounds: Rounds,
}

/// Tower that is simulated a frame at a time.
///
/// `teeter_game::Simulator` serves play. A comparison needs the cost of a frame, the blocks at rest
/// and initial velocities instead, and neither contacts nor changes of form.
pub trait Backend: Send {
    /// Number of blocks.
    fn len(&self) -> usize;

    /// Advances by a frame under a hand.
    fn step(&mut self, hand: Option<&Grasp>) -> FrameReport;

    /// Corners of a block, m. Bits 0, 1 and 2 of an index give the side along the block's axes.
    fn corners(&self, block: usize) -> [DVec3; 8];

    /// Sets the velocity of a block, m/s.
    fn set_velocity(&mut self, block: usize, velocity: DVec3);
}
