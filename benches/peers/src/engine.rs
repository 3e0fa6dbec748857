//! Interface of an engine under measurement.

use glam::{DQuat, DVec3};

/// Time of a frame, s.
pub const FRAME: f64 = 1.0 / 60.0;

/// Force at the centre of a block that grows linearly during a frame, N.
#[derive(Debug, Clone, Copy)]
pub struct Pull {
    /// Index of the block.
    pub body: usize,
    /// Force at the start of the frame, N.
    pub from: DVec3,
    /// Force at the end of the frame, N.
    pub to: DVec3,
}

impl Pull {
    /// Force at the end of step `i` of `n` in the frame, N.
    pub fn at(&self, i: usize, n: usize) -> DVec3 {
        self.from.lerp(self.to, (i + 1) as f64 / n as f64)
    }
}

/// Engine with a scene. Lengths are in m and forces in N in every engine; sleep is off, with one
/// thread.
pub trait Engine {
    /// Advances by [`FRAME`].
    fn frame(&mut self, pull: Option<Pull>);
    /// Centre (m) and orientation of a block.
    fn pose(&self, body: usize) -> (DVec3, DQuat);
}
