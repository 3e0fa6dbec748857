//! Any sequence of commands can be played: none panics, and every update can be written.

use crate::common::tower;
use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::*;
use teeter_game::{CellId, Command, Game, GripMode, Rules, Table};
use teeter_physics::envelope::seal;
use teeter_physics::{BodyId, Params, World};
use teeter_scene::Form;

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -0.05..0.05f64,
        1 => -2.0..2.0f64,
        1 => prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(-1e300), Just(1e-300), Just(0.0)],
    ]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from)
}

fn body() -> impl Strategy<Value = BodyId> {
    prop_oneof![9 => 0..9u32, 1 => any::<u32>()].prop_map(BodyId)
}

fn grip() -> impl Strategy<Value = GripMode> {
    prop_oneof![Just(GripMode::Auto), Just(GripMode::Slide), Just(GripMode::Carry), Just(GripMode::Push)]
}

fn slot() -> impl Strategy<Value = Option<CellId>> {
    prop::option::of((prop_oneof![0..5u32, any::<u32>()], 0..4u32).prop_map(|(row, cell)| CellId { row, cell }))
}

fn command() -> impl Strategy<Value = Command> {
    let grasp = (body(), vector(), vector(), grip());
    let turn = [number(), number(), number(), number()];
    let viewer = prop::option::of([number(), number()].prop_map(DVec2::from));
    let set_hand = (prop::option::of(number()), any::<Option<bool>>(), any::<Option<bool>>(), prop::option::of(grip()));
    prop_oneof![
        4 => Just(Command::Idle),
        4 => grasp.prop_map(|(body, anchor, normal, grip)| Command::Grasp { body, anchor, normal, grip }),
        6 => (vector(), slot(), viewer).prop_map(|(displacement, slot, toward_viewer)| {
            Command::Move { displacement, slot, toward_viewer }
        }),
        2 => turn.prop_map(|q| Command::Turn { rotation: DQuat::from_array(q) }),
        2 => (prop::option::of(body()), slot()).prop_map(|(body, slot)| Command::Place { body, slot }),
        1 => Just(Command::Poke),
        1 => Just(Command::Release),
        1 => set_hand.prop_map(|(max_force, careful, can_turn, grip)| {
            Command::SetHand { max_force, careful, can_turn, grip }
        }),
        1 => (any::<bool>(), prop::option::of(prop_oneof![number(), Just(1e4), Just(1e6)])).prop_map(|(soft, k)| {
            Command::SetBlocks { form: if soft { Form::Lattice } else { Form::Rigid }, spring_stiffness: k }
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_commands_can_be_played(commands in prop::collection::vec((command(), 0..4u32), 1..60)) {
        let mut game = Game::new(World::new(&tower(3, 1), Params::default()).expect("the scene is valid"));
        for (command, pause) in commands {
            let update = game.step(&command);
            prop_assert!(serde_json::to_string(&update).is_ok());
            for _ in 0..pause {
                game.step(&Command::Idle);
            }
            prop_assert!(game.blocks().positions().iter().all(|p| p.is_finite()));
        }
        let bytes = game.snapshot();
        let restored = game.restore(&bytes);
        prop_assert!(restored.is_ok(), "{restored:?}");
    }

    #[test]
    fn damaged_snapshots_are_refused(at in any::<prop::sample::Index>(), value in any::<u8>()) {
        let (mut game, bytes) = placing();
        let mut damaged = bytes.clone();
        let at = at.index(bytes.len());
        damaged[at] = value;
        prop_assert_eq!(game.restore(&damaged).is_ok(), damaged == bytes);
        prop_assert!(game.restore(&bytes[..at]).is_err());
        prop_assert_eq!(game.snapshot(), bytes);
    }

    #[test]
    fn forged_snapshots_never_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let (mut game, bytes) = placing();
        let kind = b"teeter-game\x00\x05";
        let mut content = bytes[kind.len() + 16..].to_vec();
        // The world's own bytes come last and are checked by the physics.
        let own = content.len() - game.world().snapshot().len();
        for (at, value) in changes {
            content[at.index(own)] = value;
        }
        if game.restore(&seal(kind, &content)).is_ok() {
            for _ in 0..3 {
                game.step(&Command::Idle);
            }
        }
    }
}

/// A game by rules in which a block is being placed, and a snapshot of it.
fn placing() -> (Game, Vec<u8>) {
    let world = World::new(&tower(3, 1), Params::default()).expect("the scene is valid");
    let mut game = Game::with_rules(world, Rules::of(Table::Dissertation, 3)).expect("the rules are valid");
    game.step(&Command::Grasp { body: BodyId(7), anchor: DVec3::ZERO, normal: DVec3::Z, grip: GripMode::Auto });
    game.step(&Command::Place { body: None, slot: None });
    let bytes = game.snapshot();
    (game, bytes)
}
