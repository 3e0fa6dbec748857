//! Removal of one block: stability of a tower that is built without it.
//!
//! Building the tower without the block asks the question of statics, which rigid blocks answer
//! exactly. How the block comes out is the subject of [`crate::extract`].

use serde::Serialize;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::fall::Footing;
use crate::limit_analysis::RigidTower;
use crate::reference_positions::ReferencePositions;
use crate::settle::SETTLE_TIME;

/// Simulated time of a tower without a block, s.
const DURATION: f64 = 5.0;

/// Outcome of a removal.
///
/// ```
/// # use teeter_physics::Params;
/// # use teeter_scene::{TowerOptions, config};
/// let scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
/// // the outer blocks of the lower row bear the upper one
/// let removal = teeter_study::remove(&scene, 1, Params::default())?;
/// assert_eq!((removal.id, removal.fell, removal.exact_fell), (1, false, Some(false)));
/// assert!(removal.lean_mm < 0.01 && removal.creep_mm < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Removal {
    /// Id of the block.
    pub id: u32,
    /// True when a block of the tower fell, see [`Footing`].
    pub fell: bool,
    /// Largest displacement of any block from where it was built, at the end, mm.
    pub lean_mm: f64,
    /// True when a tower of rigid blocks falls; none where the linear programme was not solved.
    pub exact_fell: Option<bool>,
    /// Largest displacement of any block between [`SETTLE_TIME`] and the end, mm; 0 after a fall.
    pub creep_mm: f64,
}

/// Returns the indices of the blocks that the rules let a player take from a full tower: all below
/// the top row.
///
/// ```
/// use teeter_scene::{TowerOptions, config};
///
/// let scene = config("(111)-(111)", &TowerOptions::exact())?;
/// assert_eq!(teeter_study::removable_blocks(&scene), [0, 1, 2]);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
pub fn removable_blocks(scene: &Scene) -> Vec<usize> {
    let rows = scene.blocks.len() / 3;
    (0..3 * rows.saturating_sub(1)).collect()
}

/// Returns the scene without one of its blocks.
///
/// # Panics
/// When the scene has no block of that index.
///
/// ```
/// let scene = teeter_scene::named("column").unwrap();
/// assert_eq!(teeter_study::without_block(&scene, 3).blocks.len(), 9);
/// ```
pub fn without_block(scene: &Scene, block: usize) -> Scene {
    let mut scene = scene.clone();
    scene.blocks.remove(block);
    scene
}

/// Builds the tower without a block and simulates it for 5 s.
///
/// # Errors
/// When the world cannot be built.
///
/// # Panics
/// When the scene has no block of that index.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_scene::{TowerOptions, config};
///
/// let scene = config("(010)-(111)", &TowerOptions::exact()).unwrap();
/// let removal = teeter_study::remove(&scene, 0, Params::default())?;
/// assert!(removal.fell && removal.exact_fell == Some(true));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn remove(scene: &Scene, block: usize, params: Params) -> Result<Removal, BuildError> {
    let rest = without_block(scene, block);
    let exact_fell = RigidTower::falls(&rest);
    let mut world = World::new(&rest, params)?;
    let settling = world.frames(SETTLE_TIME);
    let start = ReferencePositions::of(&world);
    let (footing, mut fell, mut settled) = (Footing::of_scene(&rest), false, start.clone());
    for i in 1..=world.frames(DURATION) {
        fell = !world.step(&Input::default()).quarantined.is_empty() || footing.any_fallen(&world);
        if fell {
            break;
        }
        if i == settling {
            settled = ReferencePositions::of(&world);
        }
    }
    let creep_mm = if fell { 0.0 } else { 1e3 * settled.max_displacement(&world) };
    let lean_mm = 1e3 * start.max_displacement(&world);
    Ok(Removal { id: scene.blocks[block].id, fell, lean_mm, exact_fell, creep_mm })
}
