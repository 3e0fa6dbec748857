//! Turns as players see them: phases, illegal commands, and who loses.

use crate::common::{block, displace, grasp, tower};
use glam::DVec3;
use teeter_game::{
    Command, Event, Game, GripMode, Illegal, Outcome, Phase, Rules, RulesError, Table, TakeAndPlace, TurnState, Update,
};
use teeter_physics::{BodyId, Params, StepReport, World};
use teeter_scene::{Form, Scene, TowerOptions};

fn play(scene: &Scene, rules: Rules) -> Game {
    let world = World::new(scene, Params::default()).expect("the scene is valid");
    let mut game = Game::with_rules(world, rules).expect("the rules are valid");
    idle(&mut game, 60);
    game
}

fn official(rows: u32, players: u32) -> Game {
    play(&tower(rows, 3), Rules::of(Table::Official, players))
}

fn config(notation: &str) -> Scene {
    teeter_scene::config(notation, &TowerOptions::default()).expect("the notation is valid")
}

fn idle(game: &mut Game, frames: u32) -> Vec<Event> {
    (0..frames).flat_map(|_| game.step(&Command::Idle).events).collect()
}

fn turn(game: &Game) -> TurnState {
    game.turn().expect("there are turns")
}

fn out_direction(game: &Game, body: BodyId) -> DVec3 {
    game.blocks().orientation(body) * DVec3::X
}

/// Takes a block out and places it, and returns the events and the phases in between.
fn take(game: &mut Game, body: BodyId) -> (Vec<Event>, Vec<Phase>) {
    let mut script = TakeAndPlace::new(body, out_direction(game, body), 0.1, None);
    let (mut events, mut phases) = (Vec::new(), Vec::new());
    while let Some(command) = script.next(game) {
        events.extend(game.step(&command).events);
        phases.push(turn(game).phase);
        assert!(phases.len() < 900);
    }
    phases.dedup();
    (events, phases)
}

/// Moves a block by `distance` (m) along its length and lets go.
fn nudge(game: &mut Game, body: BodyId, distance: f64) -> Vec<Event> {
    let along = out_direction(game, body);
    let mut events = game.step(&grasp(game, body, GripMode::Slide)).events;
    for _ in 0..40 {
        events.extend(game.step(&displace(along * (distance / 40.0))).events);
    }
    events.extend(idle(game, 30));
    events.extend(game.step(&Command::Release).events);
    events
}

fn illegal(update: &Update<StepReport>) -> Option<Illegal> {
    update.events.iter().find_map(|event| match event {
        Event::Illegal { rule, reason } => {
            assert_eq!(*reason, rule.to_string());
            Some(*rule)
        }
        _ => None,
    })
}

#[test]
fn a_turn_passes_through_its_phases_and_to_the_next_player() {
    let mut game = official(6, 2);
    assert_eq!((turn(&game).player, turn(&game).number, turn(&game).removable.len()), (0, 1, 15));
    let body = block(&game, true);
    let (events, phases) = take(&mut game, body);
    assert_eq!(phases, [Phase::Choosing, Phase::Removing, Phase::Placing, Phase::Settling]);
    assert!(events.contains(&Event::Nudged { player: 0, body }));
    assert!(events.contains(&Event::Removed { player: 0, body }));
    assert_eq!((turn(&game).block, turn(&game).removable), (Some(body), vec![body]));
    let elapsed = turn(&game).elapsed_s;
    let events = idle(&mut game, 120);
    assert_eq!(events, [Event::Settled { player: 0 }, Event::TurnStarted { player: 1, number: 2 }]);
    let next = turn(&game);
    assert_eq!((next.player, next.number, next.phase, next.block), (1, 2, Phase::Choosing, None));
    assert!(elapsed > 1.0 && next.elapsed_s < elapsed, "{elapsed} s");
    // The unfinished row protects the complete one beneath; a block is missing below.
    assert_eq!(next.removable.len(), 14);
    assert!(!next.removable.contains(&body));
}

#[test]
fn the_first_frame_reports_the_first_turn_once() {
    let world = World::new(&tower(4, 1), Params::default()).unwrap();
    let rules = Rules { first: 1, ..Rules::of(Table::Official, 3) };
    let mut game = Game::with_rules(world, rules).unwrap();
    assert_eq!(idle(&mut game, 3), [Event::TurnStarted { player: 1, number: 1 }]);
}

#[test]
fn an_illegal_command_is_refused_by_its_rule_and_changes_nothing() {
    let mut game = official(6, 2);
    let top = BodyId(17);
    let strong = Command::SetHand { max_force: Some(9.0), careful: None, can_turn: None, grip: None };
    let cases = [
        (grasp(&game, top, GripMode::Auto), Illegal::TooHigh { body: top }),
        (Command::Place { body: Some(top), slot: None }, Illegal::TooHigh { body: top }),
        (Command::Place { body: Some(BodyId(4)), slot: None }, Illegal::NotTakenOut),
        (strong, Illegal::TooStrong { max_force: 4.0 }),
        (Command::Rebuild, Illegal::NotOver),
    ];
    for (command, rule) in cases {
        let mut idle = game.clone();
        idle.step(&Command::Idle);
        let update = game.step(&command);
        assert_eq!(illegal(&update), Some(rule), "{command:?}");
        assert_eq!(game.snapshot(), idle.snapshot(), "{command:?}");
    }
    let body = block(&game, true);
    nudge(&mut game, body, 0.006);
    let soft = Command::SetBlocks { form: Form::Lattice, spring_stiffness: None };
    assert_eq!(illegal(&game.step(&soft)), Some(Illegal::BlockForm));
}

#[test]
fn a_block_that_was_moved_is_put_back_before_another_is_touched() {
    let mut game = official(6, 2);
    let body = block(&game, true);
    let other = turn(&game).removable.into_iter().rfind(|other| *other != body).unwrap();
    let events = nudge(&mut game, body, 0.008);
    assert!(events.contains(&Event::Nudged { player: 0, body }), "{events:?}");
    assert_eq!((turn(&game).phase, turn(&game).removable), (Phase::Removing, vec![body]));
    let update = game.step(&grasp(&game, other, GripMode::Auto));
    assert_eq!(illegal(&update), Some(Illegal::PutBackFirst { body }));
    let events = nudge(&mut game, body, -0.008);
    assert!(events.contains(&Event::PutBack { player: 0, body }), "{events:?}");
    assert_eq!(turn(&game).phase, Phase::Choosing);
    let update = game.step(&grasp(&game, other, GripMode::Auto));
    assert_eq!(update.events, [Event::Grasped { body: other }]);
}

#[test]
fn a_touch_alone_moves_no_block() {
    let mut game = official(6, 2);
    let body = block(&game, true);
    nudge(&mut game, body, 0.002);
    assert_eq!((turn(&game).phase, turn(&game).block), (Phase::Choosing, None));
}

#[test]
fn strict_rules_bind_a_player_to_the_block_that_was_moved_and_friendly_ones_do_not() {
    let mut strict = play(&tower(6, 3), Rules::of(Table::Strict, 2));
    let body = block(&strict, true);
    nudge(&mut strict, body, 0.008);
    let other = BodyId(if body.0 == 4 { 5 } else { 4 });
    let update = strict.step(&grasp(&strict, other, GripMode::Auto));
    assert_eq!(illegal(&update), Some(Illegal::MustTake { body }));

    let mut friendly = play(&tower(6, 3), Rules::of(Table::Friendly, 2));
    let update = friendly.step(&grasp(&friendly, BodyId(1), GripMode::Auto));
    assert_eq!(illegal(&update), Some(Illegal::BottomRow { body: BodyId(1) }));
    nudge(&mut friendly, body, 0.008);
    let update = friendly.step(&grasp(&friendly, other, GripMode::Auto));
    assert_eq!(update.events, [Event::Grasped { body: other }]);
}

#[test]
fn one_block_is_taken_in_a_turn_and_it_must_be_placed() {
    let mut game = official(6, 2);
    let body = block(&game, true);
    let along = out_direction(&game, body);
    game.step(&grasp(&game, body, GripMode::Auto));
    for _ in 0..120 {
        game.step(&displace(along * 0.0012));
    }
    assert_eq!(turn(&game).phase, Phase::Placing);
    // On the table it is out of the hand and of the tower.
    for _ in 0..60 {
        game.step(&displace(DVec3::NEG_Z * 0.002));
    }
    game.step(&Command::Release);
    idle(&mut game, 60);
    assert_eq!((turn(&game).phase, turn(&game).player), (Phase::Placing, 0));
    let other = BodyId(if body.0 == 4 { 5 } else { 4 });
    let update = game.step(&grasp(&game, other, GripMode::Auto));
    assert_eq!(illegal(&update), Some(Illegal::OneBlock { body }));
    game.step(&Command::Place { body: Some(body), slot: None });
    let events = idle(&mut game, 500);
    assert!(events.contains(&Event::Settled { player: 0 }), "{events:?}");
}

#[test]
fn the_touch_of_the_next_player_ends_the_turn_and_that_of_the_same_block_does_not() {
    let mut game = official(6, 3);
    let body = block(&game, true);
    take(&mut game, body);
    assert_eq!(turn(&game).phase, Phase::Settling);
    let mut adjusted = game.clone();
    adjusted.step(&grasp(&adjusted, body, GripMode::Auto));
    assert_eq!((turn(&adjusted).phase, turn(&adjusted).player), (Phase::Placing, 0));

    // A touch that is illegal for the next player changes nothing.
    let update = game.step(&grasp(&game, BodyId(16), GripMode::Auto));
    assert_eq!(illegal(&update), Some(Illegal::TooHigh { body: BodyId(16) }));
    assert_eq!((turn(&game).phase, turn(&game).player), (Phase::Settling, 0));
    let other = block(&game, false);
    let update = game.step(&grasp(&game, other, GripMode::Auto));
    let started = Event::TurnStarted { player: 1, number: 2 };
    assert_eq!(update.events, [Event::Settled { player: 0 }, started, Event::Grasped { body: other }]);
}

#[test]
fn a_turn_ends_ten_seconds_after_placing_while_the_tower_still_moves() {
    // Before the tower can be found at rest, which takes a quarter of a second.
    let mut game = play(&tower(6, 3), Rules { settle_s: 0.2, ..Rules::of(Table::Official, 2) });
    let body = block(&game, true);
    take(&mut game, body);
    let events = idle(&mut game, 12);
    assert!(events.contains(&Event::Settled { player: 0 }), "{events:?}");
    assert_eq!(Rules::of(Table::Official, 2).settle_s, 10.0);
}

/// A game in which the player to move draws the only block out that bears the top.
fn felled(rules: Rules) -> (Game, Vec<Event>) {
    let mut game = play(&config("(111)-(010)-(111)-(111)"), rules);
    let support = BodyId(3);
    let along = out_direction(&game, support);
    let mut events = game.step(&grasp(&game, support, GripMode::Slide)).events;
    for _ in 0..240 {
        events.extend(game.step(&displace(along * 0.001)).events);
    }
    (game, events)
}

#[test]
fn the_player_in_whose_turn_a_block_falls_loses_to_the_one_before() {
    let rules = Rules { first: 1, ..Rules::of(Table::Official, 3) };
    let (mut game, events) = felled(rules);
    assert!(events.contains(&Event::Lost { player: 1 }) && events.contains(&Event::Won { player: 0 }), "{events:?}");
    let state = turn(&game);
    assert_eq!((state.phase, state.outcome), (Phase::Over, Some(Outcome { loser: Some(1), winner: Some(0) })));
    assert!(state.removable.is_empty());
    game.step(&Command::Release);
    assert_eq!(illegal(&game.step(&grasp(&game, BodyId(1), GripMode::Auto))), Some(Illegal::Over));
    assert_eq!(illegal(&game.step(&Command::Resign)), Some(Illegal::Over));
}

#[test]
fn the_collapser_rebuilds_the_same_tower_and_begins() {
    let rules = Rules { first: 1, ..Rules::of(Table::Official, 2) };
    let (mut game, _) = felled(rules);
    let mut fresh =
        Game::with_rules(World::new(&config("(111)-(010)-(111)-(111)"), Params::default()).unwrap(), rules).unwrap();
    let update = game.step(&Command::Rebuild);
    fresh.step(&Command::Idle);
    assert!(update.events.contains(&Event::Rebuilt), "{:?}", update.events);
    assert_eq!(game.hash(), fresh.hash());
    assert_eq!((turn(&game).player, turn(&game).phase, turn(&game).number), (1, Phase::Choosing, 1));
    assert_eq!(idle(&mut game, 2).len(), 1, "the first turn is reported");
}

#[test]
fn a_player_who_gives_up_is_out_and_the_last_one_wins() {
    let mut game = official(4, 3);
    let body = block(&game, true);
    game.step(&grasp(&game, body, GripMode::Auto));
    let update = game.step(&Command::Resign);
    assert_eq!(
        update.events,
        [Event::Resigned { player: 0 }, Event::TurnStarted { player: 1, number: 2 }, Event::Released { body }]
    );
    assert_eq!(turn(&game).out, [0]);
    let update = game.step(&Command::Resign);
    assert_eq!(update.events, [Event::Resigned { player: 1 }, Event::Lost { player: 1 }, Event::Won { player: 2 }]);
    let mut alone = play(&tower(4, 1), Rules::of(Table::Solo, 1));
    alone.step(&Command::Resign);
    assert_eq!(turn(&alone).outcome, Some(Outcome { loser: Some(0), winner: None }));
    let free = Game::new(World::new(&tower(4, 1), Params::default()).unwrap()).step(&Command::Resign);
    assert_eq!(free.events, [Event::Refused { reason: "this is free play: there are no turns".into() }]);
}

#[test]
fn a_player_whose_time_runs_out_is_out() {
    let mut game = play(&tower(4, 1), Rules { turn_s: Some(1.5), ..Rules::of(Table::Strict, 2) });
    assert!((turn(&game).left_s.unwrap() - 0.5).abs() < 1e-9);
    let events = idle(&mut game, 30);
    assert_eq!(events, [Event::TimedOut { player: 0 }, Event::Lost { player: 0 }, Event::Won { player: 1 }]);
}

#[test]
fn solo_scores_a_block_and_more_for_one_that_completes_a_row() {
    let mut game = play(&config("(111)-(1L1)-(1L1)-(111)-(110)"), Rules::of(Table::Solo, 1));
    assert_eq!(turn(&game).scores, [0]);
    for (body, score) in [(BodyId(4), 4), (BodyId(7), 5)] {
        let (events, phases) = take(&mut game, body);
        let settled = idle(&mut game, 120);
        assert_eq!(turn(&game).scores, [score], "{phases:?} {events:?} {settled:?}");
    }
}

#[test]
fn the_die_says_which_rows_and_cells_give_blocks() {
    let mut game = play(&tower(6, 3), Rules { die: Some(5), ..Rules::of(Table::ThrowAndGo, 2) });
    let state = turn(&game);
    let throw = state.throw.expect("the die was thrown");
    let map = teeter_game::TowerMap::new(game.blocks(), None);
    for body in (0..15).map(BodyId) {
        let is_allowed = throw.allows(map.cell_of(body).unwrap());
        assert_eq!(state.removable.contains(&body), is_allowed);
        let update = game.clone().step(&grasp(&game, body, GripMode::Auto));
        assert_eq!(illegal(&update), (!is_allowed).then_some(Illegal::NotThrown { body }));
    }
    let body = state.removable[0];
    game.step(&grasp(&game, body, GripMode::Auto));
}

#[test]
fn in_the_rules_of_2003_a_block_from_anywhere_may_be_put_anywhere() {
    let mut game = play(&tower(4, 1), Rules::of(Table::Dissertation, 2));
    let top = BodyId(10);
    game.step(&grasp(&game, top, GripMode::Auto));
    for _ in 0..80 {
        game.step(&displace(DVec3::new(0.0, 0.002, 0.0005)));
    }
    assert_eq!(turn(&game).phase, Phase::Placing);
    for _ in 0..80 {
        game.step(&displace(DVec3::NEG_Z * 0.002));
    }
    game.step(&Command::Release);
    let events = idle(&mut game, 120);
    assert_eq!((turn(&game).player, turn(&game).phase), (1, Phase::Choosing), "{events:?}");
}

#[test]
fn free_play_has_no_turns_and_reports_as_a_game_without_rules() {
    let scene = tower(4, 1);
    let world = || World::new(&scene, Params::default()).unwrap();
    let mut free = Game::with_rules(world(), Rules::default()).unwrap();
    let mut plain = Game::new(world());
    assert_eq!((free.turn(), free.rules().table), (None, Table::Free));
    for command in [Command::Idle, grasp(&plain, BodyId(10), GripMode::Auto), displace(DVec3::Z * 0.01)] {
        let (a, b) = (free.step(&command), plain.step(&command));
        assert_eq!(a, b);
        assert!(!serde_json::to_string(&a).unwrap().contains("turn"));
    }
    assert_eq!(free.snapshot(), plain.snapshot());
}

#[test]
fn a_tower_that_gives_no_block_is_no_game() {
    let world = World::new(&config("(111)"), Params::default()).unwrap();
    let error = Game::with_rules(world, Rules::of(Table::Official, 2)).unwrap_err();
    assert_eq!(error, RulesError::NoBlock);
}
