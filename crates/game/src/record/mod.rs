//! Records: a game as its scene, parameters, rules and commands, with checks that a replay is the
//! same.

pub mod bytes;
pub mod command_code;
pub mod engine;
pub mod error;
pub mod file;
pub mod pose_code;
pub mod recorder;
pub mod replay;
pub mod resume;
pub mod scene_code;
pub mod tape;
