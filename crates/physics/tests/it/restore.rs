//! A restored world continues as the original, whatever acts on the two.

use crate::common::*;
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use teeter_physics::{AppliedForce, BodyId, Drive, Grip, Hand, Input, Params, Twist, World};
use teeter_scene::{Form, Scene};

/// Two columns, a fixed block and blocks in the air.
fn scene(form: Form) -> Scene {
    let mut scene = blocks(&[
        [0.0, 0.0, 0.009],
        [0.0, 0.0, 0.027],
        [0.0, 0.0, 0.045],
        [0.3, 0.0, 0.009],
        [0.3, 0.0, 0.027],
        [0.6, 0.0, 0.3],
        [0.0, 0.0, 0.5],
        [1.5, 0.0, 1.0],
    ]);
    scene.form = form;
    scene.blocks[5].fixed = true;
    scene
}

/// Something that happens to a world within one frame.
#[derive(Debug, Clone)]
enum Event {
    Input(Input),
    Twist(BodyId, Twist),
    Orientation(BodyId, DQuat),
    Form(Form),
    Wait(u32),
}

impl Event {
    fn happens(&self, world: &mut World) {
        match self {
            Self::Input(input) => drop(world.step(input)),
            Self::Twist(body, twist) => world.set_twist(*body, *twist),
            Self::Orientation(body, q) => world.set_orientation(*body, *q),
            Self::Form(form) => {
                world.set_form(*form, world.scene().springs).expect("the springs are those of the scene")
            }
            Self::Wait(frames) => (0..*frames).for_each(|_| drop(world.step(&Input::default()))),
        }
    }
}

/// Numbers from everyday to absurd.
fn size() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..1.0f64,
        3 => (-4.0..5.0f64).prop_map(|e| libm::pow(10.0, e)),
        1 => (5.0..308.0f64).prop_map(|e| -libm::pow(10.0, e)),
        1 => prop_oneof![Just(0.0), Just(f64::NAN), Just(f64::INFINITY), Just(1e-308), Just(f64::MAX)],
    ]
}

fn vector() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        3 => ([-1.0..1.0f64, -1.0..1.0, -1.0..1.0], size()).prop_map(|(v, size)| DVec3::from(v) * size),
        1 => [size(), size(), size()].prop_map(DVec3::from),
    ]
}

fn body() -> impl Strategy<Value = BodyId> {
    (0..8u32).prop_map(BodyId)
}

fn quaternion() -> impl Strategy<Value = DQuat> {
    ([-1.0..1.0f64, -1.0..1.0, -1.0..1.0, -1.0..1.0], size())
        .prop_map(|(q, size)| DQuat::from_array(q.map(|x| x * size)))
}

fn hand() -> impl Strategy<Value = Hand> {
    (body(), vector(), vector(), prop::option::of(quaternion()), 0..3u8, size(), size()).prop_map(
        |(body, anchor, target, orientation, grip, max_force, max_torque)| {
            let hand = match grip {
                0 => Hand::slide(body, anchor, target, DQuat::IDENTITY),
                1 => Hand::carry(body, anchor, target, DQuat::IDENTITY),
                _ => Hand { grip: Grip::Push { axis: target }, ..Hand::slide(body, anchor, target, DQuat::IDENTITY) },
            };
            Hand { orientation, max_force, max_torque, ..hand }
        },
    )
}

fn input() -> impl Strategy<Value = Input> {
    let force = (body(), vector(), vector()).prop_map(|(body, point, force)| AppliedForce { body, point, force });
    let drive = (body(), vector(), size()).prop_map(|(body, v, f)| Drive::new(body, v).with_max_force(f));
    (
        prop::option::weighted(0.1, vector()),
        prop::option::weighted(0.3, hand()),
        prop::collection::vec(force, 0..4),
        prop::collection::vec(drive, 0..2),
    )
        .prop_map(|(gravity, hand, forces, drives)| Input { gravity, hand, forces, drives })
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        6 => input().prop_map(Event::Input),
        1 => (body(), vector(), vector()).prop_map(|(body, velocity, spin)| Event::Twist(body, Twist { velocity, spin })),
        1 => (body(), quaternion()).prop_map(|(body, q)| Event::Orientation(body, q)),
        1 => any::<bool>().prop_map(|soft| Event::Form(if soft { Form::Lattice } else { Form::Rigid })),
        3 => (1..40u32).prop_map(Event::Wait),
    ]
}

/// Takes `world` to a second one by a snapshot.
fn copy(world: &World) -> World {
    let mut other = World::new(&scene(world.form()), Params::default()).expect("the scene is valid");
    other.restore(&world.snapshot()).expect("a snapshot can be restored");
    other
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_restored_world_continues_whatever_happens(
        form in any::<bool>(),
        events in prop::collection::vec((event(), prop::bool::weighted(0.3)), 1..16),
    ) {
        let form = if form { Form::Lattice } else { Form::Rigid };
        let mut world = World::new(&scene(form), Params::default()).expect("the scene is valid");
        let mut other = copy(&world);
        for (event, restore) in events {
            event.happens(&mut world);
            event.happens(&mut other);
            prop_assert_eq!(world.hash(), other.hash());
            prop_assert!(world.poses().iter().all(|x| x.is_finite()));
            if restore {
                other = copy(&world);
            }
        }
    }
}

/// Forces count by their sum, and what a frozen block occupies is known to the restored world.
#[test]
fn a_block_does_not_fly_through_one_frozen_by_many_forces() {
    let mut scene = blocks(&[[0.0, 0.0, 1.0], [1.5, 0.0, 1.0]]);
    scene.gravity = 0.0;
    for copies in [1, 20, 200] {
        let mut world = World::new(&scene, Params::default()).unwrap();
        let force = AppliedForce::at_center(BodyId(0), DVec3::Z * (1000.0 / copies as f64));
        let push = Input::forces(vec![force; copies]);
        let frozen = (0..40).any(|_| !world.step(&push).quarantined.is_empty());
        assert!(frozen, "{copies} forces");
        let mut other = World::new(&scene, Params::default()).unwrap();
        other.restore(&world.snapshot()).unwrap();
        // Brings the second block to the frozen one.
        let away = position(&world, 0) - position(&world, 1);
        let flight = Twist::linear(away.normalize() * 50.0);
        for world in [&mut world, &mut other] {
            world.set_twist(BodyId(1), flight);
        }
        for frame in 0..(away.length() / 50.0 * 60.0) as usize + 30 {
            assert_eq!(world.step(&Input::default()), other.step(&Input::default()), "{copies} forces, frame {frame}");
        }
        assert_eq!(world.hash(), other.hash());
        // It has not passed the frozen one.
        let beyond = (position(&world, 1) - position(&world, 0)).dot(away.normalize());
        assert!(beyond < 0.0, "{copies} forces: {beyond} m beyond");
    }
}
