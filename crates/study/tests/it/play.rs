//! Extraction, removal, drop, collapse and long rest, in cases with a certain outcome.

use glam::DVec3;
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{Block, TowerOptions, config, loose, named, tower};
use teeter_study::{
    PutBackOptions, collapse, drop_block, extract, long_rest, put_back, removable_blocks, remove, settled, xray,
};

fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}

#[test]
fn a_loose_block_comes_out_and_a_tight_one_does_not() {
    let scene = loose("(000)-(0L0)-(000)-(000)", &TowerOptions::exact()).unwrap();
    let world = settled(&scene, params()).unwrap();
    let taken = extract(&world, BodyId(4), DVec3::Y, 0.05);
    assert!(taken.out && !taken.fell && taken.others_mm < 0.2, "{taken:?}");
    assert!(taken.force_n > 0.4 * 0.0196 * 9.81 && taken.force_n < 0.3, "{taken:?}");
    let heavy = {
        let mut scene = scene.clone();
        scene.blocks[7].mass = 2.0;
        scene
    };
    let stuck = extract(&settled(&heavy, params()).unwrap(), BodyId(3), DVec3::Y, 0.05);
    assert!(!stuck.out && stuck.force_n > 3.9, "{stuck:?}");
}

#[test]
fn a_dropped_block_comes_to_rest_on_top() {
    let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
    let block = Block { id: 99, pos: [0.0, 0.0, 0.036 + 0.009 + 0.03], ..scene.blocks[0].clone() };
    scene.blocks.push(block);
    let placed = drop_block(World::new(&scene, params()).unwrap(), BodyId(6), 0.01);
    assert!(placed.stays && placed.others_mm > 0.001 && placed.others_mm < 1.0, "{placed:?}");
    // a fall of 1 cm takes 45 ms, and some bounces follow
    assert!(placed.rest_s.is_some_and(|t| t > 0.045 && t < 2.0), "{placed:?}");
}

#[test]
fn a_tower_falls_without_a_block_that_bears_alone() {
    let scene = config("(010)-(111)-(111)", &TowerOptions::exact()).unwrap();
    assert_eq!(removable_blocks(&scene).len(), 3);
    let gone = remove(&scene, 0, params()).unwrap();
    assert!(gone.fell && gone.exact_fell == Some(true), "{gone:?}");
    let full = config("(111)-(111)-(111)", &TowerOptions::exact()).unwrap();
    let gone = remove(&full, 1, params()).unwrap();
    assert!(!gone.fell && gone.exact_fell == Some(false) && gone.creep_mm < 1e-4, "{gone:?}");
}

/// At 1 m/s the row drags along the blocks above it; at 3 m/s they would fall straight by a row.
#[test]
fn a_collapsed_tower_ends_as_a_pile_without_penetration() {
    let world = settled(&named("loose").unwrap(), Params { frame: 1.0 / 240.0, ..params() }).unwrap();
    let torn = collapse(&world, &[3, 4, 5].map(BodyId), DVec3::new(1.0, 0.0, 0.0), 2.0);
    assert!(torn.moved > 12 && !torn.lost && !torn.through && torn.lasting_s < 0.02, "{torn:?}");
    assert!(torn.quiet_s.is_some(), "{torn:?}");
}

#[test]
fn a_tower_at_rest_does_not_creep() {
    let scene = named("test-6").unwrap();
    let record = long_rest(settled(&scene, params()).unwrap(), 20.0, scene.gravity, || ());
    assert!(record.creep_m < 1e-8 && record.kinetic_j < 1e-12 && record.potential_j < 1e-9, "{record:?}");
}

#[test]
fn a_loose_block_that_is_put_back_leaves_the_others_where_they_were() {
    let scene = tower(&TowerOptions { rows: 9, ..TowerOptions::default() }).unwrap();
    let world = settled(&scene, params()).unwrap();
    let loads = xray(&world, scene.friction);
    let body = world.bodies().find(|body| loads[body.index()].is_loose()).expect("a tower has loose blocks");
    for distance in [0.01, 0.02] {
        let back = put_back(&world, body, distance, &PutBackOptions::default());
        assert!(back.out && (back.moved_1_mm, back.moved_5_mm, back.fell) == (0, 0, 0), "{back:?}");
        assert!(back.worst_mm < 0.2 && back.aside_mm < 1.0, "{back:?}");
        // friction of its own weight, of which the hand carries four fifths meanwhile
        let weight = scene.blocks[body.index()].mass * scene.gravity;
        assert!(back.force_n > 0.15 * scene.friction * weight && back.force_n < 4.0, "{back:?}");
    }
}

#[test]
fn a_block_does_not_wedge_under_one_a_hundredth_of_a_millimetre_above_it() {
    for (seed, height_sd, body) in [(15, 1e-4, 46), (1, 3e-5, 47)] {
        let world = settled(&tower(&TowerOptions { seed, height_sd, ..TowerOptions::default() }).unwrap(), params());
        let back = put_back(&world.unwrap(), BodyId(body), 0.06, &PutBackOptions::default());
        assert!(back.out && back.worst_mm < 0.2 && back.aside_mm < 1.0, "seed {seed}: {back:?}");
    }
}

#[test]
fn a_tight_block_does_not_come_out_to_be_put_back() {
    let mut scene = config("(111)-(010)-(111)", &TowerOptions::exact()).unwrap();
    scene.blocks[5].mass = 5.0;
    let back = put_back(&settled(&scene, params()).unwrap(), BodyId(3), 0.02, &PutBackOptions::default());
    assert!(!back.out && back.force_n > 1.0, "{back:?}");
}
