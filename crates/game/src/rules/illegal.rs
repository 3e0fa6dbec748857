//! Reasons why the rules refuse a command.

use serde::Serialize;
use teeter_physics::BodyId;

/// Reason why the rules refuse a command; nothing has changed then.
///
/// ```
/// use teeter_game::Illegal;
/// use teeter_physics::BodyId;
///
/// let illegal = Illegal::PutBackFirst { body: BodyId(7) };
/// assert_eq!(illegal.to_string(), "block 7 was moved: put it back before another is touched");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "rule", rename_all = "snake_case")]
pub enum Illegal {
    /// The game is over.
    #[error("the game is over")]
    Over,
    /// A tower is rebuilt when the game is over.
    #[error("the tower is rebuilt when the game is over")]
    NotOver,
    /// The block is in the highest complete row, or above it.
    #[error("block {body} is too high: only rows below the highest complete one give blocks")]
    TooHigh {
        /// The block.
        body: BodyId,
    },
    /// The block is in the bottom row.
    #[error("block {body} is in the bottom row, which gives no block")]
    BottomRow {
        /// The block.
        body: BodyId,
    },
    /// The block is not in the tower.
    #[error("block {body} is not in the tower")]
    NotInTower {
        /// The block.
        body: BodyId,
    },
    /// The die allows other blocks.
    #[error("block {body} is not one that the die allows")]
    NotThrown {
        /// The block.
        body: BodyId,
    },
    /// A block that was moved is put back before another is touched.
    #[error("block {body} was moved: put it back before another is touched")]
    PutBackFirst {
        /// The block that was moved.
        body: BodyId,
    },
    /// A block that was moved must be taken.
    #[error("block {body} was moved: it must be taken")]
    MustTake {
        /// The block that was moved.
        body: BodyId,
    },
    /// A turn takes a single block.
    #[error("block {body} was taken in this turn: place it")]
    OneBlock {
        /// The block that was taken.
        body: BodyId,
    },
    /// A block is placed after it was taken out.
    #[error("no block was taken out in this turn")]
    NotTakenOut,
    /// A hand has limited force.
    #[error("a hand has at most {max_force} N")]
    TooStrong {
        /// Largest force, N.
        max_force: f64,
    },
    /// The form of the blocks stays while one is moved.
    #[error("the blocks change their form only before a block is moved")]
    BlockForm,
}
