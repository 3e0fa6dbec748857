//! The world as a web page sees it: text and numbers in, text and one view on memory out. No physics and no decisions here.
//!
//! Poses cross the border as one view on wasm memory; everything else that is small and rare crosses as JSON in the shapes of
//! [`teeter_physics::Input`] and [`teeter_physics::StepReport`]. Every error is the text of the Rust error.

mod game;
mod scenes;
mod simulation;
mod views;

pub use game::Game;
pub use scenes::{named_scene, scene_list, tower_scene};
pub use simulation::Simulation;

use teeter_wasm_support::Error;
