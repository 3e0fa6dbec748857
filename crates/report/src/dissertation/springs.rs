//! Simulator of the dissertation: blocks of particles and springs.

use glam::DVec3;
use teeter_dissertation::jenga3d::{self, BuildError, Constants, Jenga3D};
use teeter_scene::Scene;

use super::backend::{Backend, FrameReport, Grasp};
use super::cost;

/// Simulator of the dissertation.
pub struct Springs(pub Jenga3D);

impl Springs {
    /// Builds a scene.
    ///
    /// # Errors
    /// When the scene or a constant is not valid.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, BuildError> {
        Ok(Self(Jenga3D::new(scene, constants)?))
    }
}

impl Backend for Springs {
    fn len(&self) -> usize {
        self.0.model.blocks.len()
    }

    fn step(&mut self, hand: Option<&Grasp>) -> FrameReport {
        let hand = hand.map(|grasp| jenga3d::Hand { block: grasp.block, target: grasp.target });
        let report = self.0.frame(hand.as_ref());
        FrameReport {
            operations: cost::of_springs(&self.0, &report.tests),
            rounds: report.rounds,
            resting: self.0.model.blocks.iter().map(|block| !block.active).collect(),
        }
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let first = self.0.model.blocks[block].corners().start;
        std::array::from_fn(|c| self.0.curr[first + c].position)
    }

    fn set_velocity(&mut self, block: usize, velocity: DVec3) {
        self.0.throw(block, velocity);
    }
}
