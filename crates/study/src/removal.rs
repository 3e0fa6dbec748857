//! A tower without one of its blocks: whether it stands, and whether it goes on to.
//!
//! It is built without the block and settles. That asks the question of statics, which rigid blocks answer exactly; how the block got out is the business
//! of [`crate::extract`].

use serde::Serialize;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::exact::{NoAnswer, Rigid};
use crate::places::Places;
use crate::settle::{SETTLE, frames};

/// How long the tower is watched, s.
const WATCHED: f64 = 5.0;

/// What became of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Removal {
    /// Id of the block.
    pub id: u32,
    /// Whether the tower fell: a block came down by more than 3 mm, or went by more than 5 mm once the tower had settled. A tower may lean by more than that while it
    /// settles, and stand.
    pub fell: bool,
    /// Furthest that any block was at the end from where it was built, mm.
    pub lean_mm: f64,
    /// Whether rigid blocks would; none where the programme was not solved.
    pub exact_fell: Option<bool>,
    /// Furthest that any block was at the end from where it was at 2 s, mm, where it stands.
    pub creep_mm: f64,
}

/// The blocks that the rules let a player take: those below the highest full row. Of a full tower, all below the top row.
pub fn legal(scene: &Scene) -> Vec<usize> {
    let rows = scene.blocks.len() / 3;
    (0..3 * rows.saturating_sub(1)).collect()
}

/// The scene without one of its blocks.
pub fn without(scene: &Scene, block: usize) -> Scene {
    let mut scene = scene.clone();
    scene.blocks.remove(block);
    scene
}

/// Builds the tower without a block and watches it.
///
/// # Errors
/// When the world cannot be built.
pub fn remove(scene: &Scene, block: usize, params: Params) -> Result<Removal, BuildError> {
    let rest = without(scene, block);
    let exact_fell = match Rigid::stands(&rest) {
        Ok(()) => Some(false),
        Err(NoAnswer::Falls) => Some(true),
        Err(NoAnswer::Unsolved) => None,
    };
    let mut world = World::new(&rest, params)?;
    let start = Places::of(&world);
    let (mut fell, mut settled) = (false, start.clone());
    for i in 1..=frames(&world, WATCHED) {
        fell |= !world.step(&Input::default()).quarantined.is_empty() || start.any_dropped(&world);
        if i == frames(&world, SETTLE) {
            settled = Places::of(&world);
        }
        fell |= i > frames(&world, SETTLE) && settled.any_fallen(&world);
        if fell {
            break;
        }
    }
    let creep_mm = if fell { 0.0 } else { 1e3 * settled.furthest(&world) };
    let lean_mm = 1e3 * start.furthest(&world);
    Ok(Removal { id: scene.blocks[block].id, fell, lean_mm, exact_fell, creep_mm })
}
