//! Breakdown of a recorded game: the chance of each move, the riskiest, the blunders, and why the
//! tower fell.

use teeter_physics::{BodyId, BuildError, World};

use crate::analysis::candidate::Candidate;
use crate::analysis::move_log::{FallAnalysis, MoveLog, Played};
use crate::analysis::proportion::Proportion;
use crate::analysis::survey::{ALMOST, Survey, SurveyRun};
use crate::player::stage::MovePlan;
use crate::record::error::RecordError;
use crate::record::file::Record;
use crate::record::replay::Replay;

/// Number of other moves that each move is compared with: the best by X-ray and limit analysis.
const OTHERS: usize = 3;
/// Difference to the safest move from which a move is a blunder.
const BLUNDER: f64 = 0.3;

/// A move of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveAnalysis {
    /// Number of the turn, from 1, and player, from 0; zero in free play.
    pub turn: u32,
    /// Player.
    pub player: u32,
    /// Block that was taken.
    pub body: BodyId,
    /// Time at which it was grasped, s.
    pub time_s: f64,
    /// Rollouts of the move, and those in which a block fell.
    pub falls: Proportion,
    /// Safest other move, with its rollouts; none where there was no other.
    pub safest: Option<(BodyId, Proportion)>,
    /// True when a block fell in the move.
    pub fell: bool,
}

impl MoveAnalysis {
    /// Returns true if a move was at hand that is safer by far, and not by chance alone: the
    /// interval of this one ends above it.
    pub fn is_blunder(&self) -> bool {
        self.safest.is_some_and(|(_, safest)| {
            self.falls.share() - safest.share() >= BLUNDER && self.falls.interval()[0] > safest.share()
        })
    }
}

/// Breakdown of a record.
#[derive(Debug, Clone)]
pub struct Breakdown {
    /// Moves in their order.
    pub moves: Vec<MoveAnalysis>,
    /// The first fall; none where no block fell.
    pub fall: Option<FallAnalysis>,
    /// Tower before the last move, at rest; as it ended where no block was taken.
    pub tower: World,
    /// True when the replay was not the same as the record.
    pub diverged: bool,
}

impl Breakdown {
    /// Index of the move with the largest chance of a fall, the first of them.
    pub fn riskiest(&self) -> Option<usize> {
        let chance = |index: usize| self.moves[index].falls.share();
        (0..self.moves.len()).reduce(|a, b| if chance(b) > chance(a) { b } else { a })
    }
}

/// Replays a record and tries each of its moves, and others beside it, with an equal part of the
/// survey's budget. Calls `tried` after each rollout.
///
/// # Errors
/// When no game begins like this, or no world can be built of an estimate.
///
/// ```
/// use teeter_game::{Rules, Strength, Survey, Table, TrialErrors, breakdown, contest};
/// use teeter_scene::{TowerOptions, config};
///
/// let scene = config("(010)-(101)-(010)-(111)", &TowerOptions::default()).unwrap();
/// let rules = Rules::of(Table::Official, 2);
/// let game = contest(&scene, rules, &[Strength::Random.thinking(); 2], 1)?;
/// let survey = Survey { rules, errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let breakdown = breakdown(&game.record, &survey, || ())?;
/// assert!(breakdown.fall.is_some() && breakdown.riskiest().is_some());
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
pub fn breakdown(record: &Record, survey: &Survey, tried: impl Fn() + Sync) -> Result<Breakdown, RecordError> {
    let mut run = BreakdownRun::new(Replay::new(record)?, *survey);
    while !run.is_done() {
        match &mut run.trial {
            Some(trial) if !trial.run.is_done() => trial.run.finish_round(&tried).map_err(refused)?,
            _ => run.step()?,
        }
    }
    Ok(run.finish())
}

/// Frames that are replayed in a step.
const FRAMES: u32 = 60;
/// Part of the progress that the replay is.
const REPLAYING: f64 = 0.3;

/// A breakdown in progress, for a caller that has other work between two steps.
///
/// ```
/// use teeter_game::{BreakdownRun, Command, Recorder, Replay, Rules, Survey, TrialErrors};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// let survey = Survey { rules: Rules::default(), errors: TrialErrors::default(), budget: 0.0, seed: 1 };
/// let mut run = BreakdownRun::new(Replay::owning(recorder.finish())?, survey);
/// while !run.is_done() {
///     run.step()?;
/// }
/// assert!(run.progress() == 1.0 && run.finish().moves.is_empty());
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BreakdownRun<'a> {
    survey: Survey,
    replay: Replay<'a>,
    log: MoveLog,
    /// Trial of the move that is analysed.
    trial: Option<Trial>,
    moves: Vec<MoveAnalysis>,
}

/// Rollouts of a move, and of others beside it.
#[derive(Debug, Clone)]
struct Trial {
    others: Vec<Candidate>,
    run: SurveyRun,
}

impl<'a> BreakdownRun<'a> {
    /// Begins with a replay that is at its start.
    pub fn new(replay: Replay<'a>, survey: Survey) -> Self {
        let log = MoveLog::new(replay.game());
        Self { survey, replay, log, trial: None, moves: Vec::new() }
    }

    /// Returns true if every move is analysed.
    pub fn is_done(&self) -> bool {
        self.is_replayed() && self.moves.len() == self.log.moves.len()
    }

    /// Part of the work that is done, 0 to 1, and 1 only at the end.
    pub fn progress(&self) -> f64 {
        if self.is_done() {
            return 1.0;
        }
        let replayed = f64::from(self.replay.frame()) / f64::from(self.replay.record().frames().max(1));
        let trial = self.trial.as_ref().map_or(0.0, |trial| trial.run.progress());
        let tried = (self.moves.len() as f64 + trial) / self.log.moves.len().max(1) as f64;
        let tried = if self.is_replayed() { (1.0 - REPLAYING) * tried } else { 0.0 };
        (REPLAYING * replayed + tried).min(ALMOST)
    }

    /// Replays a second, or makes a rollout.
    ///
    /// # Errors
    /// When no world can be built of an estimate.
    pub fn step(&mut self) -> Result<(), RecordError> {
        if !self.is_replayed() {
            for _ in 0..FRAMES {
                let Some(update) = self.replay.step() else { break };
                self.log.observe(self.replay.game(), &update.events);
            }
            return Ok(());
        }
        let Some(played) = self.log.moves.get(self.moves.len()) else { return Ok(()) };
        match &mut self.trial {
            None => self.trial = Some(Trial::new(played, self.survey, self.log.moves.len())),
            Some(trial) if trial.run.is_done() => {
                self.moves.push(trial.analysis(played));
                self.trial = None;
            }
            Some(trial) => trial.run.step().map_err(refused)?,
        }
        Ok(())
    }

    /// Ends the analysis, with the moves that are analysed so far.
    pub fn finish(self) -> Breakdown {
        let MoveLog { moves, fall, before, .. } = self.log;
        let tower = moves.into_iter().last().map_or_else(|| before.world().clone(), |played| played.before);
        Breakdown { moves: self.moves, fall, tower, diverged: !self.replay.is_same() }
    }

    fn is_replayed(&self) -> bool {
        self.replay.frame() == self.replay.record().frames()
    }
}

fn refused(error: BuildError) -> RecordError {
    RecordError::Start(error.to_string())
}

impl Trial {
    /// Begins to try a move, with the part of the budget of one of `count` moves.
    fn new(played: &Played, survey: Survey, count: usize) -> Self {
        let others: Vec<BodyId> = played.removable.iter().copied().filter(|body| *body != played.plan.body).collect();
        let others = Candidate::best(&played.before, &others, OTHERS);
        let plans: Vec<MovePlan> = std::iter::once(played.plan).chain(others.iter().map(Candidate::plan)).collect();
        let survey = Survey { budget: survey.budget / count as f64, ..survey };
        Self { others, run: SurveyRun::new(survey, played.before.clone(), plans) }
    }

    fn analysis(&self, played: &Played) -> MoveAnalysis {
        let tallies = self.run.tallies();
        let rated = self.others.iter().zip(&tallies[1..]).map(|(other, tally)| (other.body, tally.falls));
        MoveAnalysis {
            turn: played.turn,
            player: played.player,
            body: played.plan.body,
            time_s: played.time_s,
            falls: tallies[0].falls,
            safest: rated.reduce(|a, b| if b.1.share() < a.1.share() { b } else { a }),
            fell: played.fell,
        }
    }
}
