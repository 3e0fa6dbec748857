#![doc = include_str!("../README.md")]

mod breakaway_force;
mod cholesky;
mod collapse;
mod collapse_angle;
mod cuboid;
mod drag_rotation;
mod drawn_tower;
mod drop_block;
mod end_grip;
mod extraction;
mod fall;
mod force_map;
mod hand_path;
#[cfg(feature = "inputs")]
mod inputs;
#[cfg(feature = "inputs")]
mod json_fields;
mod limit_analysis;
mod long_rest;
mod max_height;
mod mechanism;
mod par_map;
mod plan;
mod prediction;
mod put_back;
mod reference_positions;
mod removal;
mod rest;
mod settle;
mod solid;
mod stiff_limit;
mod timeline;
pub mod torsion;
mod xray;

pub use breakaway_force::{MAX_BREAKAWAY_FORCE, SLIP_DISTANCE, breakaway_force};
pub use collapse::{Collapse, collapse};
pub use collapse_angle::collapse_angle;
pub use cuboid::Cuboid;
pub use drag_rotation::{Drag, drag_rotation};
pub use drawn_tower::drawn_tower;
pub use drop_block::{DroppedBlock, drop_block};
pub use extraction::{Extraction, extract};
pub use fall::Footing;
pub use force_map::{BlockForces, force_map, force_map_from};
pub use hand_path::HandPath;
#[cfg(feature = "inputs")]
pub use inputs::{InputsError, MAX_CHANGE_TIME, read_inputs};
#[cfg(feature = "inputs")]
pub use json_fields::FieldError;
pub use limit_analysis::{Breakaway, LimitError, Patch, RigidTower};
pub use long_rest::{LongRest, long_rest};
pub use max_height::{max_height, scene_height};
pub use mechanism::{Mechanism, Spread, mechanism};
pub use par_map::par_map;
pub use plan::{long_axis, pull_axis};
pub use prediction::{Prediction, predict};
pub use put_back::{PutBack, PutBackOptions, put_back};
pub use reference_positions::ReferencePositions;
pub use removal::{Removal, removable_blocks, remove, without_block};
pub use rest::{PILE_SPEED, REST_SPEED, REST_TIME, RestTimer, SETTLED_SPEED, VISIBLE_SPEED};
pub use settle::{SETTLE_TIME, settled};
pub use solid::{Solid, max_penetration, max_penetration_between};
pub use timeline::{Change, HandMotion, HandOrientation, Timeline};
pub use xray::{Load, xray};
