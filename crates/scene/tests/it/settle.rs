//! Blocks pushed apart: no overlap is left, and blocks move no more than they must.

use proptest::prelude::*;
use teeter_scene::{Block, Scene, SceneError, TowerOptions, named, overlap, settle, tower};

const SIZE: [f64; 3] = [0.081, 0.0268, 0.018];

fn scene(blocks: Vec<Block>) -> Scene {
    Scene { blocks, ..named("block").unwrap() }
}

fn block(id: u32, pos: [f64; 3]) -> Block {
    Block::new(id, SIZE, 0.0196, pos)
}

/// Deepest overlap of two blocks, m, and depth of the lowest point in the floor, m.
fn depths(scene: &Scene) -> (f64, f64) {
    let deepest = overlap::pairs(scene, 0.0).iter().map(|pair| pair.depth).fold(0.0, f64::max);
    let lowest = scene.blocks.iter().map(|b| overlap::lowest_point(b, scene.edge_radius)).fold(0.0, f64::min);
    (deepest, -lowest)
}

#[test]
fn a_scene_without_overlaps_is_left_as_it_is() {
    for mut scene in [tower(&TowerOptions::default()).unwrap(), named("midgame").unwrap(), named("pile").unwrap()] {
        let before = scene.clone();
        assert!(settle(&mut scene).unwrap().moves.is_empty());
        assert_eq!(scene, before);
    }
}

/// Each row of a tower that is 0.2 mm too low lifts all above it.
#[test]
fn a_tower_grows_upwards() {
    let exact = tower(&TowerOptions::exact()).unwrap();
    let mut low = exact.clone();
    low.blocks.iter_mut().for_each(|block| block.pos[2] -= 2e-4 * (block.pos[2] / 0.018).floor());
    let settlement = settle(&mut low).unwrap();
    // the bottom row stays
    assert_eq!(settlement.moves.len(), 51);
    assert!((settlement.max_distance() - 17.0 * 2e-4).abs() < 1e-9);
    assert_eq!(settlement.to_string(), "pushed 51 blocks apart, by up to 3.4 mm");
    for (a, b) in low.blocks.iter().zip(&exact.blocks) {
        assert!((0..3).all(|k| (a.pos[k] - b.pos[k]).abs() < 1e-9), "{a:?} {b:?}");
    }
}

#[test]
fn a_row_spreads_about_its_centre_of_mass() {
    let pitch = SIZE[1] - 3e-4;
    let mut row = scene((0..5).map(|i| block(i, [0.0, pitch * f64::from(i), 0.009])).collect());
    let settlement = settle(&mut row).unwrap();
    // the outer ones by two overlaps each
    assert!((settlement.max_distance() - 2.0 * 3e-4).abs() < 1e-5, "{}", settlement.max_distance());
    let centre = |scene: &Scene| scene.blocks.iter().map(|b| b.pos[1]).sum::<f64>() / 5.0;
    assert!((centre(&row) - 2.0 * pitch).abs() < 1e-12);
    assert!(depths(&row).0 <= 1e-6);
}

#[test]
fn a_block_leaves_the_floor_and_fixed_blocks_stay() {
    let wall = Block { fixed: true, ..block(0, [0.0, 0.0, 0.009]) };
    let mut scene = scene(vec![wall.clone(), block(1, [0.0, SIZE[1] - 1e-3, 0.008])]);
    let settlement = settle(&mut scene).unwrap();
    assert_eq!(scene.blocks[0], wall);
    let pos = scene.blocks[1].pos;
    assert!((pos[1] - SIZE[1]).abs() < 1e-12 && (pos[2] - 0.009).abs() < 1e-12, "{pos:?}");
    assert!((settlement.moves[0].distance - 2f64.sqrt() * 1e-3).abs() < 1e-9);
}

/// A wedged block cannot be helped: the overlap is named.
#[test]
fn blocks_between_fixed_ones_are_refused() {
    let wall = |id, y| Block { fixed: true, ..block(id, [0.0, y, 0.009]) };
    let gap = 2.0 * SIZE[1] - 1e-3;
    let mut scene = scene(vec![wall(0, 0.0), wall(1, gap), block(2, [0.0, 0.5 * gap, 0.009])]);
    let error = settle(&mut scene).unwrap_err();
    assert!(
        matches!(error, SceneError::Overlap { a: 0, b: 2, .. } | SceneError::Overlap { a: 1, b: 2, .. }),
        "{error}"
    );
}

fn any_block(id: u32) -> impl Strategy<Value = Block> {
    let pos = [-0.03..0.03, -0.03..0.03, 0.0..0.1];
    let turn = [-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.1..1.0];
    (pos, turn, 0.01..0.1, any::<bool>()).prop_map(move |(pos, q, mass, upright)| {
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let orientation = (!upright).then(|| q.map(|x| x / length));
        Block { mass, orientation, ..block(id, pos) }
    })
}

proptest! {
    /// Heaps of blocks in any orientation, deep inside each other and in the floor.
    #[test]
    fn no_overlap_is_left(mut blocks in proptest::collection::vec(any_block(0), 1..9), edge_radius in prop_oneof![Just(0.0), 1e-4..3e-3]) {
        (0..).zip(&mut blocks).for_each(|(id, block)| block.id = id);
        let mut heap = Scene { edge_radius, ..scene(blocks) };
        let mut again = heap.clone();
        let settlement = settle(&mut heap).unwrap();
        let (overlap, floor) = depths(&heap);
        prop_assert!(overlap <= 1e-6 && floor <= 1e-6, "{overlap} {floor}");
        prop_assert_eq!(settle(&mut again).unwrap(), settlement);
        prop_assert_eq!(again, heap);
    }
}
