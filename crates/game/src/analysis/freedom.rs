//! Freedom that a tower leaves the next player: how many blocks can still be taken, and how
//! easily.

use std::collections::BTreeMap;

use teeter_physics::{BodyId, World};
use teeter_study::xray;

use crate::blocks::Blocks;
use crate::rules::removable::Removal;
use crate::rules::table::Rules;
use crate::tower_map::TowerMap;

/// Breakaway force at which a block counts half, N.
const HALF_TIGHT: f64 = 0.2;

/// Weight of a block by the force that starts it sliding, N: from 0, tight, to 1, without friction.
pub fn looseness(tightness_n: f64) -> f64 {
    HALF_TIGHT / (HALF_TIGHT + tightness_n)
}

/// Returns the sum over the blocks that may be taken, and whose row stands without them, of their
/// `looseness`.
pub fn freedom(world: &World, rules: &Rules) -> f64 {
    let blocks = Blocks::of(world);
    let cells = TowerMap::new(&blocks, None).cells();
    let mut rows: BTreeMap<u32, Vec<(BodyId, u32)>> = BTreeMap::new();
    for (body, id) in cells {
        rows.entry(id.row).or_default().push((body, id.cell));
    }
    let loads = xray(world, world.scene().friction);
    let removable = Removal::new(&blocks, rules.source, None).blocks(&blocks);
    let stands = |body: BodyId| {
        let row = rows.values().find(|row| row.iter().any(|(other, _)| *other == body));
        row.is_none_or(|row| {
            let is_left = |cell: u32| row.iter().any(|(other, at)| *other != body && *at == cell);
            is_left(1) || (is_left(0) && is_left(2))
        })
    };
    let weight = |body: &BodyId| looseness(loads[body.index()].tightness_n);
    removable.iter().filter(|body| stands(**body)).map(weight).sum()
}

#[cfg(test)]
mod tests {
    use teeter_physics::Params;
    use teeter_scene::TowerOptions;

    use super::*;
    use crate::rules::table::Table;

    fn of(config: &str) -> f64 {
        let scene = teeter_scene::config(config, &TowerOptions::exact()).unwrap();
        let world = teeter_study::settled(&scene, Params::default()).unwrap();
        freedom(&world, &Rules::of(Table::Official, 2))
    }

    #[test]
    fn rows_that_are_down_to_what_bears_them_leave_no_freedom() {
        assert_eq!(of("(010)-(101)-(111)"), 0.0);
        assert!(of("(011)-(101)-(111)") > 0.0);
    }

    #[test]
    fn more_blocks_that_can_be_taken_leave_more() {
        assert!(of("(111)-(111)-(111)") > of("(110)-(111)-(111)"));
        assert!(of("(110)-(111)-(111)") > of("(110)-(101)-(111)"));
    }
}
