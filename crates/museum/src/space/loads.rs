//! Loads of the contacts of a frame.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::Serialize;
use teeter_dissertation::jenga3d::Jenga3D;
use teeter_dissertation::jenga3d::contact::FLOOR;

/// Contact of a block with a mean load over the last frame.
#[derive(Debug, Serialize)]
pub struct LoadedContact {
    /// Index of the other block; `None` for the floor.
    pub other: Option<u32>,
    /// Position, m.
    pub point: [f64; 3],
    /// Direction of the force on the block.
    pub normal: [f64; 3],
    /// Force, N.
    pub force: f64,
}

/// Sums over the contacts of a pair of blocks in the steps of a frame.
#[derive(Debug, Clone, Copy, Default)]
struct Load {
    /// Sum of the forces on the first block, N.
    force: DVec3,
    /// Sum of their magnitudes, N.
    magnitude: f64,
    /// Sum of the positions, weighted by the magnitudes, N m.
    moment: DVec3,
}

/// Loads of the pairs of blocks in contact. The smaller index of a pair is first.
#[derive(Debug, Default)]
pub struct Loads(BTreeMap<[u32; 2], Load>);

impl Loads {
    /// Resets the loads for a new frame.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds the contacts of the last step.
    pub fn add(&mut self, jenga: &Jenga3D) {
        for contact in &jenga.contacts {
            let [a, b] = contact.blocks;
            let (pair, sign) = if a < b { ([a, b], 1.0) } else { ([b, a], -1.0) };
            let at: DVec3 = contact.parts().filter(|(_, w)| *w > 0.0).map(|(p, w)| w * jenga.curr[p].position).sum();
            let load = self.0.entry(pair).or_default();
            load.force += sign * contact.normal_force * contact.normal;
            load.magnitude += contact.normal_force;
            load.moment += contact.normal_force * at;
        }
    }

    /// Number of pairs of blocks in contact, without the floor.
    pub fn touching_blocks(&self) -> usize {
        self.0.keys().filter(|pair| pair[1] != FLOOR).count()
    }

    /// Returns true if a block was in contact.
    pub fn is_touching(&self, block: u32) -> bool {
        self.0.keys().any(|pair| pair.contains(&block))
    }

    /// Returns the loaded contacts of a block, as means over the `steps` steps of the frame.
    pub fn of_block(&self, block: u32, steps: u32) -> Vec<LoadedContact> {
        self.0
            .iter()
            .filter(|(pair, load)| pair.contains(&block) && load.magnitude > 0.0)
            .map(|(&[first, second], load)| {
                let (other, force) = if first == block { (second, load.force) } else { (first, -load.force) };
                LoadedContact {
                    other: (other != FLOOR).then_some(other),
                    point: (load.moment / load.magnitude).to_array(),
                    normal: force.normalize_or_zero().to_array(),
                    force: force.length() / f64::from(steps),
                }
            })
            .collect()
    }
}
