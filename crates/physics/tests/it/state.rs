//! State: snapshots continue bit for bit, sleep does not decide stability, constants out of range
//! are refused.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{BodyId, BuildError, Drive, Input, Params, Precision, Twist, World};
use teeter_scene::{Block, Scene, TowerOptions, tower};

fn small(seed: u64) -> Scene {
    tower(&TowerOptions { rows: 6, seed, ..TowerOptions::default() }).unwrap()
}

/// Violent input, so that all of the state is in use.
fn violent(i: u32) -> Input {
    let drive = Drive { body: BodyId(4), velocity: DVec3::new(1.0, 1.0, 0.0), max_force: 50.0 };
    Input { drives: if (40..50).contains(&i) { vec![drive] } else { Vec::new() }, ..Input::default() }
}

#[test]
fn a_restored_snapshot_continues_bit_for_bit() {
    for precision in [Precision::Single, Precision::Double] {
        let params = Params { precision, ..Params::default() };
        let mut world = World::new(&small(3), params).unwrap();
        for at in [0, 17, 45, 60] {
            let mut world = World::new(&small(3), params).unwrap();
            (0..at).for_each(|i| drop(world.step(&violent(i))));
            let bytes = world.snapshot();
            let mut other = World::new(&small(3), params).unwrap();
            other.restore(&bytes).unwrap();
            assert_eq!(other.hash(), world.hash());
            for i in at..at + 30 {
                assert_eq!(world.step(&violent(i)), other.step(&violent(i)));
            }
            assert_eq!(world.hash(), other.hash());
            assert_eq!(world.poses(), other.poses());
        }
        let before = world.hash();
        assert!(world.restore(b"something else").is_err());
        let stranger = World::new(&one(), params).unwrap().snapshot();
        let message = world.restore(&stranger).unwrap_err().to_string();
        assert!(message.contains("1 bodies instead of 18"), "{message}");
        let bytes = world.snapshot();
        assert!(world.restore(&bytes[..bytes.len() - 3]).is_err());
        assert_eq!(world.hash(), before);
    }
}

#[test]
fn the_same_inputs_give_the_same_hash() {
    let hash = || {
        let mut world = World::new(&small(5), Params::default()).unwrap();
        (0..90).for_each(|i| drop(world.step(&violent(i))));
        world.hash()
    };
    assert_eq!(hash(), hash());
}

#[test]
fn a_tower_at_rest_sleeps_and_a_touch_wakes_it() {
    let mut world = World::new(&small(3), Params::default()).unwrap();
    let report = run(&mut world, 3.0, &Input::default());
    assert_eq!(report.awake, 0);
    let before = poses(&world);
    assert_eq!(run(&mut world, 1.0, &Input::default()).awake, 0);
    assert_eq!(poses(&world), before);
    assert_eq!(world.step(&violent(45)).awake, 18);
    // It falls like a tower that never slept.
    run(&mut world, 0.3, &violent(45));
    assert!(displacement(&before, &world) > 0.05);
}

#[test]
fn a_sleeping_block_wakes_when_its_support_is_removed() {
    let mut world = World::new(&column(3), Params::default()).unwrap();
    run(&mut world, 3.0, &Input::default());
    assert!((0..3).all(|i| world.is_asleep(BodyId(i))));
    let pull = Drive { body: BodyId(0), velocity: DVec3::new(5.0, 0.0, 0.0), max_force: 100.0 };
    run(&mut world, 0.1, &Input::drives(vec![pull]));
    run(&mut world, 1.0, &Input::default());
    assert!(position(&world, 1).z < 0.012, "it hangs in the air");
}

#[test]
fn neighbours_that_do_not_touch_let_each_other_sleep() {
    let mut world =
        World::new(&blocks(&[[0.0, 0.0, 0.009], [0.0, 0.026803, 0.009], [0.0, -0.026803, 0.009]]), Params::default())
            .unwrap();
    run(&mut world, 0.5, &Input::default());
    // One comes to rest later than the others.
    world.set_twist(BodyId(0), Twist::linear(DVec3::new(0.05, 0.0, 0.0)));
    let report = run(&mut world, 3.0, &Input::default());
    assert_eq!(report.awake, 0);
}

#[test]
fn sleep_never_stops_a_slow_fall() {
    // A block on its end, out of balance by 10 um at the top, stays below 0.05 m/s for most of a
    // second.
    let half = 0.0405;
    let scene =
        Scene { blocks: vec![teeter_scene::Block::new(0, [0.002, 0.0268, 0.081], 0.002, [0.0, 0.0, half])], ..one() };
    let mut world = World::new(&scene, Params::default()).unwrap();
    // Slightly beyond the edge of its base.
    let lean = 0.001 / half + 2e-4;
    world.set_orientation(BodyId(0), glam::DQuat::from_xyzw(0.0, lean / 2.0, 0.0, 1.0));
    run(&mut world, 6.0, &Input::default());
    assert!(position(&world, 0).z < 0.01, "it still stands, at {} m", position(&world, 0).z);
}

#[test]
fn a_collapsed_tower_comes_to_rest() {
    let mut world = World::new(&tower(&TowerOptions::default()).unwrap(), awake()).unwrap();
    run(&mut world, 1.0, &Input::default());
    let drive = |body| Drive { body: BodyId(body), velocity: DVec3::new(2.0, 0.5, 0.0), max_force: 100.0 };
    run(&mut world, 0.2, &Input { drives: (6..12).map(drive).collect(), ..Input::default() });
    let report = run(&mut world, 3.0, &Input::default());
    assert!(report.rms_speed < 1e-3, "the pile still moves with {} m/s", report.rms_speed);
    assert!(report.penetration < 1e-3);
    assert!((0..world.len()).all(|i| position(&world, i).z > 0.005), "a block is in the floor");
}

#[test]
fn constants_out_of_range_are_refused_by_name() {
    let refuse = |params: Params| World::new(&one(), params).unwrap_err();
    for (params, field) in [
        (Params { ramp: -1.0, ..Params::default() }, "ramp"),
        (Params { ramp: f64::NAN, ..Params::default() }, "ramp"),
        (Params { frame: 0.0, ..Params::default() }, "frame"),
    ] {
        let error = refuse(params);
        assert!(matches!(error, BuildError::Param { field: f, .. } if f == field), "{error}");
        assert!(error.to_string().contains("expected"));
    }
    for stiffness in [1e3, f64::NAN] {
        let error = World::new(&Scene { stiffness, ..one() }, Params::default()).unwrap_err().to_string();
        assert_eq!(error, format!("`stiffness` is {stiffness}, expected 1e4 to 1e8 N/m"));
    }
}

/// Three times the stiffness gives a third of the sag, in substeps shorter by its root; the
/// snapshot does not contain the stiffness.
#[test]
fn stiffness_is_that_of_the_scene() {
    let settled = |stiffness: f64| {
        let mut world = World::new(&Scene { stiffness, ..column(3) }, awake()).unwrap();
        run(&mut world, 2.0, &Input::default());
        let sink = 0.045 - position(&world, 2).z;
        (world, sink)
    };
    let ((soft, deep), (stiff, shallow)) = (settled(1e6), settled(3e6));
    assert_eq!((soft.stiffness(), stiff.stiffness()), (1e6, 3e6));
    assert!((deep / shallow - 3.0).abs() < 0.05, "{deep} and {shallow} m");
    assert!((soft.substep() / stiff.substep() - 3.0f64.sqrt()).abs() < 0.1);
    assert_ne!(soft.hash(), stiff.hash());
}

#[test]
fn a_scene_that_would_step_for_ever_is_refused_with_the_mass_that_would_do() {
    let light = |mass: f64| Scene { blocks: vec![Block { mass, ..one().blocks[0].clone() }], ..one() };
    let error = World::new(&light(1e-12), awake()).unwrap_err();
    let BuildError::Substeps { min_mass, .. } = error else { panic!("{error}") };
    assert!(World::new(&light(1.01 * min_mass), awake()).is_ok());
    let message = error.to_string();
    assert!(message.starts_with("block 0: `mass` is 1.0e-12 kg"), "{message}");
    // a fixed block never moves, so its mass is of no account
    let mut fixed = light(1e-12);
    fixed.blocks[0].fixed = true;
    assert!(World::new(&fixed, awake()).is_ok());
}
