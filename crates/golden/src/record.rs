//! Recording of inputs: a sweep of two rows, a hand that moves a loose block to the top, the
//! commands of a game, and a game of opponents.
//!
//! The path of the hand is computed from a world once. Playback reads the recorded targets.

use std::path::Path;

use glam::{DQuat, DVec2, DVec3};
use serde::Serialize;
use teeter_game::{
    Command, Game, GripMode, HandPath, Opponent, Phase, Recorder, Rules, Strength, Table, TakeAndPlace, Thinking,
};
use teeter_physics::{BodyId, Drive, Grip, Hand, Input, Params, World};
use teeter_scene::{Form, TowerOptions, tower};

use crate::error::GoldenError;
use crate::files::{write, write_bytes};

/// Number of steps in which the tower settles first.
const SETTLE_STEPS: usize = 60;

/// Records all inputs.
///
/// # Errors
/// When a file cannot be written, or the tower has no loose block.
pub fn record(dir: &Path) -> Result<(), GoldenError> {
    write(dir, "sweep.jsonl", &lines(&sweep()))?;
    write(dir, "pull.jsonl", &lines(&pull()?))?;
    write(dir, "game.jsonl", &lines(&game()?))?;
    write_bytes(dir, CONTEST, &contest()?)
}

/// File of the game of opponents.
pub const CONTEST: &str = "contest.record";

/// Returns the record of a whole game between two opponents on a tower of four rows. The page's
/// engine plays the same game, see `web/tests/opponent.test.mjs`.
///
/// # Errors
/// When no game can begin.
pub fn contest() -> Result<Vec<u8>, GoldenError> {
    let scene = tower(&TowerOptions { rows: 4, seed: 11, ..TowerOptions::default() }).expect("the options are valid");
    let players = [Strength::Skilled, Strength::Beginner];
    let mut recorder = Recorder::new(&scene, Params::default(), Rules::of(Table::Official, 2))?;
    let thinking = |strength: Strength| Thinking { budget: 10.0, ..strength.thinking() };
    let mut opponents: Vec<Opponent> =
        (0..).zip(players).map(|(seat, player)| Opponent::with_thinking(seat, thinking(player), 7)).collect();
    while let Some(turn) = recorder.game().turn().filter(|turn| turn.phase != Phase::Over) {
        let command = opponents[turn.player as usize].next(recorder.game());
        recorder.step(&command)?;
    }
    Ok(recorder.finish().encode())
}

/// Formats one value a line; a default is an empty line.
fn lines<T: Serialize + Default + PartialEq>(values: &[T]) -> String {
    let line = |value: &T| match value {
        idle if *idle == T::default() => "\n".to_owned(),
        value => serde_json::to_string(value).expect("numbers and names serialise") + "\n",
    };
    values.iter().map(line).collect()
}

/// Returns inputs that drive two rows out of the tower.
fn sweep() -> Vec<Input> {
    let drive = |body| Drive::new(BodyId(body), DVec3::new(2.0, 0.5, 0.0));
    let mut inputs = vec![Input::default(); SETTLE_STEPS];
    inputs.resize(SETTLE_STEPS + 12, Input::drives((6..12).map(drive).collect()));
    inputs
}

/// Returns inputs of a hand that pulls a loose block out by its end and puts it on the tower.
fn pull() -> Result<Vec<Input>, GoldenError> {
    let scene = teeter_scene::named("tower").expect("the list has it");
    let mut world = World::new(&scene, Params::default())?;
    let mut inputs = vec![Input::default(); SETTLE_STEPS];
    inputs.iter().for_each(|input| drop(world.step(input)));

    let body = loose_block(&world, BodyId(9))?;
    let (position, q) = (world.pose(body).position, rounded_rotation(world.pose(body).orientation));
    let top = world.bodies().map(|i| world.pose(i).position.z + 0.5 * world.size(i).z).fold(0.0, f64::max);
    let height = world.size(body).z;
    let anchor = rounded(DVec3::new(0.5 * world.size(body).x, 0.0, 0.0));

    let start = position + q * anchor;
    let out = start + q * DVec3::X * 0.11;
    let clear = top + 0.5 * height + 0.01;
    let over = DVec3::new(0.0, 0.0, clear) + q * anchor;
    let laid = over - DVec3::Z * 0.0105;
    let path = HandPath::new(Hand::slide(body, anchor, start, q), world.params().frame)
        .line(out, 0.08)
        .with_grip(Grip::Carry)
        .line(out.with_z(over.z), 0.4)
        .line(over, 0.3)
        .line(laid, 0.04);
    inputs.extend(path.into_iter().map(|hand| Input::hand(Hand { target: rounded(hand.target), ..hand })));
    Ok(inputs)
}

/// Returns the first loose block from `first` on.
fn loose_block(world: &World, first: BodyId) -> Result<BodyId, GoldenError> {
    let above = |body| world.contacts(body).iter().filter(|c| c.normal.z < -0.5).map(|c| c.force).sum::<f64>();
    let below_top = world.len() as u32 - 3;
    (first.0..below_top).map(BodyId).find(|&body| above(body) < 1e-3).ok_or(GoldenError::NoLooseBlock)
}

/// Returns commands that take a loose block out and place it, soften the blocks, lift the block,
/// turn it and place it again, and poke another.
fn game() -> Result<Vec<Command>, GoldenError> {
    let scene = teeter_scene::named("tower").expect("the list has it");
    let mut player = Player { game: Game::new(World::new(&scene, Params::default())?), commands: Vec::new() };
    player.idle(SETTLE_STEPS);

    let body = loose_block(player.game.world(), BodyId(9))?;
    player.play(Command::SetHand { max_force: Some(3.0), careful: None, can_turn: None, grip: None });
    let toward = player.game.blocks().orientation(body) * DVec3::X;
    let mut script = TakeAndPlace::new(body, toward, 0.1, None);
    while let Some(command) = script.next(&player.game) {
        player.play(command);
    }
    player.play(Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(3e5) });
    player.idle(SETTLE_STEPS);

    let (anchor, normal) = (DVec3::new(0.02, 0.0, 0.009), DVec3::Z);
    player.play(Command::Grasp { body, anchor, normal, grip: GripMode::Auto });
    for _ in 0..20 {
        let displacement = DVec3::new(0.0005, 0.0, 0.003);
        player.play(Command::Move { displacement, slot: None, toward_viewer: Some(DVec2::NEG_Y) });
    }
    player.play(Command::Turn { rotation: DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8) });
    player.idle(20);
    player.play(Command::Place { body: None, slot: None });
    player.idle(2 * SETTLE_STEPS);

    let body = loose_block(player.game.world(), BodyId(body.0 + 1))?;
    let normal = player.game.blocks().orientation(body) * DVec3::X;
    let anchor = DVec3::X * (0.5 * player.game.blocks().size(body).x);
    player.play(Command::Grasp { body, anchor, normal, grip: GripMode::Auto });
    player.play(Command::Poke);
    player.idle(2 * SETTLE_STEPS);
    Ok(player.commands)
}

/// A game, and the commands it was played with.
struct Player {
    game: Game,
    commands: Vec<Command>,
}

impl Player {
    fn play(&mut self, command: Command) {
        let command = match command {
            Command::Grasp { body, anchor, normal, grip } => {
                Command::Grasp { body, anchor: rounded(anchor), normal: rounded(normal), grip }
            }
            Command::Move { displacement, slot, toward_viewer } => {
                Command::Move { displacement: rounded(displacement), slot, toward_viewer }
            }
            other => other,
        };
        self.game.step(&command);
        self.commands.push(command);
    }

    fn idle(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.play(Command::Idle));
    }
}

/// Rounds to the micrometre, which keeps the file short.
fn rounded(v: DVec3) -> DVec3 {
    (v * 1e6).round() / 1e6
}

/// Rounds the components of a rotation to six digits.
fn rounded_rotation(q: DQuat) -> DQuat {
    DQuat::from_array(q.to_array().map(|x| (x * 1e6).round() / 1e6))
}
