//! Choice of a move.

use serde::{Deserialize, Serialize};
use teeter_physics::{BodyId, BuildError, World};
use teeter_scene::Random;

use crate::analysis::candidate::{Candidate, Ranking};
use crate::analysis::freedom::looseness;
use crate::analysis::prospect::prospect_after;
use crate::analysis::rollout::TrialErrors;
use crate::analysis::survey::{Survey, SurveyRun, Tally};
use crate::blocks::Blocks;
use crate::opponent::halving::Halving;
use crate::opponent::strength::Thinking;
use crate::player::noise::HandNoise;
use crate::rules::table::Rules;

/// Cost of a block that does not come out, as a chance of a fall: it has to be put back, and that
/// shakes the tower.
const STUCK: f64 = 0.1;
/// Share of the moves of tight blocks in which a block falls, by `teeter calibrate`.
const TIGHT_FALLS: f64 = 0.5;
/// Simulated time that a rollout is expected to take, s.
const TRY: f64 = 5.0;
/// Part of the progress that the ranking of the blocks is.
const RANKING: f64 = 0.1;

/// A move that was considered.
///
/// ```
/// use teeter_game::{Rules, Strength, choose};
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let thinking = Strength::Random.thinking();
/// let considered = choose(&world, &Rules::default(), &[BodyId(9)], &thinking, 1)?;
/// assert_eq!(considered[0].candidate.body, BodyId(9));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Considered {
    /// The move.
    pub candidate: Candidate,
    /// Its rollouts.
    pub tally: Tally,
    /// Cost: the chance of a fall, and what it leaves to the next player.
    pub cost: f64,
}

/// Considers the blocks that may be taken, and returns the moves that were tried, the chosen one
/// first. All of it follows from the world, the manner of thinking and the seed.
///
/// # Errors
/// When no world can be built of an estimate.
pub fn choose(
    world: &World,
    rules: &Rules,
    bodies: &[BodyId],
    thinking: &Thinking,
    seed: u64,
) -> Result<Vec<Considered>, BuildError> {
    let question = Question { rules: *rules, bodies: bodies.to_vec(), thinking: *thinking, seed };
    let mut thought = Thought::new(world.clone(), &question);
    while let Some(ranking) = thought.ranking.as_mut().filter(|ranking| !ranking.is_done()) {
        ranking.finish_round();
    }
    thought.begin_rollouts();
    while !thought.is_done() {
        thought.run.finish_round(|| ())?;
        thought.drop_worse();
    }
    Ok(thought.considered())
}

/// Question of an opponent: which block to take.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// Rules of the game.
    pub rules: Rules,
    /// Blocks that may be taken.
    pub bodies: Vec<BodyId>,
    /// Manner of thinking.
    pub thinking: Thinking,
    /// Seed of the errors.
    pub seed: u64,
}

/// Thought about a question, a rollout at a time: [`choose`] for a caller that has other work in
/// between.
///
/// ```
/// use teeter_game::{Question, Rules, Strength, Thought};
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let thinking = Strength::Random.thinking();
/// let question = Question { rules: Rules::default(), bodies: vec![BodyId(9)], thinking, seed: 1 };
/// let mut thought = Thought::new(world, &question);
/// while !thought.is_done() {
///     thought.step()?;
/// }
/// assert_eq!(thought.considered()[0].candidate.body, BodyId(9));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Thought {
    thinking: Thinking,
    /// Ranking of the blocks; none once it is done.
    ranking: Option<Ranking>,
    candidates: Vec<Candidate>,
    /// Prospect that each candidate leaves the next player.
    prospects: Vec<f64>,
    halving: Halving,
    run: SurveyRun,
}

impl Thought {
    /// Begins to think. A body that the world has not is left out.
    pub fn new(world: World, question: &Question) -> Self {
        let Question { rules, bodies, thinking, seed } = question;
        let count = (thinking.candidates as usize).max(1);
        let affordable = Halving::affordable(count, thinking.budget, TRY);
        let count = if thinking.is_ranked && thinking.budget > 0.0 { affordable } else { count };
        let bodies: Vec<BodyId> = bodies.iter().copied().filter(|body| body.index() < world.len()).collect();
        let bodies = if thinking.is_ranked { bodies } else { drawn(&bodies, count, *seed) };
        let blocks = Blocks::of(&world);
        let prior = |candidate: &Candidate| {
            let risk = prior_risk(candidate);
            risk + (1.0 - risk) * thinking.foresight * prospect_left(thinking, &blocks, rules, candidate)
        };
        let ranking = Some(Ranking::by(&world, &bodies, count, prior));
        let errors = TrialErrors { estimate: thinking.errors, hand: HandNoise::default() };
        let survey = Survey { rules: *rules, errors, budget: thinking.budget, seed: *seed };
        let run = SurveyRun::new(survey, world, Vec::new());
        let halving = Halving::new(0, thinking.budget);
        Self { thinking: *thinking, ranking, candidates: Vec::new(), prospects: Vec::new(), halving, run }
    }

    /// Returns true if the budget is spent, or a single move was tried.
    pub fn is_done(&self) -> bool {
        let is_only = self.candidates.len() == 1 && self.run.spent_at_end_of_round().is_some();
        self.ranking.is_none() && (is_only || self.run.is_done())
    }

    /// Part of the work that is done, 0 to 1.
    pub fn progress(&self) -> f64 {
        match &self.ranking {
            Some(ranking) => RANKING * ranking.progress(),
            None if self.is_done() => 1.0,
            None => RANKING + (1.0 - RANKING) * self.run.progress(),
        }
    }

    /// Ranks the next block, or makes the next rollout, where the budget is not spent.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn step(&mut self) -> Result<(), BuildError> {
        let Some(ranking) = &mut self.ranking else {
            self.run.step()?;
            self.drop_worse();
            return Ok(());
        };
        ranking.step();
        if ranking.is_done() {
            self.begin_rollouts();
        }
        Ok(())
    }

    /// Ends a round, where one has ended.
    fn drop_worse(&mut self) {
        let Some(spent) = self.run.spent_at_end_of_round() else { return };
        let Self { thinking, candidates, prospects, halving, run, .. } = self;
        halving.end_round(spent, |index| {
            cost(thinking, &run.tallies()[index], prior_risk(&candidates[index]), prospects[index])
        });
        run.keep(halving.left());
    }

    fn begin_rollouts(&mut self) {
        let Some(ranking) = self.ranking.take() else { return };
        self.candidates = ranking.finish();
        let (blocks, rules) = (Blocks::of(self.run.world()), self.run.rules());
        self.prospects = self.candidates.iter().map(|c| prospect_left(&self.thinking, &blocks, rules, c)).collect();
        if self.thinking.budget > 0.0 {
            self.halving = Halving::new(self.candidates.len(), self.thinking.budget);
            self.run.begin(self.candidates.iter().map(Candidate::plan).collect());
        }
    }

    /// Moves by their rollouts so far, the one to choose first.
    pub fn considered(&self) -> Vec<Considered> {
        let tally = |index: usize| self.run.tallies().get(index).copied().unwrap_or_default();
        let considered = self.candidates.iter().enumerate().map(|(index, candidate)| {
            let tally = tally(index);
            let cost = cost(&self.thinking, &tally, prior_risk(candidate), self.prospects[index]);
            Considered { candidate: *candidate, tally, cost }
        });
        let mut considered: Vec<Considered> = considered.collect();
        // Of equal ones the looser first: the sort is stable.
        considered.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        considered
    }
}

/// Chance of a fall by the X-ray alone.
fn prior_risk(candidate: &Candidate) -> f64 {
    TIGHT_FALLS * (1.0 - looseness(candidate.tightness_n))
}

/// Prospect that a move leaves the next player; one who does not weigh it does not count.
fn prospect_left(thinking: &Thinking, blocks: &Blocks, rules: &Rules, candidate: &Candidate) -> f64 {
    if thinking.foresight == 0.0 { 0.0 } else { prospect_after(blocks, rules, candidate.body) }
}

fn cost(thinking: &Thinking, tally: &Tally, prior_risk: f64, prospect: f64) -> f64 {
    // Few rollouts are not certain for one who shuns a fall; one who wants a risk takes what it
    // saw.
    let risk = match thinking.risk {
        wanted if wanted > 0.0 => (tally.falls.share() - wanted).abs(),
        _ => {
            let seen = f64::from(tally.falls.tries) + 2.0;
            (tally.falls.expected() * seen + prior_risk * thinking.caution) / (seen + thinking.caution)
        }
    };
    let trouble = thinking.trouble * libm::log2(1.0 + tally.freedom());
    // The next player wins where the block falls, or by counting where it does not.
    risk + STUCK * tally.stuck.share() + trouble + (1.0 - risk) * thinking.foresight * prospect
}

/// Draws `count` different bodies, or all where there are fewer.
fn drawn(bodies: &[BodyId], count: usize, seed: u64) -> Vec<BodyId> {
    let mut random = Random::new(seed);
    let mut left = bodies.to_vec();
    (0..count.min(left.len())).map(|_| left.swap_remove(random.below(left.len()))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::opponent::strength::Strength;

    #[test]
    fn blocks_are_drawn_once_each_and_all_alike() {
        let bodies: Vec<BodyId> = (0..6).map(BodyId).collect();
        let mut counts = [0; 6];
        for seed in 0..3000 {
            let mut some = drawn(&bodies, 3, seed);
            some.iter().for_each(|body| counts[body.index()] += 1);
            some.sort_unstable();
            some.dedup();
            assert_eq!(some.len(), 3);
        }
        assert!(counts.iter().all(|count| (1350..1650).contains(count)), "{counts:?}");
        assert_eq!(drawn(&bodies, 9, 1).len(), 6);
    }

    #[test]
    fn a_competitor_shuns_falls_and_a_gentle_one_does_not() {
        let tally = |count, tries| {
            let mut tally = Tally::default();
            tally.falls.tries = tries;
            tally.falls.count = count;
            tally
        };
        let (safe, risky, hopeless) = (tally(0, 8), tally(2, 8), tally(8, 8));
        for strength in [Strength::Beginner, Strength::Skilled, Strength::Expert] {
            let cost = |tally| cost(&strength.thinking(), tally, 0.1, 0.5);
            assert!(cost(&safe) < cost(&risky) && cost(&risky) < cost(&hopeless), "{strength:?}");
        }
        let cost = |tally| cost(&Strength::Gentle.thinking(), tally, 0.1, 0.5);
        assert!(cost(&risky) < cost(&safe) && cost(&risky) < cost(&hopeless));
    }
}
