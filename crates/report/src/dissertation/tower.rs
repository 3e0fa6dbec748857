//! Tower under one of the simulators, and geometry of its blocks.

use glam::DVec3;
use teeter_dissertation::jenga3d::counters::Rounds;

use super::backend::{Backend, FrameReport, Grasp};

/// Frames per second.
pub const FRAME_RATE: f64 = 60.0;

/// Tower under a simulator.
pub struct Tower {
    backend: Box<dyn Backend>,
    last: FrameReport,
    rounds: Rounds,
    frames: u64,
}

impl Tower {
    /// Tower of a simulator before its first frame.
    pub fn new(backend: impl Backend + 'static) -> Self {
        Self { backend: Box::new(backend), last: FrameReport::default(), rounds: Rounds::default(), frames: 0 }
    }

    /// Advances by a frame under a hand.
    pub fn step(&mut self, hand: Option<&Grasp>) {
        self.last = self.backend.step(hand);
        self.rounds += self.last.rounds;
        self.frames += 1;
    }

    /// Advances by `frames` without a hand.
    pub fn rest(&mut self, frames: u32) {
        for _ in 0..frames {
            self.step(None);
        }
    }

    /// Sets the velocity of a block, m/s.
    pub fn set_velocity(&mut self, block: usize, velocity: DVec3) {
        self.backend.set_velocity(block, velocity);
    }

    /// Floating-point operations of the last frame.
    pub fn operations(&self) -> f64 {
        self.last.operations
    }

    /// Rounds over the pairs in all frames.
    pub fn rounds(&self) -> Rounds {
        self.rounds
    }

    /// Number of frames.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Returns true if a block was disabled or asleep in the last frame.
    pub fn is_resting(&self, block: usize) -> bool {
        self.last.resting.get(block).is_some_and(|resting| *resting)
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.backend.len()
    }

    /// Corners of a block, m. Bits 0, 1 and 2 of an index give the side along the block's axes.
    pub fn corners(&self, block: usize) -> [DVec3; 8] {
        self.backend.corners(block)
    }

    /// Centre of a block, m.
    pub fn centre(&self, block: usize) -> DVec3 {
        self.corners(block).into_iter().sum::<DVec3>() / 8.0
    }

    /// Centres of all blocks, m.
    pub fn centres(&self) -> Vec<DVec3> {
        (0..self.len()).map(|block| self.centre(block)).collect()
    }

    /// Unit vector along the length of a block, towards its corners with bit 0.
    pub fn along(&self, block: usize) -> DVec3 {
        let corners = self.corners(block);
        (0..8).map(|c| if c & 1 == 1 { corners[c] } else { -corners[c] }).sum::<DVec3>().normalize_or_zero()
    }

    /// Height of the highest corner of the blocks for which `counts` is true, m.
    pub fn top(&self, counts: impl Fn(usize) -> bool) -> f64 {
        let blocks = (0..self.len()).filter(|block| counts(*block));
        blocks.flat_map(|block| self.corners(block)).map(|corner| corner.z).fold(0.0, f64::max)
    }
}
