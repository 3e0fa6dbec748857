//! Play on a tower: a loose block comes out and goes on top, a tight one stays, a poke pushes, and
//! illegal commands change nothing.

use crate::common::{block, displace, grasp, idle, others, refusal, settled, tower};
use glam::{DQuat, DVec3};
use teeter_game::{CellId, Command, Event, Game, GripMode, HoldGrip, TakeAndPlace, TowerMap, TowerState};
use teeter_physics::{BodyId, Params, World};
use teeter_scene::Form;

#[test]
fn a_loose_block_is_taken_out_and_placed_on_top_while_the_tower_stands() {
    let mut game = settled(&tower(18, 1));
    let body = block(&game, true);
    let before = game.blocks().positions().to_vec();
    let toward = game.blocks().orientation(body) * DVec3::X;
    let mut script = TakeAndPlace::new(body, toward, 0.08, None);
    let (mut placed, mut grips) = (None, Vec::new());
    while let Some(command) = script.next(&game) {
        let update = game.step(&command);
        assert_eq!(refusal(&update), None, "{command:?}");
        grips.extend(update.hand.map(|hand| hand.grip));
        placed = placed.or(update.events.into_iter().find_map(|event| match event {
            Event::Placed { body, slot } => Some((body, slot)),
            _ => None,
        }));
        assert!(grips.len() < 900, "the block is placed within 15 s");
    }
    grips.dedup();
    assert_eq!(grips, [HoldGrip::Slide, HoldGrip::Carry]);
    let (placed, slot) = placed.expect("the block is placed");
    assert_eq!((placed, slot.row), (body, 18));
    let update = idle(&mut game, 120).expect("two seconds");
    assert_eq!((update.tower, update.fallen, update.at_rest), (TowerState::Standing, vec![], true));
    assert!(others(&game, &before, body) < 1e-3, "{} m", others(&game, &before, body));
    assert_eq!(TowerMap::new(game.blocks(), None).cell_of(body), Some(slot));
}

#[test]
fn a_block_that_carries_the_tower_does_not_move_and_the_update_says_what_holds_it() {
    let mut game = settled(&tower(18, 1));
    let body = block(&game, false);
    let before = game.blocks().positions().to_vec();
    game.step(&Command::SetHand { max_force: Some(0.5), careful: None, can_turn: None, grip: None });
    game.step(&grasp(&game, body, GripMode::Auto));
    let along = game.blocks().orientation(body) * DVec3::X;
    let mut stuck = None;
    for _ in 0..60 {
        let hand = game.step(&displace(along * 0.001)).hand.expect("it is held");
        assert!(hand.force.length() <= 0.501 && hand.goal.distance(hand.point) <= 0.0601, "{hand:?}");
        if hand.stuck_s > 0.15 {
            stuck = Some(hand);
        }
    }
    let hand = stuck.expect("the block is stuck");
    assert!(hand.capped && hand.grip == HoldGrip::Slide);
    assert!(hand.contacts.iter().any(|c| c.other.is_some() && c.force > 0.1), "{:?}", hand.contacts);
    assert!(game.blocks().position(body).distance(before[body.index()]) < 1e-3);
}

#[test]
fn a_poke_pushes_a_loose_block_inwards_and_lets_go() {
    let mut game = settled(&tower(18, 1));
    let body = block(&game, true);
    let before = game.blocks().positions().to_vec();
    let inward = game.blocks().orientation(body) * DVec3::NEG_X;
    game.step(&grasp(&game, body, GripMode::Auto));
    let update = game.step(&Command::Poke);
    assert!(update.hand.is_some_and(|hand| hand.poking && hand.grip == HoldGrip::Push));
    let events: Vec<Event> = (0..30).flat_map(|_| game.step(&Command::Idle).events).collect();
    assert_eq!(events, [Event::Poked { body }]);
    let moved = (game.blocks().position(body) - before[body.index()]).dot(inward);
    assert!(moved > 0.002 && moved < 0.008, "{moved} m");
    assert!(others(&game, &before, body) < 1e-3);
}

#[test]
fn a_block_that_was_moved_is_let_go_by_a_tap_and_not_poked() {
    let mut game = settled(&tower(18, 1));
    let body = block(&game, true);
    game.step(&grasp(&game, body, GripMode::Auto));
    game.step(&displace(game.blocks().orientation(body) * DVec3::X * 0.01));
    let update = game.step(&Command::Poke);
    assert_eq!((update.events, update.hand), (vec![Event::Released { body }], None));
}

#[test]
fn a_carried_block_that_is_turned_goes_round_its_centre() {
    let mut game = settled(&tower(6, 1));
    let top = game.blocks().bodies().rev().nth(1).expect("a tower");
    game.step(&grasp(&game, top, GripMode::Auto));
    for _ in 0..30 {
        game.step(&displace(DVec3::Z * 0.004));
    }
    let before = game.blocks().position(top);
    let quarter = DQuat::from_xyzw(0.0, 0.0, libm::sqrt(0.5), libm::sqrt(0.5));
    let turn = game.blocks().orientation(top);
    game.step(&Command::Turn { rotation: quarter });
    idle(&mut game, 90);
    let angle = teeter_game::angle_between(turn, game.blocks().orientation(top));
    assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 0.02, "{angle} rad");
    assert!((game.blocks().position(top) - before).truncate().length() < 0.002);
}

#[test]
fn a_block_below_the_floor_is_not_asked_for() {
    let mut game = settled(&tower(6, 1));
    let top = game.blocks().bodies().rev().nth(1).expect("a tower");
    game.step(&grasp(&game, top, GripMode::Carry));
    let hand = game.step(&displace(DVec3::NEG_Z)).hand.expect("it is held");
    assert!(hand.goal.z > 0.0, "{}", hand.goal);
}

#[test]
fn a_carried_block_has_slots_and_one_of_them_attracts_it() {
    let mut game = settled(&tower(6, 1));
    let top = game.blocks().bodies().rev().nth(1).expect("a tower");
    game.step(&grasp(&game, top, GripMode::Auto));
    for _ in 0..30 {
        game.step(&displace(DVec3::Z * 0.003));
    }
    let slots = game.step(&Command::Idle).slots;
    assert_eq!(slots.len(), 1, "its own cell is free");
    let slot = slots[0].id();
    assert_eq!(slot, CellId { row: 5, cell: 1 });
    let attract = Command::Move { displacement: DVec3::ZERO, slot: Some(slot), toward_viewer: None };
    assert_eq!(game.step(&attract).hand.expect("it is held").slot, Some(slot));
    idle(&mut game, 150);
    let over = game.blocks().position(top) - slots[0].position;
    assert!(over.truncate().length() < 1e-3 && over.z > 0.0 && over.z < 0.004, "hovers above its slot: {over}");
    let events: Vec<Event> = std::iter::once(Command::Place { body: None, slot: None })
        .chain(std::iter::repeat_n(Command::Idle, 90))
        .flat_map(|command| game.step(&command).events)
        .collect();
    assert_eq!(events, [Event::Placed { body: top, slot }]);
}

#[test]
fn a_hand_that_cannot_turn_takes_only_slots_in_which_a_block_lies_as_it_does() {
    let mut game = settled(&tower(6, 1));
    let body = BodyId(15);
    assert_eq!(game.slots(body).len(), 1, "the other two of its row are there");
    let lower = block(&game, true);
    assert_eq!(game.slots(lower).len(), 3);
    game.step(&Command::SetHand { max_force: None, careful: None, can_turn: Some(false), grip: None });
    let is_across = (lower.0 / 3) % 2 == 1;
    assert_eq!(game.slots(lower).len(), if is_across { 0 } else { 3 }, "the new row lies along x");
}

#[test]
fn illegal_commands_change_nothing_and_say_why() {
    let mut game = settled(&tower(6, 1));
    let anchor = DVec3::ZERO;
    let grasp_of = |body, anchor, normal| Command::Grasp { body: BodyId(body), anchor, normal, grip: GripMode::Auto };
    for (command, reason) in [
        (grasp_of(99, anchor, DVec3::X), "there is no body 99: the world has 18"),
        (grasp_of(1, DVec3::X, DVec3::X), "`anchor` is [1, 0, 0], expected a point of the block"),
        (grasp_of(1, DVec3::NAN, DVec3::X), "`anchor` is [NaN, NaN, NaN], expected a point of the block"),
        (grasp_of(1, anchor, DVec3::ZERO), "`normal` is [0, 0, 0], expected a direction"),
        (displace(DVec3::X), "no block is held"),
        (Command::Turn { rotation: DQuat::IDENTITY }, "no block is held"),
        (Command::Poke, "no block is held"),
        (Command::Release, "no block is held"),
        (Command::Place { body: None, slot: None }, "no block is held"),
        (Command::Place { body: Some(BodyId(1)), slot: None }, "block 1 is not free"),
        (
            Command::Place { body: Some(BodyId(16)), slot: Some(CellId { row: 9, cell: 0 }) },
            "there is no free slot for block 16",
        ),
        (
            Command::SetHand { max_force: Some(-1.0), careful: None, can_turn: None, grip: None },
            "`max_force` is -1, expected 0 to 50 N",
        ),
        (
            Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(5.0) },
            "`springs.stiffness` is 5, expected 1e3 to 1e8 N/m",
        ),
    ] {
        let mut idle = game.clone();
        let update = game.step(&command);
        assert_eq!(refusal(&update), Some(reason));
        idle.step(&Command::Idle);
        assert_eq!(idle.snapshot(), game.snapshot(), "{command:?}");
    }
    game.step(&grasp(&game, BodyId(4), GripMode::Auto));
    assert_eq!(refusal(&game.step(&grasp(&game, BodyId(5), GripMode::Auto))), Some("block 4 is held"));
    let turn = Command::Turn { rotation: DQuat::IDENTITY };
    assert_eq!(refusal(&game.step(&turn)), Some("block 4 is not carried"));
}

#[test]
fn blocks_become_soft_and_rigid_again_while_the_tower_stands() {
    let mut game = settled(&tower(6, 1));
    let soft = Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(1e4) };
    let update = game.step(&soft);
    assert_eq!((update.form, update.spring_stiffness), (Form::Lattice, Some(1e6)));
    let update = idle(&mut game, 120).expect("two seconds");
    assert_eq!((update.form, update.spring_stiffness, update.tower), (Form::Lattice, Some(1e4), TowerState::Standing));
    game.step(&Command::SetBlocks { form: Form::Rigid, spring_stiffness: None });
    let update = idle(&mut game, 180).expect("three seconds");
    assert_eq!((update.form, update.spring_stiffness, update.tower), (Form::Rigid, None, TowerState::Standing));
}

#[test]
fn blocks_that_fall_are_named() {
    let scene = teeter_scene::config("(111)-(100)-(111)", &teeter_scene::TowerOptions::exact()).expect("a tower");
    let mut game = Game::new(World::new(&scene, Params::default()).expect("the scene is valid"));
    let events: Vec<Event> = (0..120).flat_map(|_| game.step(&Command::Idle).events).collect();
    let update = game.step(&Command::Idle);
    assert_eq!(update.tower, TowerState::Fallen);
    let named: Vec<BodyId> = events
        .into_iter()
        .flat_map(|event| match event {
            Event::Fell { bodies } => bodies,
            _ => Vec::new(),
        })
        .collect();
    assert_eq!(named.len(), update.fallen.len());
    assert!(named.iter().all(|body| update.fallen.contains(body)) && !named.is_empty());
}
