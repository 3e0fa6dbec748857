//! Analysis of a standing tower, block by block.

use teeter_physics::{BodyId, BuildError, World};
use teeter_study::{breakaway_force, par_map};

use crate::analysis::candidate::{Candidate, Ranking};
use crate::analysis::holders::{StickingContact, holders, sticking};
use crate::analysis::survey::{Survey, SurveyRun, Tally};

/// Analysis of taking a block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockAnalysis {
    /// The move: block, direction, and what statics say.
    pub candidate: Candidate,
    /// Its rollouts.
    pub tally: Tally,
    /// Force that starts it sliding in that direction, N; none above 10 N.
    pub force_n: Option<f64>,
    /// Blocks whose load bears on it.
    pub held_by: Vec<BodyId>,
    /// Contacts by which it sticks, the one with the largest friction first.
    pub sticking: Vec<StickingContact>,
}

/// Analyses every block of a world at rest, in order of creation. Calls `tried` after each rollout.
///
/// # Errors
/// When no world can be built of an estimate.
///
/// ```
/// use teeter_game::{Rules, Survey, TrialErrors, analyse_tower};
/// use teeter_physics::Params;
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let survey = Survey { rules: Rules::default(), errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let blocks = analyse_tower(&world, &survey, || ())?;
/// assert_eq!((blocks[9].tally.falls.share(), blocks[9].held_by.len()), (0.0, 0));
/// // the others bear the column above them
/// assert!(blocks[..9].iter().all(|block| block.candidate.falls == Some(true) && block.held_by.len() == 1));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn analyse_tower(
    world: &World,
    survey: &Survey,
    tried: impl Fn() + Sync,
) -> Result<Vec<BlockAnalysis>, BuildError> {
    let mut run = TowerAnalysis::new(world.clone(), *survey);
    while !run.ranking.is_done() {
        run.ranking.finish_round();
    }
    run.begin_rollouts();
    while !run.rollouts.is_done() {
        run.rollouts.finish_round(&tried)?;
    }
    run.forces = par_map(&run.candidates, |candidate| breakaway_force(world, candidate.body, candidate.toward));
    Ok(run.blocks())
}

/// Parts of the progress that the ranking and the rollouts are.
const RANKING: f64 = 0.05;
const ROLLOUTS: f64 = 0.9;

/// Analysis of a tower in progress, for a caller that has other work between two steps.
///
/// ```
/// use teeter_game::{Rules, Survey, TowerAnalysis, TrialErrors};
/// use teeter_physics::Params;
///
/// let world = teeter_study::settled(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let survey = Survey { rules: Rules::default(), errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let mut analysis = TowerAnalysis::new(world, survey);
/// while !analysis.is_done() {
///     analysis.step()?;
/// }
/// assert!(analysis.progress() == 1.0 && analysis.blocks()[0].force_n.is_some());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TowerAnalysis {
    ranking: Ranking,
    /// In order of creation; empty while they are ranked.
    candidates: Vec<Candidate>,
    rollouts: SurveyRun,
    /// Forces of the first candidates.
    forces: Vec<Option<f64>>,
}

impl TowerAnalysis {
    /// Begins the analysis of a world at rest.
    pub fn new(world: World, survey: Survey) -> Self {
        let bodies: Vec<BodyId> = world.bodies().collect();
        let ranking = Ranking::new(&world, &bodies, bodies.len());
        Self {
            ranking,
            candidates: Vec::new(),
            rollouts: SurveyRun::new(survey, world, Vec::new()),
            forces: Vec::new(),
        }
    }

    /// Returns true if the budget is spent and every force is known.
    pub fn is_done(&self) -> bool {
        self.is_ranked() && self.rollouts.is_done() && self.forces.len() == self.candidates.len()
    }

    /// Part of the work that is done, 0 to 1.
    pub fn progress(&self) -> f64 {
        if self.is_done() {
            return 1.0;
        }
        if !self.is_ranked() {
            return RANKING * self.ranking.progress();
        }
        let forces = self.forces.len() as f64 / self.candidates.len().max(1) as f64;
        RANKING + ROLLOUTS * self.rollouts.progress() + (1.0 - RANKING - ROLLOUTS) * forces
    }

    /// Analyses a block by statics, makes a rollout, or pulls at a block.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn step(&mut self) -> Result<(), BuildError> {
        if !self.is_ranked() {
            self.ranking.step();
            if self.ranking.is_done() {
                self.begin_rollouts();
            }
            return Ok(());
        }
        if !self.rollouts.is_done() {
            return self.rollouts.step();
        }
        if let Some(candidate) = self.candidates.get(self.forces.len()) {
            self.forces.push(breakaway_force(self.rollouts.world(), candidate.body, candidate.toward));
        }
        Ok(())
    }

    fn is_ranked(&self) -> bool {
        self.candidates.len() == self.rollouts.world().len()
    }

    fn begin_rollouts(&mut self) {
        self.candidates = self.ranking.clone().finish();
        self.candidates.sort_by_key(|candidate| candidate.body);
        self.rollouts.begin(self.candidates.iter().map(Candidate::plan).collect());
    }

    /// The blocks in order of creation, by the rollouts so far; a force that is not known yet is
    /// none.
    pub fn blocks(&self) -> Vec<BlockAnalysis> {
        let forces = self.forces.iter().copied().chain(std::iter::repeat(None));
        let blocks = self.candidates.iter().zip(self.rollouts.tallies()).zip(forces);
        let blocks = blocks.map(|((candidate, tally), force_n)| {
            let (world, body) = (self.rollouts.world(), candidate.body);
            let (held_by, sticking) = (holders(world, body), sticking(world, body));
            BlockAnalysis { candidate: *candidate, tally: *tally, force_n, held_by, sticking }
        });
        blocks.collect()
    }
}
