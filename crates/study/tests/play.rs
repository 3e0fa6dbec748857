//! What a hand and an arm do to a tower, in cases of which the outcome is beyond doubt.

use glam::DVec3;
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{Block, TowerOptions, config, loose, named};
use teeter_study::{extract, legal, let_go, remove, rest, settled, yank};

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
fn a_block_let_go_comes_to_rest_on_top() {
    let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
    let block = Block { id: 99, pos: [0.0, 0.0, 0.036 + 0.009 + 0.03], ..scene.blocks[0].clone() };
    scene.blocks.push(block);
    let placed = let_go(World::new(&scene, params()).unwrap(), BodyId(6), 0.01);
    assert!(placed.stays && placed.others_mm > 0.001 && placed.others_mm < 1.0, "{placed:?}");
    // 1 cm takes 45 ms, and some bounces come after
    assert!(placed.rest_s.is_some_and(|t| t > 0.045 && t < 2.0), "{placed:?}");
}

#[test]
fn a_bottom_block_that_bears_alone_cannot_be_taken() {
    let scene = config("(010)-(111)-(111)", &TowerOptions::exact()).unwrap();
    assert_eq!(legal(&scene).len(), 3);
    let gone = remove(&scene, 0, params()).unwrap();
    assert!(gone.fell && gone.exact_fell == Some(true), "{gone:?}");
    let full = config("(111)-(111)-(111)", &TowerOptions::exact()).unwrap();
    let gone = remove(&full, 1, params()).unwrap();
    assert!(!gone.fell && gone.exact_fell == Some(false) && gone.creep_mm < 1e-4, "{gone:?}");
}

/// The row is drawn as slowly as drags along what lies on it; at 3 m/s that comes straight down by a row.
#[test]
fn a_torn_tower_ends_as_a_heap_of_solid_blocks() {
    let world = settled(&named("loose").unwrap(), Params { frame: 1.0 / 240.0, ..params() }).unwrap();
    let torn = yank(&world, &[3, 4, 5].map(BodyId), DVec3::new(1.0, 0.0, 0.0), 2.0);
    assert!(torn.moved > 12 && !torn.lost && !torn.through && torn.lasting_s < 0.02, "{torn:?}");
    assert!(torn.quiet_s.is_some(), "{torn:?}");
}

#[test]
fn a_tower_rests() {
    let scene = named("test-6").unwrap();
    let seen = rest(settled(&scene, params()).unwrap(), 20.0, scene.gravity, || ());
    assert!(seen.creep_m < 1e-8 && seen.kinetic_j < 1e-12 && seen.potential_j < 1e-9, "{seen:?}");
}
