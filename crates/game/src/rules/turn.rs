//! Phases of a turn, and its state as an update reports it.

use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;

use crate::rules::throw::Throw;

/// Phase of a game.
///
/// ```
/// use teeter_game::Phase;
///
/// assert_eq!(serde_json::to_string(&Phase::Choosing)?, r#""choosing""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// No block was moved: blocks may be touched and poked.
    Choosing,
    /// A block was moved and is still in the tower.
    Removing,
    /// A block is out of the tower and has to be placed.
    Placing,
    /// The block stands on top, and the tower comes to rest.
    Settling,
    /// The game has ended.
    Over,
}

/// End of a game.
///
/// ```
/// use teeter_game::Outcome;
///
/// let outcome = Outcome { loser: Some(1), winner: Some(0) };
/// assert_eq!(serde_json::to_string(&outcome)?, r#"{"loser":1,"winner":0}"#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Outcome {
    /// Player in whose turn the tower fell, or who placed the last block less than 10 s before and
    /// nobody touched another since; or who gave up last. This player rebuilds the tower and
    /// begins the next game.
    pub loser: Option<u32>,
    /// Player who was the last to place a block safely; none where one plays alone.
    pub winner: Option<u32>,
}

/// State of the turn.
///
/// ```
/// use teeter_game::{Command, Game, Phase, Rules, Table};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let world = World::new(&scene, Params::default())?;
/// let mut game = Game::with_rules(world, Rules::of(Table::Official, 2)).unwrap();
/// let turn = game.step(&Command::Idle).turn.unwrap();
/// // all rows but the highest complete one give blocks
/// assert_eq!((turn.phase, turn.player, turn.removable.len()), (Phase::Choosing, 0, 51));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TurnState {
    /// Number of the turn, from 1.
    pub number: u32,
    /// Player whose turn it is, from 0.
    pub player: u32,
    /// Phase.
    pub phase: Phase,
    /// Time since the turn began without that of settling, s.
    pub elapsed_s: f64,
    /// Time left of the turn, s; none without a clock.
    pub left_s: Option<f64>,
    /// Block that was moved, taken out or placed in this turn.
    pub block: Option<BodyId>,
    /// Blocks that may be touched now.
    pub removable: Vec<BodyId>,
    /// Throw of the die.
    pub throw: Option<Throw>,
    /// Points of each player; empty where there is no score.
    pub scores: Vec<u32>,
    /// Players who are out: they gave up or ran out of time.
    pub out: Vec<u32>,
    /// End of the game; none before.
    pub outcome: Option<Outcome>,
}
