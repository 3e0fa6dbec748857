//! Setting of the named scenes: friction, restitution and the nominal block.

use crate::form::{Form, Springs};
use crate::preset::BlockPreset;
use crate::scene::{Block, Scene, default_stiffness, standard_gravity};
use crate::tower::WOOD_RESTITUTION;

/// Scene of sharp wooden blocks with friction 0.4.
pub fn scene_of(blocks: Vec<Block>) -> Scene {
    Scene {
        name: String::new(),
        gravity: standard_gravity(),
        friction: 0.4,
        kinetic_friction: None,
        restitution: WOOD_RESTITUTION,
        stiffness: default_stiffness(),
        edge_radius: 0.0,
        form: Form::default(),
        springs: Springs::default(),
        blocks,
        label: None,
        margin: None,
        tilt_az: None,
    }
}

/// Block of nominal size.
pub fn nominal(id: u32, pos: [f64; 3], yaw: f64) -> Block {
    let preset = BlockPreset::Dissertation;
    Block { yaw, ..Block::new(id, preset.size(), preset.mass(), pos) }
}
