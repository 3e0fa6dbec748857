//! Commands of a player, and reasons to refuse one.

use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;
use teeter_scene::Form;

use crate::hand::grip::GripMode;
use crate::rules::illegal::Illegal;
use crate::tower_map::CellId;

/// Command of a player for one frame. Vectors are in m and in the world frame unless said.
///
/// ```
/// use teeter_game::Command;
///
/// let command: Command = serde_json::from_str(r#"{"command": "place", "body": 7}"#).unwrap();
/// assert!(matches!(command, Command::Place { body: Some(_), slot: None }));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "command", rename_all = "snake_case", deny_unknown_fields)]
pub enum Command {
    /// Changes nothing: a hand that holds a block goes on holding it.
    #[default]
    Idle,
    /// Grasps a block at a point.
    Grasp {
        /// Block.
        body: BodyId,
        /// The point, in the block's frame.
        anchor: DVec3,
        /// Outward normal of the face that was touched.
        normal: DVec3,
        /// Grip to hold it with.
        grip: GripMode,
    },
    /// Moves the goal of the grasped point.
    Move {
        /// Displacement of the goal.
        displacement: DVec3,
        /// Slot that attracts a carried block; one that is not free counts as none.
        #[serde(default)]
        slot: Option<CellId>,
        /// Horizontal direction to the viewer, in which a carried block passes the tower; the last
        /// one where absent.
        #[serde(default)]
        toward_viewer: Option<DVec2>,
    },
    /// Rotates the orientation wanted for a carried block about its centre.
    Turn {
        /// Rotation.
        rotation: DQuat,
    },
    /// Sets a block down: up, over the slot, down, and lets go when it stands.
    Place {
        /// Block; the held one where absent.
        #[serde(default)]
        body: Option<BodyId>,
        /// Slot; where absent the one that attracts the block, else the nearest that the block is
        /// not already in.
        #[serde(default)]
        slot: Option<CellId>,
    },
    /// Turns the hold into a fingertip that goes 6 mm along the inward normal and lets go. Lets go
    /// at once where the block was moved before, is carried, or was touched on top or below.
    Poke,
    /// Lets go.
    Release,
    /// Sets constants of the hand; what is absent stays.
    SetHand {
        /// Largest force, N.
        #[serde(default)]
        max_force: Option<f64>,
        /// True for a slow target.
        #[serde(default)]
        careful: Option<bool>,
        /// False for a hand that cannot rotate a block.
        #[serde(default)]
        can_turn: Option<bool>,
        /// Grip mode of the block in the hand from now on.
        #[serde(default)]
        grip: Option<GripMode>,
    },
    /// Changes the form of all blocks gradually.
    SetBlocks {
        /// Rigid or lattice.
        form: Form,
        /// Stiffness of the springs, N/m; that of the contacts where absent.
        #[serde(default)]
        spring_stiffness: Option<f64>,
    },
    /// Gives up: the player whose turn it is is out of the game.
    Resign,
    /// Rebuilds the tower as it stood at the start, with the blocks in their present form. Where
    /// there are turns, the next game begins with the player who felled it.
    Rebuild,
}

impl Command {
    /// The command with its lengths rounded to hundredths of a millimetre, and directions and
    /// rotations to four decimals: what records store in the fewest bytes.
    ///
    /// ```
    /// use glam::DVec3;
    /// use teeter_game::Command;
    ///
    /// let step = |x| Command::Move { displacement: DVec3::X * x, slot: None, toward_viewer: None };
    /// assert_eq!(step(0.001_234_567).rounded(), step(0.001_23));
    /// ```
    pub fn rounded(self) -> Self {
        match self {
            Self::Grasp { body, anchor, normal, grip } => {
                Self::Grasp { body, anchor: (anchor * 1e5).round() / 1e5, normal: (normal * 1e4).round() / 1e4, grip }
            }
            Self::Move { displacement, slot, toward_viewer } => Self::Move {
                displacement: (displacement * 1e5).round() / 1e5 + DVec3::ZERO,
                slot,
                toward_viewer: toward_viewer.map(|direction| (direction * 1e4).round() / 1e4),
            },
            Self::Turn { rotation } => {
                Self::Turn { rotation: DQuat::from_array(rotation.to_array().map(|x| (x * 1e4).round() / 1e4)) }
            }
            other => other,
        }
    }
}

/// Reason to refuse a command. Nothing has changed then.
///
/// ```
/// use teeter_game::Refusal;
///
/// assert_eq!(Refusal::NothingHeld.to_string(), "no block is held");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The scene has no such body.
    #[error("there is no body {body}: the world has {count}")]
    UnknownBody {
        /// Body.
        body: BodyId,
        /// Number of bodies.
        count: usize,
    },
    /// A number is not finite or out of range.
    #[error("`{field}` is {value}, expected {expected}")]
    Field {
        /// Field of the command.
        field: &'static str,
        /// Its value.
        value: String,
        /// The range.
        expected: &'static str,
    },
    /// The command is about the block in the hand, and the hand is empty.
    #[error("no block is held")]
    NothingHeld,
    /// A block is in the hand already.
    #[error("block {0} is held")]
    Holding(BodyId),
    /// The hand is setting the block down.
    #[error("block {0} is being placed")]
    Placing(BodyId),
    /// Only a carried block can be rotated.
    #[error("block {0} is not carried")]
    NotCarried(BodyId),
    /// The hand cannot rotate blocks.
    #[error("this hand cannot turn a block")]
    CannotTurn,
    /// The block cannot be lifted.
    #[error("block {0} is not free")]
    NotFree(BodyId),
    /// No slot is free for the block.
    #[error("there is no free slot for block {0}")]
    NoSlot(BodyId),
    /// The blocks cannot have that form.
    #[error("{0}")]
    BlockForm(String),
    /// Free play has no player who could give up.
    #[error("this is free play: there are no turns")]
    NoTurns,
    /// The tower cannot be rebuilt.
    #[error("{0}")]
    Rebuild(String),
    /// The rules forbid the command.
    #[error(transparent)]
    Illegal(#[from] Illegal),
}
