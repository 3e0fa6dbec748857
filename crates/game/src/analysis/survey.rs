//! Survey: rollouts of several moves within a budget of simulated time.

use teeter_physics::{BuildError, World};
use teeter_scene::Random;
use teeter_study::par_map;

use crate::analysis::proportion::Proportion;
use crate::analysis::rollout::{Rollout, TrialErrors, roll_out};
use crate::player::stage::{MoveEnd, MovePlan};
use crate::rules::table::Rules;

/// Largest number of rollouts of a move.
const MAX_ROUNDS: u32 = 1000;

/// Rollouts of a move, summed.
///
/// ```
/// assert_eq!(teeter_game::Tally::default().falls.tries, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tally {
    /// Rollouts in which a block fell.
    pub falls: Proportion,
    /// Rollouts in which the block did not come out.
    pub stuck: Proportion,
    /// Largest displacement of any other block in a rollout without a fall, m.
    pub moved: f64,
    /// Sum of the freedom left over the rollouts without a fall.
    freedom: f64,
}

impl Tally {
    fn add(&mut self, rollout: &Rollout) {
        self.falls.add(rollout.fell);
        self.stuck.add(rollout.end == Some(MoveEnd::Stuck));
        self.freedom += rollout.freedom;
        if !rollout.fell {
            self.moved = self.moved.max(rollout.moved);
        }
    }

    /// Mean freedom that the move leaves the next player where the tower stands; zero where it
    /// always falls.
    pub fn freedom(&self) -> f64 {
        self.freedom / f64::from((self.falls.tries - self.falls.count).max(1))
    }
}

/// Task of a survey.
///
/// ```
/// use teeter_game::{Candidate, Rules, Survey, TrialErrors};
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let plan = Candidate::ranked(&world, &[BodyId(9)])[0].plan();
/// let survey = Survey { rules: Rules::default(), errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let tally = &survey.run(&world, &[plan], || ())?[0];
/// assert_eq!((tally.falls.count, tally.falls.tries), (0, 1));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Survey {
    /// Rules by which the freedom of the next player is judged.
    pub rules: Rules,
    /// Errors of the rollouts.
    pub errors: TrialErrors,
    /// Simulated time after which no further round begins, s: each move is tried once in a round,
    /// and there is one round in any case.
    pub budget: f64,
    /// Seed of the errors.
    pub seed: u64,
}

impl Survey {
    /// Tries moves on copies of a world, and calls `tried` after each rollout. With the feature
    /// `parallel` of `teeter-study` the rollouts of a round run side by side. The results follow
    /// from the task and the world, and the number of threads changes no bit.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn run(&self, world: &World, plans: &[MovePlan], tried: impl Fn() + Sync) -> Result<Vec<Tally>, BuildError> {
        let mut tallies = vec![Tally::default(); plans.len()];
        let mut spent = 0.0;
        for round in 0..MAX_ROUNDS {
            let seeded: Vec<(MovePlan, u64)> = plans.iter().map(|plan| (*plan, self.seed_of(plan, round))).collect();
            let rollouts = par_map(&seeded, |(plan, seed)| {
                let rollout = roll_out(world, &self.rules, *plan, &self.errors, *seed);
                tried();
                rollout
            });
            for (tally, rollout) in tallies.iter_mut().zip(rollouts) {
                let rollout = rollout?;
                tally.add(&rollout);
                spent += rollout.seconds;
            }
            if spent >= self.budget || plans.is_empty() {
                break;
            }
        }
        Ok(tallies)
    }

    /// Seed of a rollout. It is of the block and the round, so a move is tried alike whatever else
    /// is tried beside it.
    fn seed_of(&self, plan: &MovePlan, round: u32) -> u64 {
        let block = Random::new(self.seed.wrapping_add(u64::from(plan.body.0))).bits();
        Random::new(block.wrapping_add(u64::from(round))).bits()
    }
}
