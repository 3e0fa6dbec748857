//! The simulators of the 2003 dissertation as the museum on the page sees them: text and numbers in, text and views on memory out. No
//! physics here. A module of its own, so that the game does not load it.
//!
//! Every error is the text of the Rust error.

mod fit;
mod plane;
mod space;

pub use plane::Plane;
pub use space::Space;

use teeter_wasm_support::Error;
