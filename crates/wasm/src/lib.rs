#![doc = include_str!("../README.md")]

mod game;
mod scenes;
mod simulation;
mod views;

pub use game::Game;
pub use scenes::{named_scene, scene_list, tower_scene};
pub use simulation::Simulation;

use teeter_wasm_support::Error;
