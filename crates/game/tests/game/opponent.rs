//! Opponents: what they choose follows from seed and budget, and they play by the rules.

use crate::common::{settled, tower};
use teeter_game::{
    Blocks, BreakdownRun, Candidate, Event, Game, IdealMove, IdealPosition, MoveEnd, MovePlan, Opponent, Phase, Record,
    RecordWriter, Recorder, Replay, Rules, Strength, Survey, Table, Tally, Thinking, Thought, TrialErrors, choose,
    contest, load_world, roll_out, save_world, verify,
};
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{TowerOptions, config};

fn official() -> Rules {
    Rules::of(Table::Official, 2)
}

fn world(config_text: &str) -> World {
    let scene = config(config_text, &TowerOptions::default()).expect("the notation is valid");
    settled(&scene).world().clone()
}

fn survey(world: &World, plans: &[MovePlan], budget: f64) -> Vec<Tally> {
    let survey = Survey { rules: official(), errors: TrialErrors::default(), budget, seed: 5 };
    survey.run(world, plans, || ()).expect("estimates are towers")
}

fn in_threads<R: Send>(threads: usize, act: impl FnOnce() -> R + Send) -> R {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started").install(act)
}

#[test]
fn a_block_without_which_the_tower_falls_by_statics_falls_in_every_rollout_and_a_loose_one_in_none() {
    let world = world("(111)-(010)-(1L1)-(111)-(010)");
    let bodies: Vec<BodyId> = world.bodies().collect();
    let ranked = Candidate::ranked(&world, &bodies);
    let find = |body: u32| *ranked.iter().find(|candidate| candidate.body == BodyId(body)).expect("it is ranked");
    let (bearer, loose) = (find(3), find(5));
    assert_eq!((bearer.falls, loose.falls), (Some(true), Some(false)));
    let tallies = survey(&world, &[bearer.plan(), loose.plan()], 60.0);
    assert!(tallies[0].falls.tries >= 4, "{tallies:?}");
    assert_eq!(tallies[0].falls.count, tallies[0].falls.tries);
    assert_eq!(tallies[1].falls.count, 0);
    assert!(tallies[1].freedom() > 0.0 && tallies[0].freedom() == 0.0);
    assert!(tallies[1].falls.interval()[1] < tallies[0].falls.interval()[0]);
}

#[test]
fn the_best_candidates_are_the_first_of_all() {
    for text in ["(111)-(010)-(1L1)-(111)-(010)", "(010)-(010)-(110)-(111)"] {
        let world = world(text);
        let bodies: Vec<BodyId> = world.bodies().collect();
        let ranked = Candidate::ranked(&world, &bodies);
        for count in [1, 2, 5, bodies.len()] {
            assert_eq!(Candidate::best(&world, &bodies, count), ranked[..count], "{text}");
        }
    }
}

#[test]
fn threads_change_no_bit_of_a_survey_or_of_a_choice() {
    let world = settled(&tower(5, 2)).world().clone();
    let bodies: Vec<BodyId> = world.bodies().take(9).collect();
    let thinking = Thinking { budget: 30.0, candidates: 3, ..Strength::Skilled.thinking() };
    let think = || choose(&world, &official(), &bodies, &thinking, 7).expect("estimates are towers");
    let (one, two) = (in_threads(1, think), in_threads(2, think));
    assert_eq!(one, two);
    assert!(one.iter().all(|considered| considered.tally.falls.tries >= 1));
}

#[test]
fn progress_is_one_only_when_every_move_is_analysed() {
    let scene = config("(010)-(101)-(010)-(111)", &TowerOptions::default()).expect("the notation is valid");
    let game = contest(&scene, official(), &[Strength::Random.thinking(); 2], 1).expect("the game begins");
    for budget in [0.0, 60.0] {
        let survey = Survey { rules: official(), errors: TrialErrors::default(), budget, seed: 1 };
        let mut run = BreakdownRun::new(Replay::new(&game.record).expect("it is a record"), survey);
        while !run.is_done() {
            assert!(run.progress() < 1.0, "{}", run.progress());
            run.step().expect("estimates are towers");
        }
        assert_eq!(run.progress(), 1.0);
        let breakdown = run.finish();
        assert!(breakdown.fall.is_some() && breakdown.moves.last().expect("a block was taken").fell);
    }
}

#[test]
fn a_rollout_follows_from_its_seed() {
    let world = settled(&tower(4, 2)).world().clone();
    let plan = Candidate::ranked(&world, &[BodyId(4)])[0].plan();
    let roll = |seed| roll_out(&world, &official(), plan, &TrialErrors::default(), seed).expect("it is a tower");
    let (first, again, other) = (roll(1), roll(1), roll(2));
    assert_eq!(first, again);
    assert!(first.moved != other.moved);
    assert!(!first.fell && first.end == Some(MoveEnd::Placed) && first.seconds < 20.0, "{first:?}");
}

#[test]
fn an_opponent_that_thinks_takes_the_safe_block_of_a_tower_where_others_fell_it() {
    // One block can be taken: the end of the second row.
    let world = world("(010)-(110)-(010)-(111)-(111)");
    let removable: Vec<BodyId> = (0..4).map(BodyId).collect();
    for strength in [Strength::Skilled, Strength::Expert] {
        let thinking = Thinking { budget: 40.0, ..strength.thinking() };
        let chosen = choose(&world, &official(), &removable, &thinking, 3).expect("estimates are towers");
        assert_eq!(chosen[0].candidate.body, BodyId(1), "{strength:?}: {chosen:?}");
    }
}

#[test]
fn an_expert_leaves_a_tower_that_loses_by_counting_where_it_can() {
    let world = settled(&tower(4, 2)).world().clone();
    let position = IdealPosition::of(&Blocks::of(&world)).expect("its rows are complete");
    assert!(position.is_won());
    let removable: Vec<BodyId> = (0..9).map(BodyId).collect();
    let leaves_a_loss = |body: BodyId| {
        let after = IdealMove::of(&Blocks::of(&world), body).and_then(|chosen| position.after(chosen));
        after.is_some_and(|after| !after.is_won())
    };
    assert!(!removable.iter().all(|body| leaves_a_loss(*body)));
    for seed in 0..3 {
        let thinking = Thinking { budget: 15.0, ..Strength::Expert.thinking() };
        let chosen = choose(&world, &official(), &removable, &thinking, seed).expect("estimates are towers");
        assert!(leaves_a_loss(chosen[0].candidate.body), "{chosen:?}");
    }
}

#[test]
fn a_turn_of_an_opponent_is_within_the_rules_and_its_game_replays() {
    let mut recorder = Recorder::new(&tower(5, 3), Params::default(), official()).expect("the scene is valid");
    let thinking = Thinking { budget: 1.0, candidates: 2, ..Strength::Skilled.thinking() };
    let mut opponent = Opponent::with_thinking(0, thinking, 4);
    let mut events = Vec::new();
    while recorder.game().turn().expect("there are turns").number == 1 && recorder.game().world().time() < 60.0 {
        let command = opponent.next(recorder.game());
        events.extend(recorder.step(&command).expect("the record is short").events);
    }
    let refused = |event: &Event| matches!(event, Event::Refused { .. } | Event::Illegal { .. } | Event::Fell { .. });
    assert!(!events.iter().any(refused) && events.contains(&Event::Settled { player: 0 }), "{events:?}");
    assert!(verify(&recorder.finish()).expect("the game begins").same);
}

#[test]
fn a_contest_ends_with_a_loser_and_its_record_ends_the_same() {
    let scene = config("(010)-(110)-(101)-(111)", &TowerOptions::default()).expect("the notation is valid");
    let random = [Strength::Random.thinking(); 2];
    let game = contest(&scene, official(), &random, 2).expect("a game can begin");
    let outcome = game.outcome.expect("it has an end");
    let mut replay = Replay::new(&game.record).expect("a game can begin");
    while replay.step().is_some() {}
    assert!(replay.is_same());
    let turn = replay.into_game().turn().expect("there are turns");
    assert_eq!((turn.phase, turn.outcome), (Phase::Over, Some(outcome)));
    assert_ne!(outcome.loser, outcome.winner);
}

#[test]
fn an_opponent_idles_in_free_play_and_in_the_turn_of_another() {
    let world = World::new(&tower(4, 1), Params::default()).expect("the scene is valid");
    let mut opponent = Opponent::new(1, Strength::Expert, 1);
    assert_eq!(opponent.next(&Game::new(world.clone())), teeter_game::Command::Idle);
    let mut game = Game::with_rules(world, official()).expect("the rules are valid");
    for _ in 0..90 {
        assert_eq!(opponent.next(&game), teeter_game::Command::Idle);
        game.step(&teeter_game::Command::Idle);
    }
}

/// Number of seeds of six for which the block that a strength chooses can be taken by statics, of a
/// tower with one such block of four.
fn safe_choices(world: &World, strength: Strength) -> usize {
    let removable: Vec<BodyId> = (0..4).map(BodyId).collect();
    let thinking = Thinking { budget: strength.thinking().budget.min(1.0), ..strength.thinking() };
    let chosen = |seed| choose(world, &official(), &removable, &thinking, seed).expect("estimates are towers");
    (0..6).filter(|seed| chosen(*seed)[0].candidate.body == BodyId(1)).count()
}

#[test]
fn opponents_that_think_find_the_one_safe_block_more_often_than_a_random_mover() {
    let world = world("(010)-(110)-(010)-(111)-(111)");
    let random = safe_choices(&world, Strength::Random);
    for strength in [Strength::Beginner, Strength::Skilled] {
        let safe = safe_choices(&world, strength);
        assert!(safe > random, "{strength:?} {safe} times of six, a random mover {random} times");
    }
}

/// Game of two opponents up to its end, or to a number of frames, from a game and the writer of its
/// record.
fn play_on(mut game: Game, mut writer: RecordWriter, opponents: &mut [Opponent]) -> Record {
    for _ in 0..20_000 {
        let Some(turn) = game.turn().filter(|turn| turn.phase != Phase::Over) else { break };
        let command = opponents[turn.player as usize].next(&game);
        game.step(&command);
        writer.write(&command, &game).expect("the record is short");
    }
    writer.finish(&game)
}

#[test]
fn a_game_that_is_reloaded_from_its_record_at_any_turn_goes_on_the_same() {
    let scene = config("(111)-(010)-(111)-(111)", &TowerOptions::default()).expect("the notation is valid");
    let opponents = || {
        let thinking = |strength: Strength| Thinking { budget: 1.0, candidates: 2, ..strength.thinking() };
        [(0, Strength::Skilled), (1, Strength::Beginner)].map(|(seat, s)| Opponent::with_thinking(seat, thinking(s), 5))
    };
    let world = World::new(&scene, Params::default()).expect("the scene is valid");
    let game = Game::with_rules(world, official()).expect("the rules are valid");
    let writer = RecordWriter::new(&scene, Params::default(), official());
    let whole = play_on(game, writer, &mut opponents());
    let mut replay = Replay::new(&whole).expect("the game begins");
    let mut starts = vec![0];
    while let Some(update) = replay.step() {
        let is_begun = update.events.iter().any(|event| matches!(event, Event::TurnStarted { .. }));
        starts.extend(is_begun.then(|| replay.frame()));
    }
    assert!(starts.len() >= 3, "turns begin in the frames {starts:?}");
    for start in starts {
        let mut replay = Replay::owning(Record::decode(&whole.encode()).expect("it is a record")).expect("it begins");
        while replay.frame() < start {
            replay.step();
        }
        let (game, writer) = replay.play_on().expect("it is the same so far");
        assert!(play_on(game, writer, &mut opponents()) == whole, "from frame {start} on");
    }
}

#[test]
fn a_question_that_is_answered_elsewhere_gives_the_same_game() {
    let scene = config("(111)-(010)-(111)-(111)", &TowerOptions::default()).expect("the notation is valid");
    let world = World::new(&scene, Params::default()).expect("the scene is valid");
    let mut game = Game::with_rules(world, official()).expect("the rules are valid");
    let thinking = Thinking { budget: 1.0, candidates: 2, ..Strength::Skilled.thinking() };
    let mut alone = Opponent::with_thinking(0, thinking, 4);
    let mut asked = alone.clone();
    let mut questions = 0;
    while game.turn().is_some_and(|turn| turn.number == 1 && turn.phase != Phase::Over) {
        let question = asked.question(&game).cloned();
        assert_eq!(asked.question(&game), question.as_ref(), "it is the same question until it is answered");
        if let Some(question) = question {
            let elsewhere = load_world(&save_world(game.world())).expect("it is a world");
            let mut thought = Thought::new(elsewhere, &question);
            let mut progress = 0.0;
            while !thought.is_done() {
                thought.step().expect("estimates are towers");
                assert!((progress..=1.0).contains(&thought.progress()), "{progress} {}", thought.progress());
                progress = thought.progress();
            }
            asked.answer(thought.considered().first().map(|considered| considered.candidate.plan()));
            questions += 1;
        }
        let command = alone.next(&game);
        assert_eq!(asked.next(&game), command);
        game.step(&command);
    }
    assert!(questions >= 1);
}
