#![doc = include_str!("../README.md")]

mod analysis;
mod game;
mod opponent;
mod replay;
mod scenes;
mod simulation;
mod sounds;
mod text;
mod views;

pub use analysis::{RecordAnalysis, TowerAnalysis};
pub use game::Game;
pub use opponent::{Opponent, Thought};
pub use replay::{Keyframes, Replay, engine, record_engine};
pub use scenes::{named_scene, scene_list, tower_scene};
pub use simulation::Simulation;
pub use sounds::Listener;

use teeter_wasm_support::Error;
