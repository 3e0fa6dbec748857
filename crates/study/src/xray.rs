//! The X-ray: what each block of a world carries, and how tight it is.

use serde::Serialize;
use teeter_physics::{BodyId, World};

/// A force below this is none, N: half of the weight of the lightest thing that lies on a block is far above it.
const NONE: f64 = 1e-3;
/// A contact whose normal is this much along gravity bears weight; the others are between sides.
const UPRIGHT: f64 = 0.7;

/// What a block carries.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Load {
    /// Normal force on the lower face, N.
    pub below_n: f64,
    /// Normal force on the upper face, N: the load.
    pub above_n: f64,
    /// The least force that starts it sliding straight, N: friction times the force below it and the lesser of the force above it and of the force
    /// on the upper faces of those that share its load. Friction can hold what the tower stored when it settled besides, and less where what
    /// lies on it can turn.
    pub tightness_n: f64,
}

impl Load {
    /// Whether nothing presses on it.
    pub fn is_loose(&self) -> bool {
        self.above_n < NONE
    }
}

/// The X-ray of a world with static friction `friction`, a load a block in order of creation. Down is -z. What shares the load of a block is what
/// bears any of the blocks that it bears: in a tower the rest of its row.
pub fn xray(world: &World, friction: f64) -> Vec<Load> {
    let count = world.len();
    let mut loads = vec![Load::default(); count];
    let mut on_top: Vec<Vec<BodyId>> = vec![Vec::new(); count];
    let mut bearers: Vec<Vec<BodyId>> = vec![Vec::new(); count];
    for body in world.bodies() {
        let i = body.index();
        for contact in world.contacts(body) {
            if contact.normal.z > UPRIGHT {
                loads[i].below_n += contact.force;
                bearers[i].extend(contact.other);
            } else if contact.normal.z < -UPRIGHT {
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
