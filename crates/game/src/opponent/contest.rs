//! Contest: a game of opponents against each other, as a record.

use teeter_physics::Params;
use teeter_scene::{Random, Scene};

use crate::opponent::player::Opponent;
use crate::opponent::strength::Thinking;
use crate::record::error::RecordError;
use crate::record::file::Record;
use crate::record::recorder::Recorder;
use crate::rules::table::Rules;
use crate::rules::turn::{Outcome, Phase};
use crate::update::Event;

/// Frames after which a game ends without a loser: four hours.
const MAX_FRAMES: u32 = 864_000;
/// Frames that the record goes on after the end, so that it shows the fall.
const EPILOGUE: u32 = 120;

/// A game that was played.
#[derive(Debug, Clone, PartialEq)]
pub struct Contest {
    /// Its record.
    pub record: Record,
    /// Its end; none where it had none.
    pub outcome: Option<Outcome>,
    /// Number of moves that were completed.
    pub moves: u32,
    /// True when a block fell, and the game did not end by giving up.
    pub fell: bool,
}

/// Plays a game of opponents, one for each player of the rules.
///
/// # Errors
/// When no game can begin like this, or it is too long for a record.
///
/// ```
/// use teeter_game::{Rules, Strength, Table, contest};
/// use teeter_scene::{TowerOptions, config};
///
/// // one of the first moves fells this tower
/// let scene = config("(010)-(101)-(010)-(111)", &TowerOptions::default()).unwrap();
/// let players = [Strength::Random.thinking(); 2];
/// let game = contest(&scene, Rules::of(Table::Official, 2), &players, 1)?;
/// assert!(game.fell && game.outcome.is_some());
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
pub fn contest(scene: &Scene, rules: Rules, players: &[Thinking], seed: u64) -> Result<Contest, RecordError> {
    let mut recorder = Recorder::new(scene, Params::default(), rules)?;
    let mut random = Random::new(seed);
    let seats = (0..).zip(players);
    let mut opponents: Vec<Opponent> =
        seats.map(|(player, thinking)| Opponent::with_thinking(player, *thinking, random.bits())).collect();
    let (mut moves, mut fell) = (0, false);
    for _ in 0..MAX_FRAMES {
        let Some(turn) = recorder.game().turn().filter(|turn| turn.phase != Phase::Over) else { break };
        let Some(opponent) = opponents.get_mut(turn.player as usize) else { break };
        let command = opponent.next(recorder.game());
        let update = recorder.step(&command)?;
        moves += update.events.iter().filter(|event| matches!(event, Event::Settled { .. })).count() as u32;
        fell |= update.events.iter().any(|event| matches!(event, Event::Fell { .. }));
    }
    let outcome = recorder.game().turn().and_then(|turn| turn.outcome);
    for _ in 0..EPILOGUE {
        recorder.step(&crate::command::Command::Idle)?;
    }
    Ok(Contest { record: recorder.finish(), outcome, moves, fell })
}
