//! Fast bodies: what has fallen, been struck or driven is no runaway, and no input harms a body
//! that it does not name.

use crate::common::*;
use glam::{DQuat, DVec3, Vec3Swizzles};
use proptest::prelude::*;
use teeter_physics::{AppliedForce, BodyId, Drive, EnergyBalance, Hand, Input, Params, Twist, World};
use teeter_scene::{Block, Form, Scene};

fn steps(world: &mut World, frames: usize) -> f64 {
    let mut fastest: f64 = 0.0;
    for frame in 0..frames {
        let report = world.step(&Input::default());
        assert_eq!(report.quarantined, [], "frame {frame}: {report:?}");
        fastest = fastest.max(report.max_speed);
    }
    fastest
}

/// A ruler that falls on a block.
fn ruler(size: [f64; 3], mass: f64, pos: [f64; 3], yaw: f64) -> Scene {
    let mut scene = one();
    scene.blocks.push(Block { id: 2, size, mass, pos, yaw, ..scene.blocks[0].clone() });
    scene
}

#[test]
fn a_ruler_that_spins_about_its_length_is_no_runaway() {
    let scene = ruler([1.0, 0.02, 0.003], 0.036, [0.01, 0.0169, 0.5195], 0.84);
    let mut world = World::new(&scene, Params::default()).unwrap();
    // it falls 0.5 m, so nothing is faster than 3.13 m/s by much
    assert!(steps(&mut world, 180) < 4.0);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_ruler_dropped_on_a_block_is_a_runaway(
        x in -0.4..0.4f64, y in -0.02..0.02f64, yaw in -3.0..3.0f64,
        length in 0.3..2.0f64, width in 0.01..0.04f64, thickness in 0.001..0.005f64, density in 300.0..900.0f64,
    ) {
        let size = [length, width, thickness];
        let mass = density * size.iter().product::<f64>();
        let mut world = World::new(&ruler(size, mass, [x, y, 0.52], yaw), Params::default()).unwrap();
        steps(&mut world, 150);
    }
}

/// Part of its energy that a ruler which falls on a block and the floor gains in the worst frame.
fn gain(size: [f64; 3], density: f64, pos: [f64; 3], yaw: f64) -> f64 {
    let mass = density * size.iter().product::<f64>();
    let mut world = World::new(&ruler(size, mass, pos, yaw), Params::default()).unwrap();
    let start = world.energy().total();
    let mut balance = EnergyBalance::new(&world);
    for _ in 0..150 {
        let report = world.step(&Input::default());
        balance.record(&world, &report);
    }
    balance.worst_gain() / start
}

#[test]
fn a_ruler_that_meets_the_floor_with_an_end_gains_no_energy() {
    // Friction at another height than that of the end would twist it about its length, up to 40
    // times the energy of its fall.
    for (size, density, x, y, yaw) in [
        ([1.0025, 0.01102, 0.00368], 300.0, 0.0472, 0.0198, 0.997),
        ([1.0824, 0.01593, 0.00114], 577.0, 0.1064, -0.0148, 2.903),
        ([0.9890, 0.01523, 0.00404], 639.0, 0.0352, -0.0106, -0.648),
        ([1.6630, 0.01427, 0.00237], 823.0, 0.0152, -0.0091, 2.781),
        ([1.6604, 0.01283, 0.00338], 474.0, -0.1112, -0.0130, 0.166),
        ([0.6041, 0.01303, 0.00296], 844.0, 0.0758, 0.0184, 0.470),
    ] {
        for shift in [-2e-3, -1e-3, 0.0, 1e-3, 2e-3] {
            let gain = gain(size, density, [x + shift, y, 0.52], yaw);
            assert!(gain < 1e-3, "{size:?} at {x} + {shift}: {gain:e}");
        }
    }
}

#[test]
fn a_fall_of_two_kilometres_is_no_runaway() {
    for form in [Form::Rigid, Form::Lattice] {
        let mut scene = one();
        scene.form = form;
        scene.blocks[0].pos[2] = 900.0;
        scene.blocks[0].velocity = [0.0, 0.0, 100.0];
        let mut world = World::new(&scene, Params::default()).unwrap();
        let frames = (60.0 * 27.0) as usize;
        let fastest = steps(&mut world, frames);
        // energy: v² = 100² + 2 g h, and it is near the floor after 27 s
        let height = position(&world, 0).z;
        let expected = (100.0f64 * 100.0 + 2.0 * G * (900.0 - height)).sqrt();
        assert!((fastest - expected).abs() < 0.5, "{form:?}: {fastest} m/s at {height} m, expected {expected} m/s");
        assert!(fastest > 160.0);
    }
}

#[test]
fn a_block_driven_at_300_m_s_is_no_runaway() {
    let mut scene = one();
    scene.blocks[0].pos[2] = 1.0;
    let mut world = World::new(&scene, Params::default()).unwrap();
    let drive = Input::drives(vec![Drive::new(BodyId(0), DVec3::X * 300.0)]);
    for _ in 0..60 {
        assert_eq!(world.step(&drive).quarantined, []);
    }
    assert!((motion(&world, 0).0.x - 300.0).abs() < 3.0, "{}", motion(&world, 0).0);
}

/// Absurd inputs to one body.
fn absurd(body: BodyId) -> Vec<Input> {
    let at = |point, force| Input::force(AppliedForce { body, point, force });
    let hand = Hand::carry(body, DVec3::ZERO, DVec3::Z, DQuat::IDENTITY);
    let mut inputs = Vec::new();
    for size in [1e4, 1e10, 1e40, 1e160, 1e300, f64::MAX] {
        for axis in [DVec3::X, DVec3::new(0.5, -0.6, 0.2), DVec3::NEG_Z] {
            inputs.push(at(DVec3::ZERO, axis * size));
            inputs.push(at(axis.yzx() * size, axis));
            inputs.push(at(axis.yzx() * size, axis * size));
            inputs.push(Input::drives(vec![Drive::new(body, axis * size).with_max_force(size)]));
            inputs.push(Input::drives(vec![Drive::new(body, axis * size).with_max_force(f64::INFINITY)]));
            let orientation = Some(DQuat::from_xyzw(axis.x * size, axis.y * size, axis.z * size, size));
            let (anchor, target) = (axis * size, axis * -size);
            inputs.push(Input::hand(Hand { orientation, ..hand.clone() }));
            inputs.push(Input::hand(Hand { anchor, max_torque: size, ..hand.clone() }));
            inputs.push(Input::hand(Hand { target, max_force: size, ..hand.clone() }));
            inputs.push(Input::hand(Hand {
                orientation,
                anchor,
                target,
                max_force: size,
                max_torque: size,
                ..hand.clone()
            }));
            inputs.push(Input::hand(Hand::push(body, anchor, target, axis * size)));
        }
    }
    inputs
}

#[test]
fn absurd_inputs_do_not_move_bodies_that_they_do_not_name() {
    for form in [Form::Rigid, Form::Lattice] {
        // a block in the air beside a column
        let mut scene = column(4);
        scene.form = form;
        scene.blocks.push(Block { id: 99, pos: [0.0, 5.0, 3.0], ..scene.blocks[0].clone() });
        let world = World::new(&scene, Params::default()).unwrap();
        let mut alone = world.clone();
        steps(&mut alone, 6);
        for input in absurd(BodyId(4)) {
            let mut world = world.clone();
            for _ in 0..6 {
                let report = world.step(&input);
                assert!(report.quarantined.iter().all(|&body| body == BodyId(4)), "{input:?}: {report:?}");
            }
            assert!(world.poses().iter().all(|x| x.is_finite()), "{input:?}");
            // A body that may come near shares the order of the sums.
            let moved = world.poses()[..28].iter().zip(alone.poses()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(moved < 1e-9, "{moved} by {input:?}");
        }
    }
}

#[test]
fn absurd_inputs_to_a_block_of_a_tower_freeze_no_other() {
    for form in [Form::Rigid, Form::Lattice] {
        let mut scene = teeter_scene::tower(&teeter_scene::TowerOptions { rows: 6, ..Default::default() }).unwrap();
        scene.form = form;
        let world = World::new(&scene, Params::default()).unwrap();
        for input in absurd(BodyId(7)) {
            let mut world = world.clone();
            for _ in 0..4 {
                let report = world.step(&input);
                assert!(report.quarantined.iter().all(|&body| body == BodyId(7)), "{form:?} {input:?}: {report:?}");
            }
            assert!(world.poses().iter().all(|x| x.is_finite()), "{input:?}");
        }
    }
}

#[test]
fn states_set_from_outside_are_finite_and_within_the_limits() {
    let mut world = World::new(&column(3), Params::default()).unwrap();
    let before = world.hash();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        world.set_twist(BodyId(1), Twist::linear(DVec3::new(0.0, bad, 0.0)));
        world.set_twist(BodyId(1), Twist::angular(DVec3::new(bad, 0.0, 0.0)));
        world.set_orientation(BodyId(1), DQuat::from_xyzw(0.0, bad, 0.0, 1.0));
    }
    world.set_orientation(BodyId(1), DQuat::from_array([0.0; 4]));
    assert_eq!(world.hash(), before);
    world.set_twist(BodyId(2), Twist { velocity: DVec3::Z * 1e300, spin: DVec3::X * 1e300 });
    let (velocity, spin) = motion(&world, 2);
    assert!((velocity.length() - 1e3).abs() < 1e-6 && spin.length() < 1e3 / 0.0134 + 1.0, "{velocity} {spin}");
    world.set_orientation(BodyId(2), DQuat::from_xyzw(0.0, 0.0, 1e200, 1e200));
    assert!((orientation(&world, 2).z - 0.5f64.sqrt()).abs() < 1e-12);
    for _ in 0..30 {
        let report = world.step(&Input::default());
        assert!(report.quarantined.iter().all(|&body| body == BodyId(2)));
    }
    assert!(world.poses().iter().all(|x| x.is_finite()));
}

/// Blocks in free flight, half a millimetre apart, that all move alike.
fn swarm(velocity: DVec3) -> World {
    let mut scene = column(8);
    let spacing = scene.blocks[0].size[2] + 5e-4;
    for (i, block) in scene.blocks.iter_mut().enumerate() {
        block.pos[2] = 20.0 + spacing * i as f64;
        block.velocity = velocity.to_array();
    }
    World::new(&scene, Params::default()).unwrap()
}

#[test]
fn blocks_that_fly_together_are_tested_no_more_often_than_blocks_at_rest() {
    for velocity in [DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), DVec3::new(-2.0, 5.0, 8.0)] {
        let mut world = swarm(velocity);
        let mut tests = 0;
        for _ in 0..12 {
            let report = world.step(&Input::default());
            tests += report.detections;
            assert!(report.syncs <= 20, "{velocity}: {report:?}");
        }
        // Seven pairs, whose reach is settled in the first frame.
        assert!(tests <= 7 * 12, "{velocity}: {tests} tests");
    }
}

#[test]
fn a_block_that_flies_with_another_is_stopped_by_a_third_and_met_by_the_second() {
    // Two blocks fly side by side, flush; the first meets a fixed block head-on.
    let mut scene = blocks(&[[0.0, 0.0, 0.5], [0.0, 0.0268 + 2e-4, 0.5], [0.3, -0.02, 0.5]]);
    scene.gravity = 0.0;
    for block in &mut scene.blocks[..2] {
        block.velocity = [2.0, 0.0, 0.0];
    }
    scene.blocks[2].fixed = true;
    let mut world = World::new(&scene, Params::default()).unwrap();
    let energy = world.energy().total();
    let mut deepest: f64 = 0.0;
    for _ in 0..30 {
        let report = world.step(&Input::default());
        deepest = deepest.max(report.penetration);
        assert!(world.energy().total() < energy * (1.0 + 1e-6));
    }
    // v sqrt(m / k) of the impact, twice for the corner that carries it alone.
    assert!(deepest < 2.0 * 2.0 * (MASS / scene.stiffness).sqrt(), "{deepest}");
}

#[test]
fn a_block_that_trails_one_that_is_stopped_through_another_is_found_in_time() {
    // A train of blocks of which the first two touch, end to end, towards a fixed one.
    let length = SIZE[0];
    for gap in [1e-3, 3e-3, 5e-3, 7e-3, 9e-3] {
        let mut scene = blocks(&[0.0, -length, -2.0 * length - 5e-4, length + gap].map(|x| [x, 0.0, 0.5]));
        scene.gravity = 0.0;
        for block in &mut scene.blocks[..3] {
            block.velocity = [2.0, 0.0, 0.0];
        }
        scene.blocks[3].fixed = true;
        let mut world = World::new(&scene, Params::default()).unwrap();
        let deepest = (0..10).map(|_| world.step(&Input::default()).penetration).fold(0.0, f64::max);
        // u sqrt(m / 2 / k), of two blocks that meet at most at u = 2 v.
        assert!(deepest < 2.0 * 2.0 * (MASS / 2.0 / scene.stiffness).sqrt(), "gap {gap}: {deepest} m");
    }
}
