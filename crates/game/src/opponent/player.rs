//! Opponent: chooses a move in its turn and carries it out, one command a frame.

use glam::DVec3;
use teeter_physics::BodyId;
use teeter_scene::Random;

use crate::command::Command;
use crate::game::Game;
use crate::opponent::strength::{Strength, Thinking};
use crate::opponent::thought::{Considered, Question, choose};
use crate::orientation::slide_axis;
use crate::player::noise::HandNoise;
use crate::player::stage::{MoveEnd, MovePlan};
use crate::player::take::PlayerHand;
use crate::rules::turn::{Phase, TurnState};

/// Time for which an opponent waits for the tower to rest before it thinks, s.
const PATIENCE: f64 = 10.0;
/// Number of moves without success in a turn after which it gives up.
const MAX_FAILURES: usize = 8;

/// An opponent. All that it does in a turn follows from its thinking, its seed, and the game from
/// the beginning of that turn on: one that takes over there plays the same.
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
    seed: u64,
    /// Random numbers of the turn.
    random: Random,
    /// Number of the turn, and the blocks with which it failed in it, in their order.
    turn: u32,
    failures: Vec<BodyId>,
    hand: Option<(BodyId, PlayerHand)>,
    /// Block that it moved last in the turn, and where it was before, m.
    home: Option<(BodyId, DVec3)>,
    /// Question that is not yet answered.
    question: Option<Question>,
    /// Answer that was not yet carried out; a plan where there is a move.
    answer: Option<Option<MovePlan>>,
    considered: Vec<Considered>,
}

impl Opponent {
    /// An opponent who plays as `player`, from 0, with the seed of its errors.
    pub fn new(player: u32, strength: Strength, seed: u64) -> Self {
        Self::with_thinking(player, strength.thinking(), seed)
    }

    /// An opponent with a manner of thinking of its own.
    pub fn with_thinking(player: u32, thinking: Thinking, seed: u64) -> Self {
        Self {
            player,
            thinking,
            seed,
            random: Random::new(seed),
            turn: 0,
            failures: Vec::new(),
            hand: None,
            home: None,
            question: None,
            answer: None,
            considered: Vec::new(),
        }
    }

    /// Moves that it considered last, the chosen one first; of an answer from outside none.
    pub fn considered(&self) -> &[Considered] {
        &self.considered
    }

    /// Command for the next frame; none to carry out out of its turn. The frame in which it chooses
    /// a move takes as long as its rollouts, unless its question was answered before.
    pub fn next(&mut self, game: &Game) -> Command {
        let Some(turn) = self.advance(game) else { return Command::Idle };
        if let Some((_, hand)) = &mut self.hand {
            return hand.next(game).unwrap_or_default();
        }
        match self.intent(game, &turn) {
            Intent::Wait => Command::Idle,
            Intent::Resign => Command::Resign,
            Intent::Move(plan) => self.begin(game, Some(plan)),
            Intent::PutBack(body, home) => {
                let hand = PlayerHand::putting_back(game, body, home, HandNoise::default(), self.random.bits());
                self.carry_out(game, body, hand)
            }
            Intent::Choose => {
                let plan = self.chosen(game, &turn);
                self.begin(game, plan)
            }
        }
    }

    /// Question that it has to answer before its next command; none where it has nothing to choose.
    ///
    /// A caller with other work may answer it elsewhere, with a [`Thought`](crate::Thought) on a
    /// copy of the world, and hand over the answer by [`Opponent::answer`]; the game can go on
    /// meanwhile with [`Command::Idle`]. It is the same question until it is answered or the turn
    /// ends.
    pub fn question(&mut self, game: &Game) -> Option<&Question> {
        let turn = self.advance(game)?;
        let has_to_choose = self.hand.is_none() && self.answer.is_none();
        if !has_to_choose || !matches!(self.intent(game, &turn), Intent::Choose) {
            return None;
        }
        Some(self.ask(game, &turn))
    }

    /// Takes in the answer to its question: the move that it begins in its next command, or none
    /// where there is no move, and it gives up. It is ignored where there is no question.
    pub fn answer(&mut self, plan: Option<MovePlan>) {
        if self.question.take().is_some() {
            self.answer = Some(plan);
            self.considered.clear();
        }
    }

    /// Takes in a turn that began and a move that ended. Returns the turn where it is its own.
    fn advance(&mut self, game: &Game) -> Option<TurnState> {
        let turn = game.turn()?;
        if turn.phase == Phase::Over {
            // The tower may be rebuilt, and turns are counted from 1 again.
            self.turn = 0;
            return None;
        }
        if turn.player != self.player {
            return None;
        }
        if turn.number != self.turn {
            (self.turn, self.hand, self.question, self.answer) = (turn.number, None, None, None);
            self.home = None;
            self.random = Random::new(Random::new(self.seed).bits().wrapping_add(u64::from(turn.number)));
            self.failures.clear();
        }
        let ended = self.hand.take_if(|(_, hand)| hand.end().is_some());
        if let Some((body, _)) = ended.filter(|(_, hand)| hand.end() != Some(MoveEnd::Placed)) {
            self.failures.push(body);
        }
        Some(turn)
    }

    fn intent(&self, game: &Game, turn: &TurnState) -> Intent {
        let is_quiet = game.rest.at_rest() || turn.elapsed_s > PATIENCE;
        match turn.phase {
            Phase::Settling | Phase::Over => Intent::Wait,
            _ if self.failures.len() >= MAX_FAILURES => Intent::Resign,
            Phase::Choosing if !is_quiet => Intent::Wait,
            Phase::Choosing => Intent::Choose,
            Phase::Removing | Phase::Placing => turn.block.map_or(Intent::Choose, |body| {
                // The block that was moved already is put back, and where it does not go back it is
                // drawn by its other end.
                let home = self.home.filter(|(moved, _)| *moved == body && turn.phase == Phase::Removing);
                if let Some((_, home)) = home.filter(|_| !self.failures.len().is_multiple_of(2)) {
                    return Intent::PutBack(body, home);
                }
                let along = slide_axis(game.blocks().orientation(body));
                let toward = if self.failures.len().is_multiple_of(4) { along } else { -along };
                Intent::Move(MovePlan::pull(body, toward))
            }),
        }
    }

    /// Begins a move, and returns its first command; it gives up where there is none.
    fn begin(&mut self, game: &Game, plan: Option<MovePlan>) -> Command {
        let Some(plan) = plan else { return Command::Resign };
        let hand = PlayerHand::new(game, plan, HandNoise::default(), self.random.bits());
        if self.home.is_none_or(|(body, _)| body != plan.body) {
            let position = game.blocks().positions().get(plan.body.index());
            self.home = position.map(|position| (plan.body, *position));
        }
        self.carry_out(game, plan.body, hand)
    }

    fn carry_out(&mut self, game: &Game, body: BodyId, mut hand: PlayerHand) -> Command {
        let command = hand.next(game).unwrap_or_default();
        self.hand = Some((body, hand));
        command
    }

    fn chosen(&mut self, game: &Game, turn: &TurnState) -> Option<MovePlan> {
        if let Some(plan) = self.answer.take() {
            return plan;
        }
        self.ask(game, turn);
        let Question { rules, bodies, thinking, seed } = self.question.take()?;
        self.considered = choose(game.world(), &rules, &bodies, &thinking, seed).unwrap_or_default();
        self.considered.first().map(|considered| considered.candidate.plan())
    }

    fn ask(&mut self, game: &Game, turn: &TurnState) -> &Question {
        let Self { question, random, failures, thinking, .. } = self;
        question.get_or_insert_with(|| Question {
            rules: game.rules(),
            bodies: turn.removable.iter().copied().filter(|body| !failures.contains(body)).collect(),
            thinking: *thinking,
            seed: random.bits(),
        })
    }
}

/// Next action of an opponent in its turn.
enum Intent {
    Wait,
    Resign,
    Move(MovePlan),
    PutBack(BodyId, DVec3),
    Choose,
}
