//! Target: a sequence of inputs to a world, and of states that are set from outside.

use arbitrary::{Arbitrary, Result, Unstructured};
use glam::{DQuat, DVec3};
use teeter_physics::{AppliedForce, BodyId, Drive, Grip, Hand, Input, Params, Twist, World};
use teeter_scene::{Block, Form, Scene};

/// Blocks that the bytes may name; one more stands far from them.
const NAMED: u32 = 6;
/// Displacement of a block that nothing names, m: it settles.
const MAX_MOVED: f64 = 1e-6;
/// Maximum number of events that are played.
const MAX_EVENTS: usize = 12;

/// A column, and a block far from it.
fn scene(form: Form) -> Scene {
    let mut scene = teeter_scene::named("column").expect("the list has it");
    scene.form = form;
    scene.blocks.truncate(NAMED as usize);
    let far = Block { id: 1000, ..scene.blocks[0].clone() };
    scene.blocks.push(Block { pos: [500.0, 500.0, far.pos[2]], ..far });
    scene
}

/// Plays the events that bytes stand for. Poses stay finite, the far block is not frozen, and a
/// world that is restored in the middle goes on bit for bit.
pub fn run(bytes: &[u8]) {
    let mut bytes = Unstructured::new(bytes);
    let form = if bytes.arbitrary().unwrap_or(false) { Form::Lattice } else { Form::Rigid };
    let mut world = World::new(&scene(form), Params::default()).expect("the scene is valid");
    let mut other = world.clone();
    let far = world.pose(BodyId(NAMED)).position;
    let mut heavy = false;
    for _ in 0..MAX_EVENTS {
        if bytes.is_empty() || play(&mut bytes, &mut world, &mut other, &mut heavy).is_err() {
            break;
        }
        let moved = world.pose(BodyId(NAMED)).position.distance(far);
        assert!(heavy || moved < MAX_MOVED, "a block that nothing named moved by {moved} m");
        assert_eq!(world.hash(), other.hash());
        assert!(world.poses().iter().all(|x| x.is_finite()));
        assert!(!world.is_quarantined(BodyId(NAMED)), "a block that nothing named was frozen");
    }
}

/// Plays an event in both worlds.
///
/// `heavy` is set where gravity changes, which moves all blocks.
fn play(bytes: &mut Unstructured, world: &mut World, other: &mut World, heavy: &mut bool) -> Result<()> {
    let body = BodyId(bytes.int_in_range(0..=NAMED - 1)?);
    match bytes.int_in_range(0..=5u8)? {
        0 => {
            *other = World::new(&scene(world.form()), Params::default()).expect("the scene is valid");
            other.restore(&world.snapshot()).expect("a snapshot can be restored");
        }
        1 => {
            let twist = Twist { velocity: vector(bytes)?, spin: vector(bytes)? };
            for world in [world, other] {
                world.set_twist(body, twist);
            }
        }
        2 => {
            let q = quaternion(bytes)?;
            for world in [world, other] {
                world.set_orientation(body, q);
            }
        }
        3 => {
            for _ in 0..bytes.int_in_range(1..=20u8)? {
                assert_eq!(world.step(&Input::default()), other.step(&Input::default()));
            }
        }
        _ => {
            let input = input(bytes, body)?;
            *heavy |= input.gravity.is_some();
            assert_eq!(world.step(&input), other.step(&input));
        }
    }
    Ok(())
}

fn input(bytes: &mut Unstructured, body: BodyId) -> Result<Input> {
    let gravity = if bytes.ratio(1u8, 8u8)? { Some(vector(bytes)?) } else { None };
    let hand = if bytes.ratio(1u8, 3u8)? { Some(hand(bytes, body)?) } else { None };
    let mut forces = Vec::new();
    for _ in 0..bytes.int_in_range(0..=3u8)? {
        forces.push(AppliedForce { body, point: vector(bytes)?, force: vector(bytes)? });
    }
    let mut drives = Vec::new();
    if bytes.ratio(1u8, 4u8)? {
        drives.push(Drive { body, velocity: vector(bytes)?, max_force: number(bytes)? });
    }
    Ok(Input { gravity, hand, forces, drives })
}

fn hand(bytes: &mut Unstructured, body: BodyId) -> Result<Hand> {
    let (anchor, target) = (vector(bytes)?, vector(bytes)?);
    let grip = match bytes.int_in_range(0..=2u8)? {
        0 => Grip::Slide,
        1 => Grip::Carry,
        _ => Grip::Push { axis: vector(bytes)? },
    };
    let orientation = if bytes.arbitrary()? { Some(quaternion(bytes)?) } else { None };
    let hand = Hand::slide(body, anchor, target, DQuat::IDENTITY);
    Ok(Hand { orientation, grip, max_force: number(bytes)?, max_torque: number(bytes)?, ..hand })
}

/// Number: everyday, or any that there is.
fn number(bytes: &mut Unstructured) -> Result<f64> {
    match bytes.int_in_range(0..=3u8)? {
        0 => f64::arbitrary(bytes),
        k => Ok(f64::from(i16::arbitrary(bytes)?) * [1e-5, 1e-3, 1.0][usize::from(k) - 1]),
    }
}

fn vector(bytes: &mut Unstructured) -> Result<DVec3> {
    Ok(DVec3::new(number(bytes)?, number(bytes)?, number(bytes)?))
}

fn quaternion(bytes: &mut Unstructured) -> Result<DQuat> {
    Ok(DQuat::from_xyzw(number(bytes)?, number(bytes)?, number(bytes)?, number(bytes)?))
}

/// Bytes without an order, from which the fuzzer makes events.
pub fn seeds() -> Vec<Vec<u8>> {
    let ramp = |step: u32| (0..400u32).map(|i| ((i * step) >> 3) as u8).collect();
    (1..6).map(|k| ramp(k * 37)).collect()
}
