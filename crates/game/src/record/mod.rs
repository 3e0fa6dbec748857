//! Records: a game as its scene, parameters, rules and commands, with checks that a replay is the
//! same.

pub mod blocks_code;
pub mod bytes;
pub mod command_code;
pub mod engine;
pub mod error;
pub mod file;
pub mod nominal_cell;
pub mod number_code;
pub mod player_names;
pub mod pose_code;
pub mod recorder;
pub mod replay;
pub mod resume;
pub mod rice_code;
pub mod scene_code;
pub mod tape;
