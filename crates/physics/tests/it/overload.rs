//! Overload: contacts that cannot carry the weight on them are refused, with what would do; all
//! others hold.

use crate::common::*;
use proptest::prelude::*;
use teeter_physics::{BuildError, World};
use teeter_scene::{Block, Scene};

/// Largest depth of a contact over the smallest edge of all blocks, while what touches settles for
/// 1 s.
fn worst_depth(scene: &Scene) -> f64 {
    let mut world = World::new(scene, awake()).unwrap();
    let edge = scene.blocks.iter().flat_map(|block| block.size).fold(f64::INFINITY, f64::min);
    (0..60).map(|_| world.step(&teeter_physics::Input::default()).penetration / edge).fold(0.0, f64::max)
}

/// Stack of boxes, each an edge length (m), a height (m) and a mass (kg), from below.
fn stack(boxes: &[(f64, f64, f64)], stiffness: f64, gravity: f64) -> Scene {
    let mut top = 0.0;
    let blocks = boxes.iter().enumerate().map(|(id, &(edge, height, mass))| {
        top += height;
        Block::new(id as u32, [edge, edge, height], mass, [0.0, 0.0, top - 0.5 * height])
    });
    Scene { blocks: blocks.collect(), stiffness, gravity, ..one() }
}

/// A scene that holds, or is refused and holds with the stiffness that the error names.
fn holds_or_is_refused(mut scene: Scene) -> Result<(), TestCaseError> {
    if let Err(error) = World::new(&scene, awake()) {
        let BuildError::Overload { stiffness, .. } = error else { panic!("{error}") };
        prop_assert!(stiffness > scene.stiffness, "{error}");
        if stiffness > 1e8 {
            return Ok(());
        }
        scene.stiffness = 1.001 * stiffness;
    }
    let depth = worst_depth(&scene);
    prop_assert!(depth < 0.2, "a block sinks by {depth} of an edge at {} N/m", scene.stiffness);
    Ok(())
}

fn power(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (libm::log(low)..libm::log(high)).prop_map(libm::exp)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn heavy_blocks_on_soft_contacts_hold(edge in power(0.02, 1.0), density in power(300.0, 3e6), gravity in 1.0..100.0f64) {
        let mass = (density * edge * edge * edge).min(1e4);
        holds_or_is_refused(stack(&[(edge, edge, mass)], 1e4, gravity))?;
    }

    #[test]
    fn stacks_of_heavy_blocks_hold(
        edge in power(0.02, 1.0),
        density in power(1e3, 1e5),
        count in 2..8usize,
        stiffness in power(1e4, 1e7),
    ) {
        let mass = (density * edge * edge * edge).min(1e4);
        holds_or_is_refused(stack(&vec![(edge, edge, mass); count], stiffness, G))?;
    }

    #[test]
    fn big_blocks_on_small_ones_hold(small in power(0.01, 0.1), ratio in 1.0..5.0f64, mass in power(0.01, 1e4), stiffness in power(1e4, 1e7)) {
        let light = 500.0 * small * small * small;
        let boxes = [(small, small, light), (ratio * small, 0.5 * small, mass)];
        holds_or_is_refused(stack(&boxes, stiffness, G))?;
    }
}

#[test]
fn an_overload_names_the_block_its_load_and_the_stiffness_that_would_do() {
    let scene = stack(&[(0.1, 0.02, 0.1), (0.01, 0.01, 1000.0)], 1e6, G);
    let error = World::new(&scene, awake()).unwrap_err().to_string();
    let expected = "block 1: 9.8e3 N rest on block 0, and the contact would give by ";
    assert!(error.starts_with(expected) && error.contains("expected a `stiffness` of at least "), "{error}");
}

#[test]
fn a_block_that_would_sink_into_the_floor_where_it_lands_is_refused() {
    let mut scene = stack(&[(0.01, 0.01, 1000.0)], 1e5, G);
    scene.blocks[0].pos[2] = 1.0;
    assert!(matches!(World::new(&scene, awake()), Err(BuildError::Overload { id: 0, .. })));
}

#[test]
fn a_load_just_below_the_limit_gives_by_what_is_said() {
    // 26.8 mm square, k = 1e4 N/m: a tenth of an edge is 26.8 N.
    let scene = |mass| stack(&[(0.0268, 0.0268, mass)], 1e4, G);
    let depth = worst_depth(&scene(26.6 / G));
    assert!((depth / 0.1 - 26.6 / 26.8).abs() < 0.02, "{depth}");
    assert!(World::new(&scene(27.0 / G), awake()).is_err());
}

#[test]
fn a_long_thin_rod_lies_as_firmly_at_an_angle_as_along_an_axis() {
    let depth = |yaw: f64| {
        let rod = Block { yaw, ..Block::new(0, [10.0, 5e-4, 5e-4], 0.1, [0.0, 0.0, 2.5e-4]) };
        let mut world = World::new(&Scene { blocks: vec![rod], ..one() }, awake()).unwrap();
        run(&mut world, 0.5, &teeter_physics::Input::default());
        2.5e-4 - position(&world, 0).z
    };
    let along = depth(0.0);
    for yaw in [0.1, std::f64::consts::FRAC_PI_4, 1.0] {
        assert!(depth(yaw) < 2.0 * along + 1e-9, "{} at {yaw}, {along} along x", depth(yaw));
    }
}
