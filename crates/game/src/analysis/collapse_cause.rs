//! Cause of a fall: the loaded contact that was lost first.

use std::collections::BTreeMap;

use serde::Serialize;
use teeter_physics::{BodyId, World};

/// Vertical component of the normal from which a contact bears weight.
const MIN_VERTICAL: f64 = 0.7;
/// Load from which a contact bears, N, a quarter of a block's weight; and below which it is lost.
const BEARS: f64 = 0.05;
const LOST: f64 = 1e-3;

/// Contact between a block and its bearer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    above: BodyId,
    below: Option<BodyId>,
}

/// Contact that was lost before a tower fell.
///
/// ```
/// use teeter_game::LostContact;
/// use teeter_physics::BodyId;
///
/// let lost = LostContact { above: BodyId(4), below: None, load_n: 0.4, time_s: 3.5 };
/// assert!(lost.below.is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LostContact {
    /// Upper block.
    pub above: BodyId,
    /// Its bearer; none for the floor.
    pub below: Option<BodyId>,
    /// Load at the start of the move, N.
    #[serde(rename = "load_N")]
    pub load_n: f64,
    /// Time from which it bore nothing until the fall, s.
    #[serde(rename = "at_s")]
    pub time_s: f64,
}

/// Watches the loaded contacts of a tower during a move.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactWatch {
    taken: BodyId,
    loads: BTreeMap<Pair, f64>,
    lost: BTreeMap<Pair, f64>,
}

impl ContactWatch {
    /// Begins with the loads of a tower from which `taken` is about to be taken.
    pub fn new(world: &World, taken: BodyId) -> Self {
        let mut loads = loads(world);
        loads.retain(|pair, load| *load >= BEARS && pair.above != taken && pair.below != Some(taken));
        Self { taken, loads, lost: BTreeMap::new() }
    }

    /// Block that is being taken.
    pub fn taken(&self) -> BodyId {
        self.taken
    }

    /// Takes in the end of a frame.
    pub fn observe(&mut self, world: &World) {
        let now = loads(world);
        for pair in self.loads.keys() {
            if now.get(pair).is_some_and(|load| *load >= LOST) {
                self.lost.remove(pair);
            } else {
                self.lost.entry(*pair).or_insert_with(|| world.time());
            }
        }
    }

    /// The contact that was lost first and did not bear again; of those lost in one frame the one
    /// with the largest load. None where none was lost.
    pub fn first_lost(&self) -> Option<LostContact> {
        let lost = self.lost.iter().map(|(pair, time_s)| LostContact {
            above: pair.above,
            below: pair.below,
            load_n: self.loads[pair],
            time_s: *time_s,
        });
        lost.min_by(|a, b| a.time_s.total_cmp(&b.time_s).then(b.load_n.total_cmp(&a.load_n)))
    }
}

/// Loads between blocks and their bearers, N.
fn loads(world: &World) -> BTreeMap<Pair, f64> {
    let mut loads = BTreeMap::new();
    for above in world.bodies() {
        for contact in world.contacts(above) {
            if contact.normal.z > MIN_VERTICAL {
                *loads.entry(Pair { above, below: contact.other }).or_insert(0.0) += contact.force;
            }
        }
    }
    loads
}
