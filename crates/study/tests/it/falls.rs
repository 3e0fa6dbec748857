//! Fallen or not, for blocks from 2 mm to a metre: towers that stand, sink, topple and lose a
//! support.

use glam::DVec3;
use proptest::prelude::*;
use teeter_physics::{BodyId, Drive, Input, Params, World};
use teeter_scene::{Block, BlockPreset, Scene, TowerOptions, config, named, tower};
use teeter_study::{Cuboid, Footing};

fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}

/// Scene of blocks of one size (m) and one mass (kg), by their centres.
fn scene(size: [f64; 3], mass: f64, centers: impl IntoIterator<Item = [f64; 3]>) -> Scene {
    let blocks = (0..).zip(centers).map(|(id, pos)| Block::new(id, size, mass, pos)).collect();
    Scene { blocks, friction: 0.5, ..named("block").expect("the list has it") }
}

/// Centres of a pile of blocks of one height (m), each shifted along x against the one below, m.
fn pile(height: f64, shifts: &[f64]) -> Vec<[f64; 3]> {
    let mut x = 0.0;
    let center = |(row, shift): (usize, &f64)| {
        x += shift;
        [x, 0.0, (row as f64 + 0.5) * height]
    };
    shifts.iter().enumerate().map(center).collect()
}

/// Indices of the blocks that fall within some seconds.
fn fallen(scene: &Scene, seconds: f64) -> Vec<usize> {
    let mut world = World::new(scene, params()).expect("the scene is valid");
    let footing = Footing::of_scene(scene);
    let mut fallen = vec![false; world.len()];
    for _ in 0..world.frames(seconds) {
        assert!(world.step(&Input::default()).quarantined.is_empty());
        footing.mark_fallen(&Cuboid::all(&world), |_| false, &mut fallen);
    }
    (0..fallen.len()).filter(|&body| fallen[body]).collect()
}

fn nothing() -> Vec<usize> {
    Vec::new()
}

#[test]
fn a_cubic_metre_of_concrete_that_sinks_into_its_contacts_stands() {
    let stone = scene([1.0; 3], 2400.0, [[0.0, 0.0, 0.5]]);
    assert_eq!(fallen(&stone, 3.0), nothing());
}

#[test]
fn a_column_of_forty_bricks_that_sinks_stands() {
    let bricks = scene([0.215, 0.1025, 0.065], 2.3, pile(0.065, &[0.0; 40]));
    assert_eq!(fallen(&bricks, 3.0), nothing());
}

#[test]
fn a_block_of_3_mm_topples_when_it_overhangs_by_more_than_half() {
    let small = |overhang: f64| scene([0.003, 0.003, 0.001], 2e-5, pile(0.001, &[0.0, overhang]));
    assert_eq!(fallen(&small(0.0014), 2.0), nothing());
    assert_eq!(fallen(&small(0.0016), 2.0), [1]);
}

#[test]
fn a_cube_of_2_mm_topples_when_it_overhangs_by_more_than_half() {
    let cubes = |overhang: f64| scene([0.002; 3], 1e-5, pile(0.002, &[0.0, overhang]));
    assert_eq!(fallen(&cubes(0.0009), 2.0), nothing());
    assert_eq!(fallen(&cubes(0.00106), 2.0), [1]);
}

#[test]
fn a_thin_card_that_tips_over_the_edge_of_its_pile_has_fallen() {
    let cards = |shift: f64| scene([0.094, 0.064, 0.0007], 0.002, pile(0.0007, &[0.0, 0.0, 0.0, shift]));
    assert_eq!(fallen(&cards(0.044), 3.0), nothing());
    assert_eq!(fallen(&cards(0.050), 3.0), [3]);
}

#[test]
fn a_tower_on_soft_contacts_sinks_by_more_than_a_sixth_of_a_block_and_stands() {
    let soft = Scene { stiffness: 1e4, ..tower(&TowerOptions { rows: 30, ..TowerOptions::default() }).unwrap() };
    let mut world = World::new(&soft, params()).unwrap();
    let footing = Footing::of_scene(&soft);
    let start = soft.blocks[89].pos[2];
    world.run_for(3.0);
    let sink = start - world.pose(BodyId(89)).position.z;
    assert!(sink > 0.003, "{sink} m");
    assert!(!footing.any_fallen(&world));
}

#[test]
fn the_blocks_above_one_that_is_drawn_out_fall_and_those_beside_it_do_not() {
    let scene = config("(111)-(010)-(111)-(010)", &TowerOptions::exact()).unwrap();
    let mut world = World::new(&scene, params()).unwrap();
    world.run_for(1.0);
    let footing = Footing::of(&world);
    let drawn = BodyId(3);
    let (drive, free) = (Input::drives(vec![Drive::new(drawn, DVec3::Y * 3.0)]), Input::default());
    let mut fallen = vec![false; world.len()];
    for frame in 0..world.frames(1.0) {
        world.step(if frame < 3 { &drive } else { &free });
        footing.mark_fallen(&Cuboid::all(&world), |body| body == drawn, &mut fallen);
    }
    assert_eq!(fallen, [false, false, false, false, true, true, true, true]);
}

#[test]
fn all_blocks_of_a_tower_that_topples_as_one_fall() {
    // each block stands on the one below, and all of them beyond the edge of the lowest
    let leaning = scene([0.081, 0.0268, 0.018], 0.0196, pile(0.018, &[0.0, 0.03, 0.03, 0.03]));
    assert_eq!(fallen(&leaning, 2.0), [1, 2, 3]);
}

#[test]
fn a_block_that_slides_on_the_floor_has_not_fallen() {
    let mut sliding = scene([0.081, 0.0268, 0.018], 0.0196, [[0.0, 0.0, 0.009]]);
    sliding.blocks[0].velocity = [0.5, 0.0, 0.0];
    let mut world = World::new(&sliding, params()).unwrap();
    let footing = Footing::of(&world);
    world.run_for(1.0);
    assert!(world.pose(BodyId(0)).position.x > 0.02);
    assert!(!footing.any_fallen(&world));
}

/// A pile of blocks scaled by `scale` in length.
fn scaled_pile(scale: f64, shifts: &[f64]) -> Scene {
    let preset = BlockPreset::Dissertation;
    let size = preset.size().map(|edge| edge * scale);
    let shifts: Vec<f64> = shifts.iter().map(|shift| shift * size[0]).collect();
    scene(size, preset.mass() * scale * scale * scale, pile(size[2], &shifts))
}

/// With the same gravity and density times grow with the root of a length.
#[test]
fn piles_of_any_size_stand_or_fall_alike() {
    for (shifts, expected) in [
        (vec![0.0, 0.45, 0.0], vec![2_usize; 0]),
        (vec![0.0, 0.54], vec![1]),
        (vec![0.0, 0.2, 0.2, 0.2, 0.2], vec![1, 2, 3, 4]),
        (vec![0.0; 12], vec![]),
    ] {
        for scale in [0.1, 0.3, 1.0, 4.0, 20.0_f64] {
            let fell = fallen(&scaled_pile(scale, &shifts), 2.0 * scale.sqrt());
            assert_eq!(fell.is_empty(), expected.is_empty(), "{shifts:?} at {scale}: {fell:?}");
        }
    }
}

/// Motion of a block: displacement over a block's height, rotation axis and angle.
fn motion() -> impl Strategy<Value = ([f64; 3], [f64; 3], f64)> {
    let three = |range: std::ops::Range<f64>| prop::array::uniform3(range);
    (three(-0.3..0.3), three(-1.0..1.0), -0.2..0.2_f64)
}

proptest! {
    /// The definition has no length: a picture of a fall is one at any scale.
    #[test]
    fn the_same_motions_are_falls_at_every_scale(
        motions in prop::collection::vec(motion(), 8), scale in 0.1..20.0_f64
    ) {
        let blocks = config("(111)-(011)-(111)", &TowerOptions::exact()).unwrap().blocks;
        let marks = |scale: f64| {
            let cuboid = |block: &Block| {
                let half = DVec3::from(block.size) * (0.5 * scale);
                let turn = glam::DQuat::from_array(block.rotation());
                let half_edges = glam::DMat3::from_quat(turn) * glam::DMat3::from_diagonal(half);
                Cuboid { center: DVec3::from(block.pos) * scale, half_edges }
            };
            let start: Vec<Cuboid> = blocks.iter().map(cuboid).collect();
            let moved = |(at, (by, axis, angle)): (&Cuboid, &([f64; 3], [f64; 3], f64))| {
                let axis = DVec3::from(*axis).normalize_or(DVec3::X);
                let turn = glam::DMat3::from_axis_angle(axis, *angle);
                Cuboid { center: at.center + DVec3::from(*by) * at.height(), half_edges: turn * at.half_edges }
            };
            let now: Vec<Cuboid> = start.iter().zip(&motions).map(moved).collect();
            let mut fallen = vec![false; start.len()];
            Footing::new(&start).mark_fallen(&now, |_| false, &mut fallen);
            fallen
        };
        prop_assert_eq!(marks(1.0), marks(scale));
    }
}
