//! Analysis of a standing tower, block by block.

use teeter_physics::{BodyId, BuildError, World};
use teeter_study::{breakaway_force, par_map};

use crate::analysis::candidate::Candidate;
use crate::analysis::holders::holders;
use crate::analysis::survey::{Survey, Tally};

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
    let bodies: Vec<BodyId> = world.bodies().collect();
    let mut candidates = Candidate::ranked(world, &bodies);
    candidates.sort_by_key(|candidate| candidate.body);
    let plans: Vec<_> = candidates.iter().map(Candidate::plan).collect();
    let tallies = survey.run(world, &plans, tried)?;
    let forces = par_map(&candidates, |candidate| breakaway_force(world, candidate.body, candidate.toward));
    let blocks = candidates.into_iter().zip(tallies).zip(forces);
    let blocks = blocks.map(|((candidate, tally), force_n)| {
        let held_by = holders(world, candidate.body);
        BlockAnalysis { candidate, tally, force_n, held_by }
    });
    Ok(blocks.collect())
}
