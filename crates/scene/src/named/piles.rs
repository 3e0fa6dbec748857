//! Blocks one upon the other, and let fall.

use super::setting::{nominal, scene_of};
use crate::preset::BlockPreset;
use crate::random::Random;
use crate::scene::Scene;

/// Stack of `n` blocks, all along x.
pub fn stack(n: u32) -> Scene {
    let height = BlockPreset::Dissertation.size()[2];
    scene_of((0..n).map(|i| nominal(i, [0.0, 0.0, height * (f64::from(i) + 0.5)], 0.0)).collect())
}

/// Blocks in the air above each other, each turned and offset at random.
pub fn pile() -> Scene {
    let mut random = Random::new(1);
    let drop = |i: u32| {
        let mut offset = || 0.03 * (2.0 * random.uniform() - 1.0);
        let pos = [offset(), offset(), 0.03 + 0.025 * f64::from(i)];
        nominal(i, pos, std::f64::consts::PI * random.uniform())
    };
    scene_of((0..40).map(drop).collect())
}
