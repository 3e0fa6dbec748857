//! Report of a game after each frame.

use glam::{DQuat, DVec3};
use serde::Serialize;
use teeter_physics::{BodyId, ContactReport};
use teeter_scene::Form;

use crate::fall::TowerState;
use crate::hand::grip::{GripMode, HoldGrip};
use crate::rules::illegal::Illegal;
use crate::rules::throw::Throw;
use crate::rules::turn::TurnState;
use crate::tower_map::{CellId, Slot};

/// State of a game after a frame; `R` is the report of its simulator.
///
/// ```
/// use teeter_game::{Command, Game};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default())?);
/// let update = game.step(&Command::Idle);
/// let text = serde_json::to_string(&update).unwrap();
/// assert!(text.contains(r#""tower":"standing""#) && update.events.is_empty());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Update<R> {
    /// Report of the simulator on the frame.
    pub report: R,
    /// The hand; none where it is empty.
    pub hand: Option<HandState>,
    /// Free slots for the carried block.
    pub slots: Vec<Slot>,
    /// State of the tower.
    pub tower: TowerState,
    /// Blocks that have fallen so far.
    pub fallen: Vec<BodyId>,
    /// Blocks that were frozen so far because their state ran away.
    pub quarantined: Vec<BodyId>,
    /// True when the tower is at rest: the forces in its contacts are then those of rest.
    pub at_rest: bool,
    /// Form of the blocks.
    pub form: Form,
    /// Stiffness of the springs within the blocks, N/m; none where they are rigid.
    pub spring_stiffness: Option<f64>,
    /// State of the turn; none in free play.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<TurnState>,
    /// Events of the frame, in their order.
    pub events: Vec<Event>,
}

/// The hand and the block in it.
///
/// ```
/// use glam::DVec3;
/// use teeter_game::{Command, Game, GripMode, HandState, HoldGrip};
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default())?);
/// let (body, anchor) = (BodyId(4), DVec3::new(0.0405, 0.0, 0.0));
/// let normal = game.blocks().orientation(body) * DVec3::X;
/// let grasp = Command::Grasp { body, anchor, normal, grip: GripMode::Auto };
/// let hand: HandState = game.step(&grasp).hand.unwrap();
/// // a block with others on top slides
/// assert_eq!((hand.body, hand.grip, hand.placing), (body, HoldGrip::Slide, false));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HandState {
    /// The block.
    pub body: BodyId,
    /// Present grip.
    pub grip: HoldGrip,
    /// Grip that the player asks for.
    pub mode: GripMode,
    /// Grasped point in the block's frame, m.
    pub anchor: DVec3,
    /// Directions in which the goal can be moved, unit vectors: along and across a block that
    /// slides, inwards for a push. Empty for a carried block, whose goal can be moved anywhere.
    pub axes: Vec<DVec3>,
    /// Force of the hand on the block, N.
    pub force: DVec3,
    /// True when the hand gives all its force.
    pub capped: bool,
    /// Grasped point, m.
    pub point: DVec3,
    /// Limited target that pulls at it, m.
    pub target: DVec3,
    /// Position that the player wants for it, m.
    pub goal: DVec3,
    /// Orientation that the player wants; none leaves it free.
    pub orientation: Option<DQuat>,
    /// True while the hand sets the block down by itself.
    pub placing: bool,
    /// True while the hand pokes the block.
    pub poking: bool,
    /// Slot that attracts the block, or that it is being placed in.
    pub slot: Option<CellId>,
    /// Time for which the block has not moved under the full force of the hand, s.
    pub stuck_s: f64,
    /// Loaded contacts of the block.
    pub contacts: Vec<ContactReport>,
}

/// Something that happened in a frame.
///
/// ```
/// use teeter_game::Event;
/// use teeter_physics::BodyId;
///
/// let event = Event::Poked { body: BodyId(7) };
/// assert_eq!(serde_json::to_string(&event).unwrap(), r#"{"event":"poked","body":7}"#);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// A block was grasped.
    Grasped {
        /// The block.
        body: BodyId,
    },
    /// A block was let go: by the player, or because it did not come down when it was placed.
    Released {
        /// The block.
        body: BodyId,
    },
    /// A block was set down.
    Placed {
        /// The block.
        body: BodyId,
        /// Its slot.
        slot: CellId,
    },
    /// A poke is over.
    Poked {
        /// The block.
        body: BodyId,
    },
    /// Blocks fell.
    Fell {
        /// The blocks.
        bodies: Vec<BodyId>,
    },
    /// A command was refused, and nothing changed.
    Refused {
        /// The reason, as one line.
        reason: String,
    },
    /// A command was refused because the rules forbid it, and nothing changed.
    Illegal {
        /// The rule.
        rule: Illegal,
        /// The reason, as one line.
        reason: String,
    },
    /// A turn began.
    TurnStarted {
        /// Player, from 0.
        player: u32,
        /// Number of the turn, from 1.
        number: u32,
    },
    /// The die was thrown for the turn.
    Thrown {
        /// Its face.
        throw: Throw,
    },
    /// A block was moved within the tower.
    Nudged {
        /// Player.
        player: u32,
        /// The block.
        body: BodyId,
    },
    /// A block that was moved is back where it was.
    PutBack {
        /// Player.
        player: u32,
        /// The block.
        body: BodyId,
    },
    /// A block came out of the tower.
    Removed {
        /// Player.
        player: u32,
        /// The block.
        body: BodyId,
    },
    /// A turn ended with a block placed safely.
    Settled {
        /// Player.
        player: u32,
    },
    /// A player scored.
    Scored {
        /// Player.
        player: u32,
        /// Points.
        points: u32,
    },
    /// A player gave up.
    Resigned {
        /// Player.
        player: u32,
    },
    /// A player ran out of time.
    TimedOut {
        /// Player.
        player: u32,
    },
    /// The game ended, and this player lost it.
    Lost {
        /// Player.
        player: u32,
    },
    /// The game ended, and this player won it.
    Won {
        /// Player.
        player: u32,
    },
    /// The tower was rebuilt.
    Rebuilt,
}
