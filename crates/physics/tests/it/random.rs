//! Random scenes and inputs: the state stays finite, continues from a snapshot, and is the same in
//! registers of any width.

use glam::DVec3;
use proptest::prelude::*;
use teeter_physics::{AppliedForce, BodyId, Drive, Grip, Hand, Input, Params, Precision, Width, World};
use teeter_scene::{Block, Form, Particles, Scene, Springs, TowerOptions, field};

/// Rigid blocks, or blocks of springs from jelly to wood.
fn any_form() -> impl Strategy<Value = (Form, Springs)> {
    let particles = prop_oneof![Just(Particles::Inside), Just(Particles::Corners)];
    let springs = (prop_oneof![Just(1e3), Just(3e4), Just(1e6), Just(1e7)], 0.01..0.5f64, particles);
    let lattice = springs.prop_map(|(stiffness, damping, particles)| {
        (Form::Lattice, Springs { stiffness: Some(stiffness), damping, particles })
    });
    prop_oneof![2 => Just((Form::Rigid, Springs::default())), 1 => lattice]
}

/// Small towers, with blocks of any size in the air above and beside them.
fn any_scene() -> impl Strategy<Value = Scene> {
    let loose =
        (prop::array::uniform3(0.01..0.08f64), 0.005..0.05f64, prop::array::uniform2(-0.5..0.5f64), 0.0..3.0f64);
    let stiffness = prop_oneof![Just(3e5), Just(1e6)];
    (1u32..4, 1u32..6, any::<u64>(), 0.0..1.0f64, stiffness, any_form(), prop::collection::vec(loose, 0..12)).prop_map(
        |(towers, rows, seed, restitution, stiffness, form, loose)| {
            let mut scene =
                field(towers, &TowerOptions { rows, seed, restitution, ..TowerOptions::default() }).unwrap();
            scene.stiffness = stiffness;
            (scene.form, scene.springs) = form;
            for (i, (size, mass, [x, y], yaw)) in loose.into_iter().enumerate() {
                let pos = [x, y, 0.25 + 0.09 * i as f64];
                scene.blocks.push(Block { yaw, ..Block::new(1000 + i as u32, size, mass, pos) });
            }
            scene
        },
    )
}

fn any_vector(reach: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-reach..reach).prop_map(DVec3::from)
}

/// Input for some frames; the body is the index modulo the number of bodies.
#[derive(Debug, Clone)]
enum Action {
    Nothing,
    Drive(u32, DVec3),
    Force(u32, DVec3, DVec3),
    Hand(u32, DVec3, Grip),
}

fn any_action() -> impl Strategy<Value = Action> {
    let grip = prop_oneof![Just(Grip::Slide), Just(Grip::Carry), Just(Grip::Push { axis: DVec3::X })];
    prop_oneof![
        Just(Action::Nothing),
        (any::<u32>(), any_vector(4.0)).prop_map(|(i, v)| Action::Drive(i, v)),
        (any::<u32>(), any_vector(0.03), any_vector(5.0)).prop_map(|(i, at, f)| Action::Force(i, at, f)),
        (any::<u32>(), any_vector(0.05), grip).prop_map(|(i, ahead, grip)| Action::Hand(i, ahead, grip)),
    ]
}

fn input(act: &Action, world: &World) -> Input {
    let body = |i: u32| BodyId(i % world.len() as u32);
    match *act {
        Action::Nothing => Input::default(),
        Action::Drive(i, velocity) => Input::drives(vec![Drive::new(body(i), velocity)]),
        Action::Force(i, point, force) => Input::force(AppliedForce { body: body(i), point, force }),
        Action::Hand(i, ahead, grip) => {
            let pose = world.pose(body(i));
            let hand = Hand::carry(body(i), DVec3::ZERO, pose.position + ahead, pose.orientation);
            Input::hand(Hand { grip, ..hand.without_orientation() })
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn states_stay_finite_restore_and_agree_between_widths(
        scene in any_scene(),
        acts in prop::collection::vec(any_action(), 1..8),
        double in any::<bool>(),
        sleep in any::<bool>(),
    ) {
        let precision = if double { Precision::Double } else { Precision::Single };
        let params = Params { sleep, precision, ramp: 0.05, ..Params::default() };
        let mut world = World::new(&scene, params).unwrap();
        let mut plain = World::new(&scene, Params { width: Width::Portable, ..params }).unwrap();
        for act in &acts {
            for _ in 0..8 {
                let input = input(act, &world);
                prop_assert_eq!(world.step(&input), plain.step(&input));
            }
            prop_assert!(world.poses().iter().all(|x| x.is_finite()));
            prop_assert_eq!(world.hash(), plain.hash());
            plain = World::new(&scene, params).unwrap();
            plain.restore(&world.snapshot()).unwrap();
        }
    }
}
