//! Tests of the game with Jenga3D.

use serde_json::{Value, json};
use teeter_game::{CellId, Event, GripMode, HoldGrip, TowerState};
use teeter_scene::TowerOptions;

use super::*;

/// A tower of three rows as JSON.
fn tower() -> String {
    teeter_scene::tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap().to_json()
}

fn settled() -> Game<Space> {
    let mut game = Game::new(Space::new(&tower(), "{}").unwrap());
    for _ in 0..60 {
        game.step(&Command::Idle);
    }
    game
}

/// Grasps a block by its end along +x of its own frame.
fn grasp(game: &Game<Space>, body: BodyId, grip: GripMode) -> Command {
    let normal = game.blocks().orientation(body) * DVec3::X;
    Command::Grasp { body, anchor: DVec3::X * (0.5 * game.blocks().size(body).x), normal, grip }
}

fn read(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_top_block_is_lifted_and_set_down_in_its_row_again() {
    let mut game = settled();
    let body = BodyId(7);
    let start = game.blocks().position(body);
    game.step(&grasp(&game, body, GripMode::Auto));
    for _ in 0..30 {
        game.step(&Command::Move { displacement: DVec3::Z * 0.002, slot: None, toward_viewer: None });
    }
    assert!(game.blocks().position(body).z > start.z + 0.03);
    let commands = [Command::Place { body: None, slot: None }].into_iter().chain([Command::Idle; 240]);
    let events = commands.flat_map(|command| game.step(&command).events);
    let events: Vec<Event> = events.collect();
    assert_eq!(events, [Event::Placed { body, slot: CellId { row: 2, cell: 1 } }]);
    assert!(game.blocks().position(body).distance(start) < 2e-3);
    let update = game.step(&Command::Idle);
    assert_eq!((update.tower == TowerState::Fallen, update.fallen), (false, vec![]));
}

/// The lead of the target limits the force of a hand that has no limit of its own.
#[test]
fn a_block_in_the_tower_is_pulled_with_the_force_of_the_hand_at_most() {
    let mut game = settled();
    let (body, max_force) = (BodyId(4), 0.5);
    game.step(&Command::SetHand { max_force: Some(max_force), careful: None, can_turn: None, grip: None });
    game.step(&grasp(&game, body, GripMode::Auto));
    let displacement = game.blocks().orientation(body) * DVec3::X * 0.001;
    let mut greatest = 0.0f64;
    for _ in 0..60 {
        let update = game.step(&Command::Move { displacement, slot: None, toward_viewer: None });
        let hand = update.hand.expect("it is held");
        assert_eq!(hand.grip, HoldGrip::Slide);
        greatest = greatest.max(hand.force.length());
    }
    assert!(greatest > 0.5 * max_force && greatest < 1.1 * max_force, "{greatest} N");
}

#[test]
fn the_target_of_the_centre_is_that_of_the_grasped_point_less_the_arm() {
    let [mut space, mut same] = [(); 2].map(|()| Space::new(&tower(), "{}").unwrap());
    let (body, anchor) = (BodyId(7), DVec3::new(0.03, 0.0, 0.009));
    let arm = DQuat::from_slice(&space.views.poses[7 * POSE_STRIDE + 3..]) * anchor;
    let target = DVec3::new(0.02, 0.01, 0.1);
    let outcome = Simulator::step(&mut space, Some(&Hand::carry(body, anchor, target, DQuat::IDENTITY)));
    same.advance(Some(&jenga3d::Hand { block: 7, target: target - arm }));
    assert_eq!(space.views.poses, same.views.poses);
    assert!(outcome.max_speed > 0.0);
}

#[test]
fn the_hand_does_not_turn_blocks_and_their_springs_do_not_change() {
    let mut game = settled();
    game.step(&Command::SetHand { max_force: None, careful: None, can_turn: Some(true), grip: None });
    game.step(&grasp(&game, BodyId(7), GripMode::Auto));
    let turn = game.step(&Command::Turn { rotation: DQuat::from_rotation_z(0.5) });
    assert_eq!(turn.events, [Event::Refused { reason: "this hand cannot turn a block".to_owned() }]);
    let soft = Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(2e4) };
    let reason = "the springs of the 2003 blocks do not change".to_owned();
    assert_eq!(game.step(&soft).events, [Event::Refused { reason }]);
    assert!(!game.step(&Command::Idle).at_rest);
}

#[test]
fn commands_and_updates_are_text() {
    let mut game = SpaceGame::new(&tower(), r#"{"static_friction": "0.4", "disabling": "rigid"}"#).unwrap();
    let update = read(&game.step("").unwrap());
    assert_eq!((&update["tower"], &update["form"]), (&"moving".into(), &"lattice".into()), "rows fall on each other");
    assert!(["active", "rounds", "unresolved", "tests"].iter().all(|field| !update["report"][field].is_null()));
    let top = json!({"command": "grasp", "body": 7, "anchor": [0, 0, 0.009], "normal": [0, 0, 1], "grip": "auto"});
    let update = read(&game.step(&top.to_string()).unwrap());
    assert_eq!((&update["hand"]["body"], &update["hand"]["grip"]), (&7.into(), &"carry".into()));
    assert!(game.is_free(7).unwrap() && !game.is_free(0).unwrap());
    game.lattices_ptr();
    assert_eq!((game.length(), game.sizes().len(), game.lattices.len()), (9, 27, 9 * 52));
}

#[test]
fn text_that_is_no_command_is_an_error_of_one_line_and_changes_nothing() {
    let mut game = SpaceGame::new(&tower(), "{}").unwrap();
    for text in ["{", "grasp", r#"{"command": "jump"}"#, r#"{"command": "move"}"#] {
        let line = game.step(text).unwrap_err().to_string();
        assert!(line.starts_with("command: ") && !line.contains('\n'), "{line}");
    }
    assert_eq!(game.time(), 0.0);
    for error in [game.slots(9).map(drop), game.contacts(9).map(drop), game.can_place(9).map(drop)] {
        assert_eq!(error.unwrap_err().to_string(), "there is no block 9: the tower has 9");
    }
}

/// The hand of 2003 takes a block out of the row without a slot, a magnet or a limit; the block in
/// its care has not fallen.
#[test]
fn the_hand_of_2003_moves_a_block_by_requests() {
    let mut game = SpaceGame::new(&tower(), "{}").unwrap();
    let mut step = |requests: &[Value]| {
        for request in requests {
            game.request(&request.to_string()).unwrap();
        }
        (read(&game.step("").unwrap()), game.game.blocks().position(BodyId(4)))
    };
    (0..30).for_each(|_| drop(step(&[])));
    let (_, start) = step(&[]);
    // The end of the middle block of the second row, seen along y.
    let pointer = json!({"origin": [0, -0.5, 0.028], "direction": [0, 1, 0], "toward_viewer": [0, -1, 0]});
    let (update, _) = step(&[json!({"request": "pick", "pointer": pointer})]);
    assert_eq!(update["report"]["hand"]["body"], 4);
    assert!(update["hand"].is_null(), "the hand of the game holds nothing");
    for _ in 0..10 {
        step(&[json!({"request": "pull", "distance": 0.02, "toward_viewer": [0, -1, 0]})]);
    }
    let (update, out) = step(&[]);
    assert!(start.y - out.y > 0.15, "{start} {out}");
    assert!(!update["fallen"].as_array().unwrap().contains(&4.into()), "it is in the player's care");
    let (update, _) = step(&[json!({"request": "release"})]);
    assert!(update["report"]["hand"].is_null());
}

#[test]
fn constants_change_on_a_standing_tower() {
    let mut game = SpaceGame::new(&tower(), "{}").unwrap();
    game.step("").unwrap();
    game.set_constants(r#"{"disabling": "off", "friction_enabled": "false"}"#).unwrap();
    game.set_constants(r#"{"order": "top-down"}"#).unwrap();
    game.step("").unwrap();
    let constants = &game.game.world().jenga.constants;
    assert_eq!(constants.disabling, teeter_dissertation::jenga3d::Disabling::Off);
    assert_eq!(constants.order, teeter_dissertation::jenga3d::Order::TopDown);
    assert!(!constants.friction_enabled);
    // Refused by value and range, or with what depends on it; nothing changes.
    for (text, part) in [
        (r#"{"restitution": "2"}"#, "`restitution` is 2"),
        (r#"{"stiffness": "1e8"}"#, "`stiffness`"),
        (r#"{"colour": "red"}"#, "`colour`"),
        (r#"{"frame_rate": "30"}"#, "`frame_rate`"),
        ("{", "constants: "),
    ] {
        let line = game.set_constants(text).unwrap_err().to_string();
        assert!(line.contains(part) && !line.contains('\n'), "{line}");
    }
    game.step("").unwrap();
    let table = read(&SpaceGame::constants().unwrap());
    let names: Vec<&str> = table.as_array().unwrap().iter().map(|entry| entry["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"stiffness") && !names.contains(&"frame_rate"), "{names:?}");
}

#[test]
fn text_that_is_no_request_is_refused() {
    let game = SpaceGame::new(&tower(), "{}").unwrap();
    for text in ["{", r#"{"request": "jump"}"#, r#"{"request": "pull", "distance": 1, "toward_viewer": [0, 0, 0]}"#] {
        let line = game.request(text).unwrap_err().to_string();
        assert!(line.starts_with("request: ") && !line.contains('\n'), "{line}");
    }
}
