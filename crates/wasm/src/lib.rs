//! The world as a web page sees it: text and numbers in, text and one view on memory out. No physics and no decisions here.
//!
//! Poses cross the border as one view on wasm memory; everything else that is small and rare crosses as JSON in the shapes of
//! [`teeter_physics::Input`] and [`teeter_physics::StepReport`]. Every error is the text of the Rust error.

mod scenes;
mod simulation;

pub use scenes::{named_scene, scene_list, tower_scene};
pub use simulation::Simulation;

use wasm_bindgen::prelude::*;

/// What failed, as one line for the user. JavaScript receives it as an `Error` with this message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure(pub String);

impl Failure {
    /// A failure that names what was being read.
    pub(crate) fn reading(what: &str, error: impl std::fmt::Display) -> Self {
        Self(format!("{what}: {error}"))
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Failure {}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        JsError::new(&failure.0).into()
    }
}

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console)]
    fn error(line: &str);
}

/// Sends the text of a panic to the console: without it a fault of the engine would read "unreachable executed".
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen(start)]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|info| error(&info.to_string())));
}
