//! X-ray: load and tightness of each block of a world.

use serde::Serialize;
use teeter_physics::{BodyId, World};

/// Load below which a block is loose, N. The lightest block that can lie on it weighs more than
/// a hundred times as much.
const MIN_LOAD: f64 = 1e-3;
/// Vertical component of the normal from which a contact bears weight; others are between sides.
const MIN_VERTICAL: f64 = 0.7;

/// Load of a block.
///
/// ```
/// # use teeter_physics::Params;
/// # use teeter_study::{settled, xray};
/// let scene = teeter_scene::named("column").unwrap();
/// let weight = scene.blocks[0].mass * scene.gravity;
/// let load = xray(&settled(&scene, Params::default())?, scene.friction)[0];
/// assert!((load.below_n / (10.0 * weight) - 1.0).abs() < 1e-3);
/// assert!((load.above_n / (9.0 * weight) - 1.0).abs() < 1e-3);
/// // the blocks above go along: friction acts on the lower face alone
/// assert!((load.tightness_n / (scene.friction * load.below_n) - 1.0).abs() < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Load {
    /// Normal force on the lower face, N.
    pub below_n: f64,
    /// Normal force on the upper face, N: the load.
    pub above_n: f64,
    /// Force that starts the block sliding straight, N: friction times (force below + the smaller
    /// of the force above it and of the force above those that share its load).
    ///
    /// The actual force is larger by what friction stored while the tower settled, and smaller
    /// where the tower above can turn.
    pub tightness_n: f64,
}

impl Load {
    /// Returns true if nothing presses on the block.
    pub fn is_loose(&self) -> bool {
        self.above_n < MIN_LOAD
    }
}

/// Returns the load of each block of a world with static friction `friction`, in order of creation.
/// Down is -z.
///
/// Blocks share a load when they bear the same block: in a tower the blocks of a row.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::{settled, xray};
///
/// let scene = teeter_scene::config("(1L1)-(010)", &teeter_scene::TowerOptions::exact()).unwrap();
/// let loads = xray(&settled(&scene, Params::default())?, scene.friction);
/// assert!(loads[1].is_loose() && !loads[0].is_loose());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn xray(world: &World, friction: f64) -> Vec<Load> {
    let count = world.len();
    let mut loads = vec![Load::default(); count];
    let mut on_top: Vec<Vec<BodyId>> = vec![Vec::new(); count];
    let mut bearers: Vec<Vec<BodyId>> = vec![Vec::new(); count];
    for body in world.bodies() {
        let i = body.index();
        for contact in world.contacts(body) {
            if contact.normal.z > MIN_VERTICAL {
                loads[i].below_n += contact.force;
                bearers[i].extend(contact.other);
            } else if contact.normal.z < -MIN_VERTICAL {
                loads[i].above_n += contact.force;
                on_top[i].extend(contact.other);
            }
        }
    }
    for i in 0..count {
        let mut mates: Vec<BodyId> =
            on_top[i].iter().flat_map(|&j| &bearers[j.index()]).copied().filter(|&j| j.index() != i).collect();
        mates.sort_unstable();
        mates.dedup();
        let rest: f64 = mates.iter().map(|&j| loads[j.index()].above_n).sum();
        loads[i].tightness_n = friction * (loads[i].below_n + loads[i].above_n.min(rest));
    }
    loads
}
