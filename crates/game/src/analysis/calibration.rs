//! Calibration: chances of a fall held against the outcome of moves that were then played.

use serde::Serialize;
use teeter_physics::{BodyId, BuildError, Params, World};
use teeter_scene::{Random, Scene};

use crate::analysis::candidate::Candidate;
use crate::analysis::estimate::EstimateErrors;
use crate::analysis::proportion::Proportion;
use crate::analysis::rollout::TrialErrors;
use crate::analysis::survey::Survey;
use crate::game::Game;
use crate::player::noise::HandNoise;
use crate::player::stage::MovePlan;
use crate::player::take::PlayerHand;
use crate::rules::table::{Rules, RulesError};
use crate::update::Event;

/// Frames for which a tower is watched after a move: two seconds; and after which a move is given
/// up.
const AFTER: u32 = 120;
const MAX_FRAMES: u32 = 2400;

/// A move that was judged first, by rollouts and by the X-ray, and then played.
///
/// ```
/// use teeter_game::{HeldOutMove, Rules, Table};
/// use teeter_scene::{TowerOptions, tower};
///
/// let scene = tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap();
/// let held_out = HeldOutMove::play(&scene, Rules::of(Table::Official, 1), 0, 20.0, 1).unwrap();
/// assert!(held_out.falls.tries >= 1 && held_out.before == 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeldOutMove {
    /// Number of blocks that were taken before.
    pub before: u32,
    /// Block.
    pub body: BodyId,
    /// Rollouts, and those in which a block fell.
    pub falls: Proportion,
    /// Force that starts the block sliding, by the X-ray, N.
    pub tightness_n: f64,
    /// True when rigid blocks fall without it; none where they have no exact answer.
    pub falls_by_statics: Option<bool>,
    /// True when a block fell as the move was played.
    pub fell: bool,
}

/// Reason why no move could be played.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// No world can be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// No game can be played by the rules.
    #[error(transparent)]
    Rules(#[from] RulesError),
}

impl HeldOutMove {
    /// Takes up to `before` random blocks from a tower, as long as it stands; judges another one by
    /// rollouts of `budget` (s of the simulation, at least one rollout), and plays it with the
    /// errors of another seed. All of it follows from the arguments.
    ///
    /// # Errors
    /// When no game can be played on the scene by the rules.
    pub fn play(scene: &Scene, rules: Rules, before: u32, budget: f64, seed: u64) -> Result<Self, CalibrationError> {
        let mut random = Random::new(seed);
        let (game, taken) = middle_game(scene, rules, before, &mut random)?;
        let candidate = drawn(&game, &mut random);
        let errors = TrialErrors { estimate: EstimateErrors::default(), hand: HandNoise::default() };
        let survey = Survey { rules, errors, budget, seed: random.bits() };
        let tally = survey.run(game.world(), &[candidate.plan()], || ())?[0];
        let (_, fell) = played(game, candidate.plan(), random.bits());
        Ok(Self {
            before: taken,
            body: candidate.body,
            falls: tally.falls,
            tightness_n: candidate.tightness_n,
            falls_by_statics: candidate.falls,
            fell,
        })
    }
}

/// A standing tower after up to `count` random moves, and the number of these. It is the tower
/// before the move in which a block fell.
fn middle_game(scene: &Scene, rules: Rules, count: u32, random: &mut Random) -> Result<(Game, u32), CalibrationError> {
    let mut game = Game::with_rules(World::new(scene, Params::default())?, rules)?;
    wait(&mut game, AFTER);
    for taken in 0..count {
        let plan = drawn(&game, random).plan();
        let (after, fell) = played(game.clone(), plan, random.bits());
        if fell || after.turn().is_none_or(|turn| turn.removable.is_empty() || turn.block.is_some()) {
            return Ok((game, taken));
        }
        game = after;
    }
    Ok((game, count))
}

/// Any of the blocks that may be taken.
fn drawn(game: &Game, random: &mut Random) -> Candidate {
    let bodies = game.turn().map_or_else(Vec::new, |turn| turn.removable);
    Candidate::ranked(game.world(), &[bodies[random.below(bodies.len())]])[0]
}

/// The game after a move, and whether a block fell.
fn played(mut game: Game, plan: MovePlan, seed: u64) -> (Game, bool) {
    let mut hand = PlayerHand::new(&game, plan, HandNoise::default(), seed);
    for _ in 0..MAX_FRAMES {
        let Some(command) = hand.next(&game) else { break };
        let update = game.step(&command);
        if update.events.iter().any(|event| matches!(event, Event::Fell { .. })) {
            return (game, true);
        }
    }
    let fell = wait(&mut game, AFTER);
    (game, fell)
}

/// Waits for some frames. Returns true if a block fell.
fn wait(game: &mut Game, frames: u32) -> bool {
    let fell = |update: crate::update::Update<_>| {
        update.events.iter().any(|event: &Event| matches!(event, Event::Fell { .. }))
    };
    (0..frames).any(|_| fell(game.step(&crate::command::Command::Idle)))
}
