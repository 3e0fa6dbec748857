//! Damaged snapshots are refused, and the world stays as it was. What is accepted, because whoever
//! damaged it sealed it again, can be stepped.

use crate::common::*;
use glam::DVec3;
use teeter_physics::envelope::seal;
use teeter_physics::{AppliedForce, BodyId, Drive, Hand, Input, Params, World};
use teeter_scene::{Form, Random};

/// A world in which all of the state is in use, with a snapshot of it.
fn world(form: Form) -> (World, Vec<u8>) {
    let mut scene = column(4);
    scene.form = form;
    let mut world = World::new(&scene, Params::default()).unwrap();
    let body = BodyId(1);
    let force = AppliedForce { body, point: DVec3::new(0.01, 0.0, 0.0), force: DVec3::X };
    let pose = world.pose(BodyId(3));
    let hand = Hand::carry(BodyId(3), DVec3::ZERO, pose.position + DVec3::Z * 0.01, pose.orientation);
    let input = Input {
        hand: Some(hand),
        forces: vec![force],
        drives: vec![Drive::new(BodyId(2), DVec3::Y)],
        ..Input::default()
    };
    for _ in 0..3 {
        world.step(&input);
    }
    let bytes = world.snapshot();
    (world, bytes)
}

/// Changes some bytes: one bit, one byte, a run, or the length.
fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    // Nothing may be left.
    let at = random.below(bytes.len());
    if at == bytes.len() {
        return bytes.push(0);
    }
    match random.below(8) {
        0..3 => bytes[at] ^= 1 << random.below(8),
        3..5 => bytes[at] = random.bits() as u8,
        5 => {
            let end = (at + 1 + random.below(16)).min(bytes.len());
            bytes[at..end].iter_mut().for_each(|byte| *byte = random.bits() as u8);
        }
        6 => bytes.truncate(at),
        _ => bytes.insert(at, random.bits() as u8),
    }
}

/// Restores `count` damaged snapshots; returns the number of those that were accepted.
fn restore_damaged(form: Form, count: usize, seed: u64) {
    let (mut world, bytes) = world(form);
    let hash = world.hash();
    let mut random = Random::new(seed);
    for _ in 0..count {
        let mut damaged = bytes.clone();
        for _ in 0..=random.below(3) {
            damage(&mut damaged, &mut random);
        }
        if damaged != bytes {
            assert!(world.restore(&damaged).is_err(), "a damaged snapshot was accepted");
        }
    }
    assert_eq!(world.hash(), hash);
}

/// Restores `count` snapshots that were sealed again after the damage, and steps those accepted.
fn restore_forged(form: Form, count: usize, seed: u64) {
    let (mut world, bytes) = world(form);
    let kind_len = b"teeter\x00\x05".len();
    let (kind, content) = (&bytes[..kind_len], &bytes[kind_len + 16..]);
    let mut random = Random::new(seed);
    for _ in 0..count {
        let mut forged = content.to_vec();
        for _ in 0..=random.below(3) {
            damage(&mut forged, &mut random);
        }
        if world.restore(&seal(kind, &forged)).is_ok() {
            assert_eq!(world.restore(&world.snapshot()), Ok(()), "what was restored can be restored again");
            world.step(&Input::default());
            world.step(&Input::default());
            assert!(world.poses().iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn damaged_snapshots_are_refused() {
    restore_damaged(Form::Rigid, 4000, 1);
    restore_damaged(Form::Lattice, 1000, 2);
}

#[test]
fn forged_snapshots_are_refused_or_can_be_stepped() {
    restore_forged(Form::Rigid, 600, 3);
    restore_forged(Form::Lattice, 200, 4);
}

#[test]
#[ignore = "takes minutes: run it after a change of the snapshot"]
fn a_million_damaged_snapshots_are_refused() {
    restore_damaged(Form::Rigid, 800_000, 5);
    restore_damaged(Form::Lattice, 200_000, 6);
    restore_forged(Form::Rigid, 40_000, 7);
    restore_forged(Form::Lattice, 10_000, 8);
}
