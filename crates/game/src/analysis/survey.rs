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
/// Largest progress of work that is not done: callers end at 1.
pub const ALMOST: f64 = 0.999;

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
        let mut run = SurveyRun::new(*self, world.clone(), plans.to_vec());
        while !run.is_done() {
            run.finish_round(&tried)?;
        }
        Ok(run.tallies)
    }

    /// Seed of a rollout. It is of the block and the round, so a move is tried alike whatever else
    /// is tried beside it.
    fn seed_of(&self, plan: &MovePlan, round: u32) -> u64 {
        let block = Random::new(self.seed.wrapping_add(u64::from(plan.body.0))).bits();
        Random::new(block.wrapping_add(u64::from(round))).bits()
    }
}

/// A survey in progress, for a caller that has other work between two rollouts.
///
/// ```
/// use teeter_game::{Candidate, Rules, Survey, SurveyRun, TrialErrors};
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let plans = vec![Candidate::ranked(&world, &[BodyId(9)])[0].plan()];
/// let survey = Survey { rules: Rules::default(), errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let mut run = SurveyRun::new(survey, world, plans);
/// while !run.is_done() {
///     run.step()?;
/// }
/// assert_eq!((run.progress(), run.tallies()[0].falls.tries), (1.0, 1));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SurveyRun {
    survey: Survey,
    world: World,
    plans: Vec<MovePlan>,
    tallies: Vec<Tally>,
    round: u32,
    /// Indices of the plans that are tried in a round, and the number of those tried in this one.
    left: Vec<usize>,
    next: usize,
    /// Simulated time so far, s.
    spent: f64,
}

impl SurveyRun {
    /// Begins a survey of moves on a world.
    pub fn new(survey: Survey, world: World, plans: Vec<MovePlan>) -> Self {
        let (tallies, left) = (vec![Tally::default(); plans.len()], (0..plans.len()).collect());
        Self { survey, world, plans, tallies, round: 0, left, next: 0, spent: 0.0 }
    }

    /// Begins the survey with other moves.
    pub fn begin(&mut self, plans: Vec<MovePlan>) {
        (self.round, self.next, self.spent) = (0, 0, 0.0);
        self.tallies = vec![Tally::default(); plans.len()];
        self.left = (0..plans.len()).collect();
        self.plans = plans;
    }

    /// Tries only these plans from the next round on, by their indices.
    ///
    /// # Panics
    /// When a round is not over.
    pub(crate) fn keep(&mut self, left: &[usize]) {
        assert_eq!(self.next, 0, "plans are dropped between two rounds");
        self.left.clear();
        self.left.extend_from_slice(left);
    }

    /// Simulated time so far, s, where a round has ended; none within a round.
    pub(crate) fn spent_at_end_of_round(&self) -> Option<f64> {
        (self.round > 0 && self.next == 0).then_some(self.spent)
    }

    /// Returns true if a round has ended and the budget is spent.
    pub fn is_done(&self) -> bool {
        let is_spent = self.round > 0 && (self.spent >= self.survey.budget || self.round >= MAX_ROUNDS);
        self.left.is_empty() || (self.next == 0 && is_spent)
    }

    /// Part of the budget that is spent, 0 to 1, and 1 only at the end; in the first round at most
    /// the part of the plans that are tried.
    pub fn progress(&self) -> f64 {
        if self.is_done() {
            return 1.0;
        }
        let of_budget = if self.survey.budget > 0.0 { self.spent / self.survey.budget } else { 1.0 };
        let of_round = if self.round == 0 { self.next as f64 / self.left.len() as f64 } else { 1.0 };
        of_budget.min(of_round).min(ALMOST)
    }

    /// Results so far, one of each plan.
    pub fn tallies(&self) -> &[Tally] {
        &self.tallies
    }

    /// Rules by which the freedom of the next player is judged.
    pub(crate) fn rules(&self) -> &Rules {
        &self.survey.rules
    }

    /// The world on whose copies the moves are tried.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Makes the next rollout, where the survey is not done.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn step(&mut self) -> Result<(), BuildError> {
        if self.is_done() {
            return Ok(());
        }
        let rollout = self.roll_out(self.left[self.next])?;
        self.add(&rollout);
        Ok(())
    }

    /// Makes the other rollouts of the round side by side, and calls `tried` after each.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn finish_round(&mut self, tried: impl Fn() + Sync) -> Result<(), BuildError> {
        let rollouts = par_map(&self.left[self.next..], |index| {
            let rollout = self.roll_out(*index);
            tried();
            rollout
        });
        rollouts.into_iter().try_for_each(|rollout| rollout.map(|rollout| self.add(&rollout)))
    }

    fn roll_out(&self, index: usize) -> Result<Rollout, BuildError> {
        let (plan, Survey { rules, errors, .. }) = (self.plans[index], self.survey);
        roll_out(&self.world, &rules, plan, &errors, self.survey.seed_of(&plan, self.round))
    }

    /// Takes in the rollout of the next plan.
    fn add(&mut self, rollout: &Rollout) {
        self.tallies[self.left[self.next]].add(rollout);
        self.spent += rollout.seconds;
        self.next += 1;
        if self.next == self.left.len() {
            (self.round, self.next) = (self.round + 1, 0);
        }
    }
}
