//! Hand on a whole tower: loose blocks come out without disturbing others, tight blocks stay,
//! forces are limited.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{BodyId, Drive, Grip, Hand, Input, Pose, World};
use teeter_scene::{Scene, TowerOptions, tower};

/// Settled tower of 18 rows.
fn settled(seed: u64) -> World {
    settled_at(seed, 1e6)
}

/// Settled tower of 18 rows with contacts of this stiffness, N/m.
fn settled_at(seed: u64, stiffness: f64) -> World {
    let scene = Scene { stiffness, ..tower(&TowerOptions { seed, ..TowerOptions::default() }).unwrap() };
    let mut world = World::new(&scene, awake()).unwrap();
    run(&mut world, 1.5, &Input::default());
    world
}

/// Load on a body from above, N.
fn load(world: &World, body: u32) -> f64 {
    world.contacts(BodyId(body)).iter().filter(|c| c.normal.z < -0.5).map(|c| c.force).sum()
}

/// Blocks of the tower below the top row on which nothing rests.
fn loose(world: &World) -> Vec<u32> {
    (0..world.len() as u32 - 3).filter(|&i| load(world, i) < 1e-3).collect()
}

/// Direction of a block's long axis.
fn along(world: &World, body: u32) -> DVec3 {
    orientation(world, body as usize) * DVec3::X
}

/// Hand with the default limits that pulls a block out by its end along its axis.
fn pull(world: &World, body: u32, distance: f64) -> Hand {
    let body = BodyId(body);
    let anchor = DVec3::new(0.5 * world.size(body).x, 0.0, 0.0);
    let Pose { position, orientation: q } = world.pose(body);
    Hand::slide(body, anchor, position + q * anchor + q * DVec3::X * distance, q)
}

#[test]
fn a_loose_block_comes_out_at_5_cm_a_second_and_nothing_else_moves() {
    let mut world = settled(1);
    let all = loose(&world);
    assert!(all.len() >= 5, "{} loose blocks", all.len());
    let start = world.snapshot();
    for &body in &all {
        world.restore(&start).unwrap();
        let before = poses(&world);
        let (from, axis) = (position(&world, body as usize), along(&world, body));
        let hand = pull(&world, body, 0.0);
        for i in 1..=120 {
            let target = hand.target + axis * (0.05 * f64::from(i) / 60.0);
            let report = world.step(&Input::hand(Hand { target, ..hand.clone() }));
            let force = report.hand.unwrap().force.length();
            assert!(force < 0.5, "it takes {force} N to pull loose block {body}");
        }
        let out = (position(&world, body as usize) - from).dot(axis);
        assert!(out > 0.099, "block {body} came {out} m");
        for other in (0..world.len()).filter(|&i| i != body as usize) {
            let moved = (position(&world, other) - before[other].position).length();
            assert!(moved < 1e-4, "block {other} moved {} mm when {body} was pulled", moved * 1e3);
        }
    }
}

/// Half out, a block rests on a single block. With a soft control of orientation it tips by its
/// clearance of a tenth of a millimetre, and its inner end presses on the block above, which is
/// loose as well in these towers.
#[test]
fn a_block_drawn_half_out_does_not_tip_or_drag_the_loose_block_above() {
    for (seed, body) in [(20, 29), (9, 37), (17, 17)] {
        let mut world = settled_at(seed, 3e6);
        let before = poses(&world);
        let (axis, hand) = (along(&world, body), pull(&world, body, 0.0));
        let mut largest = 0.0_f64;
        for i in 1..=104 {
            let target = hand.target + axis * (0.05 * f64::from(i) / 60.0);
            world.step(&Input::hand(Hand { target, ..hand.clone() }));
            let moved = |other: usize| (position(&world, other) - before[other].position).length();
            largest = (0..world.len()).filter(|&i| i != body as usize).map(moved).fold(largest, f64::max);
        }
        assert!(largest < 1e-4, "seed {seed}: another block moved {} mm when {body} was pulled", largest * 1e3);
    }
}

/// Drag is the coefficient of friction times the load on the block below, which is a fifth of the
/// weight.
#[test]
fn a_sliding_hand_carries_four_fifths_of_the_weight() {
    for params in both() {
        let mut world = World::new(&blocks(&[[0.0, 0.0, 0.009], [0.0, 0.0, 0.027]]), params).unwrap();
        run(&mut world, 0.5, &Input::default());
        let hand = pull(&world, 1, 0.0);
        let mut felt = DVec3::ZERO;
        for i in 1..=30 {
            let target = hand.target + DVec3::X * (0.02 * f64::from(i) / 60.0);
            felt = world.step(&Input::hand(Hand { target, ..hand.clone() })).hand.unwrap().force;
        }
        let weight = MASS * G;
        assert!((felt.z / weight - 0.8).abs() < 0.05, "it carries {} of the weight", felt.z / weight);
        assert!((felt.x / (0.4 * (weight - felt.z)) - 1.0).abs() < 0.02, "{felt}");
    }
}

#[test]
fn a_block_held_by_its_end_hangs_level() {
    for params in both() {
        let mut world = World::new(&one(), params).unwrap();
        let mut hand = Hand { grip: Grip::Carry, ..pull(&world, 0, 0.0) };
        hand.target.z += 0.1;
        run(&mut world, 1.0, &Input::hand(hand.clone()));
        let tilt = (orientation(&world, 0) * DVec3::X).z;
        assert!(tilt.abs() < 1e-6, "it hangs by {tilt} rad");
        let end = position(&world, 0) + orientation(&world, 0) * hand.anchor;
        assert!((end - hand.target).length() < 1e-8, "its end is {} m from its target", (end - hand.target).length());
    }
}

#[test]
fn a_tight_block_stays_and_the_tower_with_it() {
    let mut world = settled(1);
    let body = (0..27).max_by(|&a, &b| load(&world, a).total_cmp(&load(&world, b))).unwrap();
    let before = poses(&world);
    // It slips at mu (N above + N below), unless the blocks above move with it before.
    assert!(0.4 * 2.0 * load(&world, body) > Hand::DEFAULT_FORCE);
    let hand = Hand { max_force: 1.0, ..pull(&world, body, 0.05) };
    let report = run(&mut world, 2.0, &Input::hand(hand));
    let felt = report.hand.unwrap();
    // Lift counts towards the largest force.
    assert!(felt.capped && (felt.force.length() - 1.0).abs() < 1e-9, "{felt:?}");
    assert!(displacement(&before, &world) < 1e-4);
}

#[test]
fn a_sliding_hand_with_a_raised_target_does_not_lift_the_tower() {
    let mut world = settled(1);
    let before = poses(&world);
    let mut hand = pull(&world, 4, 0.0);
    hand.target.z += 0.05;
    let report = run(&mut world, 1.0, &Input::hand(hand));
    assert!(report.hand.unwrap().force.length() < 1.01 * world.mass(BodyId(4)) * G);
    assert!(displacement(&before, &world) < 1e-4);
}

#[test]
fn a_carried_block_follows_the_hand_and_is_placed_on_top() {
    let mut world = settled(1);
    let body = loose(&world)[0];
    let top = (0..world.len()).map(|i| position(&world, i).z).fold(0.0, f64::max);
    let mut hand = pull(&world, body, 0.0);
    let axis = along(&world, body);
    let go = |world: &mut World, hand: &mut Hand, to: DVec3, speed: f64| {
        let from = hand.target;
        let frames = ((to - from).length() / speed * 60.0).ceil().max(1.0);
        for i in 1..=frames as u32 {
            hand.target = from.lerp(to, f64::from(i) / frames);
            world.step(&Input::hand(hand.clone()));
        }
    };
    let out = hand.target + axis * 0.12;
    go(&mut world, &mut hand, out, 0.05);
    hand.grip = Grip::Carry;
    let q = orientation(&world, body as usize);
    let anchor = q * hand.anchor;
    let above = DVec3::new(0.0, 0.0, top + 0.018 + 0.01) + anchor;
    let risen = hand.target.with_z(above.z);
    go(&mut world, &mut hand, risen, 0.2);
    go(&mut world, &mut hand, above, 0.2);
    go(&mut world, &mut hand, above - DVec3::new(0.0, 0.0, 0.0105), 0.03);
    let before = poses(&world);
    run(&mut world, 2.0, &Input::default());
    assert!((position(&world, body as usize).z - top - 0.018).abs() < 1e-3, "it does not lie on top");
    for other in (0..world.len()).filter(|&i| i != body as usize) {
        let moved = (position(&world, other) - before[other].position).length();
        assert!(moved < 2e-4, "letting go moved block {other} by {} mm", moved * 1e3);
    }
}

#[test]
fn a_fingertip_pushes_and_never_pulls() {
    let mut world = World::new(&one(), awake()).unwrap();
    run(&mut world, 0.5, &Input::default());
    let finger = |world: &World, ahead: f64| {
        let anchor = DVec3::new(-0.0405, 0.0, 0.0);
        let target = position(world, 0) + anchor + DVec3::X * ahead;
        Input::hand(Hand::push(BodyId(0), anchor, target, DVec3::X).with_max_force(4.0).with_max_torque(0.0))
    };
    for _ in 0..30 {
        let input = finger(&world, -0.005);
        let report = world.step(&input);
        assert_eq!(report.hand.unwrap().force, DVec3::ZERO);
    }
    assert!(position(&world, 0).x.abs() < 1e-9);
    for _ in 0..30 {
        let input = finger(&world, 0.002);
        world.step(&input);
    }
    assert!(position(&world, 0).x > 1e-3);
}

/// A block driven upwards takes all rows above it along. A second later they come down at 5 m/s in
/// one piece, and 0.7 kg on the nine contacts of a row penetrate by v sqrt(M / 2 k) = 1 mm.
#[test]
fn a_middle_block_driven_at_5_m_s_penetrates_nothing_by_a_millimetre() {
    for seed in 1..4 {
        let mut world = settled(seed);
        let start = world.snapshot();
        for direction in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z] {
            world.restore(&start).unwrap();
            for i in 0..120 {
                let drive = Drive { body: BodyId(25), velocity: direction * 5.0, max_force: Drive::DEFAULT_FORCE };
                let drives = if i < 6 { vec![drive] } else { Vec::new() };
                let report = world.step(&Input { drives, ..Input::default() });
                let comes_down = direction == DVec3::Z && i > 60;
                assert!(report.quarantined.is_empty());
                let allowed = if comes_down { 2e-3 } else { 1e-3 };
                assert!(
                    report.penetration < allowed,
                    "seed {seed}, {direction}, frame {i}: {} mm",
                    report.penetration * 1e3
                );
                assert!(report.max_speed < 10.0, "{} m/s", report.max_speed);
                assert!(world.poses().iter().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn invalid_input_is_ignored() {
    let mut world = World::new(&one(), awake()).unwrap();
    let mut same = world.clone();
    let hand = Hand { target: DVec3::NAN, ..pull(&world, 0, 0.0) };
    let drive = Drive { body: BodyId(7), velocity: DVec3::X, max_force: 1.0 };
    let invalid = Input { gravity: Some(DVec3::INFINITY), hand: Some(hand), drives: vec![drive], ..Input::default() };
    for _ in 0..30 {
        let report = world.step(&invalid);
        assert!(report.hand.is_none() && report.quarantined.is_empty());
        same.step(&Input::default());
    }
    assert_eq!(world.hash(), same.hash());
}
