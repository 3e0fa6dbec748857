//! Tables of rules.

use serde::{Deserialize, Serialize};
use teeter_physics::Hand;

/// Maximum number of players.
const MAX_PLAYERS: u32 = 8;
/// Time after which a turn ends although the tower moves, s: that of the rules sold with the game.
const SETTLE_TIME: f64 = 10.0;
/// Time for a turn in strict rules, s.
const STRICT_TIME: f64 = 60.0;
/// Longest time that a rule may give, s.
const MAX_TIME: f64 = 86_400.0;

/// Names of the tables.
///
/// ```
/// use teeter_game::Table;
///
/// assert_eq!(serde_json::from_str::<Table>(r#""throw-and-go""#)?, Table::ThrowAndGo);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Table {
    /// No turns and no rules: any command at any time.
    Free,
    /// Rules sold with the game.
    Official,
    /// Official, and a block that was moved must be taken, within a minute.
    Strict,
    /// Any row but the bottom one.
    Friendly,
    /// Rules of the dissertation of 2003: any block, put anywhere.
    Dissertation,
    /// A single player scores blocks and rows.
    Solo,
    /// A die says from which rows, and from the middle or an end.
    ThrowAndGo,
}

impl Table {
    /// All tables.
    pub const ALL: [Self; 7] =
        [Self::Free, Self::Official, Self::Strict, Self::Friendly, Self::Dissertation, Self::Solo, Self::ThrowAndGo];
}

/// Rows that blocks may be taken from.
///
/// ```
/// use teeter_game::{Rules, Source, Table};
///
/// assert_eq!(Rules::of(Table::Friendly, 2).source, Source::AboveFirst);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// Any block, those beside the tower included.
    Anything,
    /// Rows below the highest complete one.
    BelowComplete,
    /// Rows above the bottom one.
    AboveFirst,
}

/// Duty that follows from moving a block without taking it.
///
/// ```
/// use teeter_game::{Nudge, Rules, Table};
///
/// assert_eq!(Rules::of(Table::Strict, 2).nudge, Nudge::Take);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Nudge {
    /// None: another block may be touched.
    Ignore,
    /// It is put back before another is touched.
    PutBack,
    /// It must be taken.
    Take,
}

/// Target of a block that was taken.
///
/// ```
/// use teeter_game::{Rules, Table, Target};
///
/// assert_eq!(Rules::of(Table::Dissertation, 2).target, Target::Anywhere);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// Across the row beneath, and each row complete before the next.
    OnTop,
    /// Anywhere.
    Anywhere,
}

/// Points of a player.
///
/// ```
/// use teeter_game::{Rules, Table};
///
/// let points = Rules::of(Table::Solo, 1).points.expect("solo is played for points");
/// assert_eq!((points.block, points.row), (1, 3));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Points for a block that was placed.
    pub block: u32,
    /// Points besides for the block that completes a row.
    pub row: u32,
}

/// Rules of a game, as plain data.
///
/// ```
/// use teeter_game::{Rules, Table};
///
/// let rules = Rules { turn_s: Some(30.0), ..Rules::of(Table::Official, 3) };
/// assert!(rules.validate().is_ok());
/// let error = Rules::of(Table::Official, 9).validate().unwrap_err();
/// assert_eq!(error.to_string(), "`players` is 9, expected 1 to 8");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    /// Table that the rules are from.
    pub table: Table,
    /// Number of players.
    pub players: u32,
    /// Player who begins, from 0.
    #[serde(default)]
    pub first: u32,
    /// Rows that blocks may be taken from.
    pub source: Source,
    /// Duty after moving a block.
    pub nudge: Nudge,
    /// Target of a block.
    pub target: Target,
    /// Time until a block must be placed, s of the simulation; none without a clock.
    pub turn_s: Option<f64>,
    /// Time after placing at which the turn ends although the tower still moves, s.
    pub settle_s: f64,
    /// Largest force that a hand may be given, N.
    pub max_force: f64,
    /// Points; none where there is no score.
    pub points: Option<Points>,
    /// Seed of the die; none without one.
    pub die: Option<u64>,
}

impl Default for Rules {
    fn default() -> Self {
        Self::of(Table::Free, 1)
    }
}

impl Rules {
    /// Rules of a table for a number of players. Solo and free play have one player whatever
    /// `players` is. The die has the seed 0.
    pub fn of(table: Table, players: u32) -> Self {
        let official = Self {
            table,
            players,
            first: 0,
            source: Source::BelowComplete,
            nudge: Nudge::PutBack,
            target: Target::OnTop,
            turn_s: None,
            settle_s: SETTLE_TIME,
            max_force: Hand::DEFAULT_FORCE,
            points: None,
            die: None,
        };
        let lax = Self { source: Source::Anything, nudge: Nudge::Ignore, target: Target::Anywhere, ..official };
        match table {
            Table::Free => Self { players: 1, max_force: Hand::MAX_FORCE, ..lax },
            Table::Official => official,
            Table::Strict => Self { nudge: Nudge::Take, turn_s: Some(STRICT_TIME), ..official },
            Table::Friendly => Self { source: Source::AboveFirst, nudge: Nudge::Ignore, ..official },
            Table::Dissertation => lax,
            Table::Solo => Self { players: 1, points: Some(Points { block: 1, row: 3 }), ..official },
            Table::ThrowAndGo => Self { die: Some(0), ..official },
        }
    }

    /// Returns true if there are turns, a loser, and commands that are illegal.
    pub fn has_turns(&self) -> bool {
        self.table != Table::Free
    }

    /// Checks that each rule is in its range.
    ///
    /// # Errors
    /// Names the first that is not.
    pub fn validate(&self) -> Result<(), RulesError> {
        let check = |field, is_valid: bool, value: String, expected| {
            if is_valid { Ok(()) } else { Err(RulesError::Field { field, value, expected }) }
        };
        let time = |seconds: f64| seconds > 0.0 && seconds <= MAX_TIME;
        let players = self.players;
        check("players", (1..=MAX_PLAYERS).contains(&players), players.to_string(), "1 to 8")?;
        check("first", self.first < players, self.first.to_string(), "a player, counted from 0")?;
        let turn_s = self.turn_s.unwrap_or(MAX_TIME);
        check("turn_s", time(turn_s), turn_s.to_string(), "more than 0 and at most 86400 s")?;
        check("settle_s", time(self.settle_s), self.settle_s.to_string(), "more than 0 and at most 86400 s")?;
        let force = self.max_force;
        check("max_force", force > 0.0 && force <= Hand::MAX_FORCE, force.to_string(), "more than 0 and at most 50 N")
    }
}

/// Reason why no game can be played by some rules.
///
/// ```
/// use teeter_game::RulesError;
///
/// assert_eq!(RulesError::NoBlock.to_string(), "these rules let no block of this tower be taken");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RulesError {
    /// Rule that is out of its range.
    #[error("`{field}` is {value}, expected {expected}")]
    Field {
        /// Name of the rule.
        field: &'static str,
        /// Its value.
        value: String,
        /// The range.
        expected: &'static str,
    },
    /// Tower without a block that may be taken.
    #[error("these rules let no block of this tower be taken")]
    NoBlock,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_valid_for_one_to_eight_players_and_survives_json() {
        for table in Table::ALL {
            for players in 1..=8 {
                let rules = Rules::of(table, players);
                assert_eq!(rules.validate(), Ok(()), "{table:?}");
                let text = serde_json::to_string(&rules).unwrap();
                assert_eq!(serde_json::from_str::<Rules>(&text).unwrap(), rules);
            }
        }
        assert!(Rules::of(Table::Official, 0).validate().is_err());
    }

    #[test]
    fn a_rule_out_of_its_range_is_named() {
        let official = Rules::of(Table::Official, 2);
        let cases = [
            ("first", Rules { first: 2, ..official }),
            ("turn_s", Rules { turn_s: Some(0.0), ..official }),
            ("turn_s", Rules { turn_s: Some(f64::NAN), ..official }),
            ("settle_s", Rules { settle_s: f64::INFINITY, ..official }),
            ("max_force", Rules { max_force: 51.0, ..official }),
            ("max_force", Rules { max_force: f64::NAN, ..official }),
        ];
        for (name, rules) in cases {
            let line = rules.validate().unwrap_err().to_string();
            assert!(line.starts_with(&format!("`{name}` is ")), "{line}");
        }
    }
}
