//! Breakdown of a recorded game: the chance of each move, the riskiest, the blunders, and why the
//! tower fell.

use teeter_physics::{BodyId, BuildError, World};

use crate::analysis::candidate::Candidate;
use crate::analysis::collapse_cause::{ContactWatch, LostContact};
use crate::analysis::proportion::Proportion;
use crate::analysis::survey::Survey;
use crate::game::Game;
use crate::orientation::slide_axis;
use crate::player::stage::MovePlan;
use crate::record::error::RecordError;
use crate::record::file::Record;
use crate::record::replay::Replay;
use crate::update::Event;

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

/// Fall of a recorded tower.
#[derive(Debug, Clone, PartialEq)]
pub struct FallAnalysis {
    /// Time at which the first blocks fell, s.
    pub time_s: f64,
    /// These blocks.
    pub bodies: Vec<BodyId>,
    /// Block that was being taken.
    pub taken: BodyId,
    /// Loaded contact that was lost first; none where none was lost before the fall.
    pub first_lost: Option<LostContact>,
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
}

impl Breakdown {
    /// The move with the largest chance of a fall, the first of them.
    pub fn riskiest(&self) -> Option<&MoveAnalysis> {
        self.moves.iter().reduce(|a, b| if b.falls.share() > a.falls.share() { b } else { a })
    }
}

/// A move as it was played.
struct Played {
    turn: u32,
    player: u32,
    plan: MovePlan,
    time_s: f64,
    before: World,
    removable: Vec<BodyId>,
    fell: bool,
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
    let (played, fall, end) = replayed(record)?;
    let part = Survey { budget: survey.budget / played.len().max(1) as f64, ..*survey };
    let analysed = played.iter().map(|played| analyse(played, &part, &tried));
    let moves = analysed.collect::<Result<Vec<_>, _>>().map_err(|error| RecordError::Start(error.to_string()))?;
    let tower = played.into_iter().last().map_or(end, |played| played.before);
    Ok(Breakdown { moves, fall, tower })
}

fn analyse(played: &Played, survey: &Survey, tried: &(impl Fn() + Sync)) -> Result<MoveAnalysis, BuildError> {
    let others: Vec<BodyId> = played.removable.iter().copied().filter(|body| *body != played.plan.body).collect();
    let others = Candidate::best(&played.before, &others, OTHERS);
    let plans: Vec<MovePlan> = std::iter::once(played.plan).chain(others.iter().map(Candidate::plan)).collect();
    let tallies = survey.run(&played.before, &plans, tried)?;
    let rated = others.iter().zip(&tallies[1..]).map(|(other, tally)| (other.body, tally.falls));
    Ok(MoveAnalysis {
        turn: played.turn,
        player: played.player,
        body: played.plan.body,
        time_s: played.time_s,
        falls: tallies[0].falls,
        safest: rated.reduce(|a, b| if b.1.share() < a.1.share() { b } else { a }),
        fell: played.fell,
    })
}

/// Moves of a record, its first fall, and the world at its end.
fn replayed(record: &Record) -> Result<(Vec<Played>, Option<FallAnalysis>, World), RecordError> {
    let mut replay = Replay::new(record)?;
    let (mut moves, mut fall): (Vec<Played>, Option<FallAnalysis>) = (Vec::new(), None);
    let mut begun: Option<Played> = None;
    let mut watch: Option<ContactWatch> = None;
    let mut before = replay.game().clone();
    while let Some(update) = replay.step() {
        if let Some(watch) = &mut watch {
            watch.observe(replay.game().world());
        }
        for event in &update.events {
            match event {
                Event::Grasped { body } if moves.last().is_none_or(|last| !goes_on(last, &before, *body)) => {
                    begun = Some(begin(&before, *body));
                    watch = Some(ContactWatch::new(before.world(), *body));
                }
                Event::Removed { body, .. } | Event::Placed { body, .. } => {
                    if let Some(played) = begun.take_if(|played| played.plan.body == *body) {
                        moves.push(directed(played, replay.game()));
                    }
                }
                Event::Fell { bodies } if fall.is_none() => {
                    let Some(watch) = &watch else { continue };
                    moves.extend(begun.take().map(|played| directed(played, replay.game())));
                    moves.iter_mut().rev().take(1).for_each(|last| last.fell = true);
                    let (time_s, taken) = (replay.game().world().time(), watch.taken());
                    fall = Some(FallAnalysis { time_s, bodies: bodies.clone(), taken, first_lost: watch.first_lost() });
                }
                _ => {}
            }
        }
        before.clone_from(replay.game());
    }
    Ok((moves, fall, before.world().clone()))
}

/// Returns true if a grasp of `body` goes on with the last move: the block is out already.
fn goes_on(last: &Played, before: &Game, body: BodyId) -> bool {
    let turn = before.turn();
    last.plan.body == body && turn.is_some_and(|turn| turn.number == last.turn && turn.block == Some(body))
}

fn begin(before: &Game, body: BodyId) -> Played {
    let turn = before.turn();
    let removable = turn.as_ref().map_or_else(|| before.blocks().bodies().collect(), |turn| turn.removable.clone());
    let (turn, player) = turn.map_or((0, 0), |turn| (turn.number, turn.player));
    let plan = Candidate::ranked(before.world(), &[body])[0].plan();
    let (time_s, before) = (before.world().time(), before.world().clone());
    Played { turn, player, plan, time_s, before, removable, fell: false }
}

/// The move with the direction in which its block went.
fn directed(played: Played, game: &Game) -> Played {
    let before = played.before.pose(played.plan.body);
    let along = slide_axis(before.orientation);
    let travel = (game.blocks().position(played.plan.body) - before.position).dot(along);
    // What moved less than a millimetre has no direction yet.
    let toward = match travel {
        x if x > 1e-3 => along,
        x if x < -1e-3 => -along,
        _ => played.plan.toward,
    };
    Played { plan: MovePlan { toward, ..played.plan }, ..played }
}
