//! What there is to simulate: blocks, scenes, towers and their notation. No physics.
//!
//! ```
//! use teeter_scene::{TowerOptions, config, named, tower};
//!
//! let full = tower(&TowerOptions { seed: 7, ..TowerOptions::default() })?;
//! assert_eq!(full.blocks.len(), 54);
//! let three = config("(010)-(011)", &TowerOptions::exact())?;
//! assert_eq!(three.blocks.len(), 3);
//! assert!(named("test-5").is_some());
//! # Ok::<(), teeter_scene::SceneError>(())
//! ```

mod error;
mod form;
mod json;
mod named;
mod notation;
pub mod overlap;
mod preset;
mod random;
mod scene;
mod tower;
mod validate;

pub use error::SceneError;
pub use form::{Form, Particles, Springs, WOOD_SPRINGS};
pub use json::{MAX_BYTES, read_text};
pub use named::{NAMED, NamedScene, Verdict, named};
pub use notation::{Cell, Notation};
pub use preset::BlockPreset;
pub use random::Random;
pub use scene::{Block, Scene, standard_gravity, usual_stiffness};
pub use tower::{FIELD_PITCH, LOOSE_BY, MAX_ROWS, TowerOptions, WOOD_RESTITUTION, config, field, loose, tower};
pub use validate::{MAX_BLOCKS, SPRING_DAMPING, SPRING_STIFFNESS, STIFFNESS};
