#![doc = include_str!("../README.md")]

mod game;
mod scenes;
mod simulation;
mod sounds;
mod views;

pub use game::Game;
pub use scenes::{named_scene, scene_list, tower_scene};
pub use simulation::Simulation;
pub use sounds::Listener;

use teeter_wasm_support::Error;
