#![doc = include_str!("../README.md")]

mod blocks;
mod command;
mod fall;
mod game;
mod hand;
mod headroom;
mod orientation;
mod rest;
mod script;
mod simulator;
mod snapshot;
mod stiffness_ramp;
mod tower_map;
mod update;

pub use blocks::Blocks;
pub use command::{Command, Refusal};
pub use fall::{FallDetector, FrameEnd, TowerState};
pub use game::Game;
pub use hand::clearance::TowerColumn;
pub use hand::grip::{GripMode, HoldGrip};
pub use hand::limiter::{LimitedGoal, TargetLimiter};
pub use hand::placement_path::{Stage, Waypoint, waypoint};
pub use headroom::is_free;
pub use orientation::{angle_between, levelled, nearest_alike, slide_axis};
pub use rest::{Motion, RestDetector};
pub use script::TakeAndPlace;
pub use simulator::{Simulator, StepOutcome};
pub use snapshot::RestoreError;
pub use stiffness_ramp::{BlockForm, StiffnessRamp};
pub use teeter_study::{HandPath, SETTLED_SPEED, VISIBLE_SPEED};
pub use tower_map::{CellId, Slot, TowerMap};
pub use update::{Event, HandState, Update};
