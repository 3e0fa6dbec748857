//! Plans of a move and stages of carrying one out.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;

use crate::tower_map::{CellId, Slot};

/// Extraction of a block from the tower.
///
/// ```
/// use teeter_game::Extraction;
///
/// assert_eq!(serde_json::to_string(&Extraction::PushThrough)?, r#""push_through""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Extraction {
    /// Draws it out by an end.
    Pull,
    /// Pushes it half through by an end with a fingertip, then draws it out by the other.
    PushThrough,
    /// Pokes it to test it, and draws it out by the other end where it moved.
    Test,
}

/// Plan of a move.
///
/// ```
/// use teeter_game::{Extraction, MovePlan};
/// use teeter_physics::BodyId;
///
/// let plan = MovePlan::pull(BodyId(4), glam::DVec3::Y);
/// assert_eq!((plan.extraction, plan.slot), (Extraction::Pull, None));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovePlan {
    /// Block to take.
    pub body: BodyId,
    /// Direction of the world in which it leaves the tower.
    pub toward: DVec3,
    /// Extraction.
    pub extraction: Extraction,
    /// Slot to put it in; one beside at most one neighbour where absent.
    pub slot: Option<CellId>,
}

impl MovePlan {
    /// Draws a block out and puts it into any slot.
    pub fn pull(body: BodyId, toward: DVec3) -> Self {
        Self { body, toward, extraction: Extraction::Pull, slot: None }
    }
}

/// End of a move.
///
/// ```
/// use teeter_game::MoveEnd;
///
/// assert_ne!(MoveEnd::Placed, MoveEnd::Stuck);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MoveEnd {
    /// The block was put down in its slot.
    Placed,
    /// The block does not come out, and was put back.
    Stuck,
    /// The block could not be put down where it was planned, or was lost before.
    Dropped,
}

/// Goal of a block over its slot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// The slot.
    pub slot: Slot,
    /// Offset of the hand's aim, m.
    pub aim: DVec3,
    /// Orientation that the hand gives the block.
    pub orientation: DQuat,
    /// Horizontal unit vector away from the neighbour; zero where there is none, or one on each
    /// side.
    pub away: DVec3,
    /// Number of times that the block came down on a neighbour.
    pub tries: u32,
}

impl Landing {
    /// Position wanted for the centre, at the height of the slot, m.
    pub fn centre(&self) -> DVec3 {
        self.slot.position + self.aim.with_z(0.0)
    }

    /// Height at which the block passes over its neighbours, m.
    pub fn crossing(&self) -> f64 {
        self.slot.position.z + self.slot.clearance + 0.008
    }
}

/// Stage of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Begins to poke the block by the end opposite to where it leaves.
    Touch,
    /// Waits until the poke is over.
    Poked,
    /// Begins to push it through.
    Finger,
    /// Pushes. Travel of the goal so far, m.
    Push(f64),
    /// Takes hold of the end by which it leaves.
    Grasp,
    /// Draws. Travel of the goal so far, m.
    Pull(f64),
    /// Takes hold of a block that was left where it does not belong.
    Return,
    /// Moves a block back that does not come out.
    Back,
    /// Draws a block that is out clear of the tower. Travel of the goal so far, m.
    Clear(f64),
    /// Rises beside the tower.
    Rise(Landing),
    /// Gives the block the orientation of its slot.
    Turn(Landing),
    /// Holds it in the air, whatever is beneath.
    Hold(Landing),
    /// Crosses to above the slot.
    Cross(Landing),
    /// Lowers it.
    Lower(Landing),
    /// Stands; frames until the hand opens.
    Stand(Landing, u32),
    /// Lets go.
    LetGo(MoveEnd),
    /// The end.
    Done(MoveEnd),
}
