//! Opponent: chooses a move in its turn and carries it out, one command a frame.

use teeter_physics::BodyId;
use teeter_scene::Random;

use crate::command::Command;
use crate::game::Game;
use crate::opponent::strength::{Strength, Thinking};
use crate::opponent::thought::{Considered, choose};
use crate::orientation::slide_axis;
use crate::player::noise::HandNoise;
use crate::player::stage::{MoveEnd, MovePlan};
use crate::player::take::PlayerHand;
use crate::rules::turn::{Phase, TurnState};

/// Time for which an opponent waits for the tower to rest before it thinks, s.
const PATIENCE: f64 = 10.0;
/// Number of moves without success in a turn after which it gives up.
const MAX_FAILURES: usize = 8;

/// An opponent. All that it does follows from its thinking, its seed and the game.
///
/// ```
/// use teeter_game::{Command, Game, Opponent, Rules, Strength, Table};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let world = World::new(&scene, Params::default())?;
/// let mut game = Game::with_rules(world, Rules::of(Table::Official, 2)).unwrap();
/// let mut opponent = Opponent::new(0, Strength::Random, 1);
/// // it waits until the tower rests
/// assert_eq!(opponent.next(&game), Command::Idle);
/// let commands = (0..120).map(|_| {
///     let command = opponent.next(&game);
///     game.step(&command);
///     command
/// });
/// assert!(commands.into_iter().any(|command| matches!(command, Command::Grasp { .. })));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Opponent {
    player: u32,
    thinking: Thinking,
    random: Random,
    /// Number of the turn, and the blocks with which it failed in it, in their order.
    turn: u32,
    failures: Vec<BodyId>,
    hand: Option<(BodyId, PlayerHand)>,
    considered: Vec<Considered>,
}

impl Opponent {
    /// An opponent who plays as `player`, from 0, with the seed of its errors.
    pub fn new(player: u32, strength: Strength, seed: u64) -> Self {
        Self::with_thinking(player, strength.thinking(), seed)
    }

    /// An opponent with a manner of thinking of its own.
    pub fn with_thinking(player: u32, thinking: Thinking, seed: u64) -> Self {
        let (failures, considered) = (Vec::new(), Vec::new());
        Self { player, thinking, random: Random::new(seed), turn: 0, failures, hand: None, considered }
    }

    /// Moves that it considered last, the chosen one first.
    pub fn considered(&self) -> &[Considered] {
        &self.considered
    }

    /// Command for the next frame; none to carry out out of its turn. The frame in which it chooses
    /// a move takes as long as its rollouts.
    pub fn next(&mut self, game: &Game) -> Command {
        let Some(turn) = game.turn().filter(|turn| turn.player == self.player) else { return Command::Idle };
        if turn.number != self.turn {
            (self.turn, self.hand) = (turn.number, None);
            self.failures.clear();
        }
        if let Some((body, hand)) = &mut self.hand {
            if let Some(command) = hand.next(game) {
                return command;
            }
            if hand.end() != Some(MoveEnd::Placed) {
                self.failures.push(*body);
            }
            self.hand = None;
        }
        let is_quiet = game.rest.at_rest() || turn.elapsed_s > PATIENCE;
        match turn.phase {
            Phase::Settling | Phase::Over => Command::Idle,
            _ if self.failures.len() >= MAX_FAILURES => Command::Resign,
            Phase::Choosing if !is_quiet => Command::Idle,
            _ => self.begin(game, &turn),
        }
    }

    /// Begins a move, and returns its first command.
    fn begin(&mut self, game: &Game, turn: &TurnState) -> Command {
        let Some(plan) = self.plan(game, turn) else { return Command::Resign };
        let seed = self.random.bits();
        let mut hand = PlayerHand::new(game, plan, HandNoise::default(), seed);
        let command = hand.next(game).unwrap_or_default();
        self.hand = Some((plan.body, hand));
        command
    }

    fn plan(&mut self, game: &Game, turn: &TurnState) -> Option<MovePlan> {
        if let Some(body) = turn.block.filter(|_| turn.phase != Phase::Choosing) {
            // The block that was moved already: by its other end where it did not come out.
            let along = slide_axis(game.blocks().orientation(body));
            let toward = if self.failures.len().is_multiple_of(2) { along } else { -along };
            return Some(MovePlan::pull(body, toward));
        }
        let seed = self.random.bits();
        let fresh: Vec<BodyId> = turn.removable.iter().copied().filter(|body| !self.failures.contains(body)).collect();
        self.considered = choose(game.world(), &game.rules(), &fresh, &self.thinking, seed).unwrap_or_default();
        self.considered.first().map(|considered| considered.candidate.plan())
    }
}
