//! Rollout: a move that is tried on a copy of the tower.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BuildError, World};

use crate::analysis::estimate::{EstimateErrors, estimate};
use crate::analysis::freedom::freedom;
use crate::command::Command;
use crate::game::Game;
use crate::player::noise::HandNoise;
use crate::player::stage::{MoveEnd, MovePlan};
use crate::player::take::PlayerHand;
use crate::rules::table::Rules;
use crate::update::Event;

/// Frames in which an estimate comes to rest, and for which a tower is watched after a move.
const BEFORE: u32 = 6;
const AFTER: u32 = 120;
/// Frames after which a rollout ends in any case. A move has fewer.
const MAX_FRAMES: u32 = 2400;

/// Errors of a rollout: of what is seen, and of the hand.
///
/// ```
/// use teeter_game::TrialErrors;
///
/// assert_eq!(TrialErrors::default().hand.lag, 0.15);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TrialErrors {
    /// Of the estimate of the blocks.
    pub estimate: EstimateErrors,
    /// Of the hand.
    pub hand: HandNoise,
}

/// Result of a rollout.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rollout {
    /// True when a block fell.
    pub fell: bool,
    /// End of the move; none where a block fell before.
    pub end: Option<MoveEnd>,
    /// Largest displacement of any other block, m.
    pub moved: f64,
    /// Simulated time, s.
    pub seconds: f64,
    /// Freedom left to the next player; zero after a fall.
    pub freedom: f64,
}

/// Tries a move on a copy of a world, with the errors of a seed. All of it follows from the world,
/// the plan, the errors and the seed.
///
/// # Errors
/// When no world can be built of the estimate.
///
/// ```
/// use teeter_game::{Candidate, Rules, TrialErrors, roll_out};
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let plan = Candidate::ranked(&world, &[BodyId(3)])[0].plan();
/// let rollout = roll_out(&world, &Rules::default(), plan, &TrialErrors::default(), 1)?;
/// assert!(rollout.fell);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn roll_out(
    world: &World,
    rules: &Rules,
    plan: MovePlan,
    errors: &TrialErrors,
    seed: u64,
) -> Result<Rollout, BuildError> {
    let mut trial = Trial { game: Game::new(estimate(world, &errors.estimate, seed)?), frames: 0, fell: false };
    trial.wait(BEFORE);
    let before = trial.game.blocks().positions().to_vec();
    let mut hand = PlayerHand::new(&trial.game, plan, errors.hand, seed);
    while let Some(command) = hand.next(&trial.game).filter(|_| trial.goes_on()) {
        trial.step(&command);
    }
    trial.wait(AFTER);
    let blocks = trial.game.blocks();
    let moved = |(body, was): (_, &DVec3)| if body == plan.body { 0.0 } else { blocks.position(body).distance(*was) };
    Ok(Rollout {
        fell: trial.fell,
        end: hand.end().filter(|_| !trial.fell),
        moved: blocks.bodies().zip(&before).map(moved).fold(0.0, f64::max),
        seconds: f64::from(trial.frames) * world.params().frame,
        freedom: if trial.fell { 0.0 } else { freedom(trial.game.world(), rules) },
    })
}

struct Trial {
    game: Game,
    frames: u32,
    fell: bool,
}

impl Trial {
    fn goes_on(&self) -> bool {
        !self.fell && self.frames < MAX_FRAMES
    }

    fn step(&mut self, command: &Command) {
        let update = self.game.step(command);
        self.frames += 1;
        self.fell |= update.events.iter().any(|event| matches!(event, Event::Fell { .. }));
        self.fell |= !update.quarantined.is_empty();
    }

    /// Waits for some frames, or until the tower is at rest or has fallen.
    fn wait(&mut self, frames: u32) {
        for _ in 0..frames {
            if !self.goes_on() || self.game.rest.at_rest() {
                break;
            }
            self.step(&Command::Idle);
        }
    }
}
