//! Measurements of worlds against exact mechanics.
//!
//! Each file measures one thing and says how. What is measured comes back as plain data with units; reports on it are the business of who asks.
//! Nothing here reads a clock or a file, and the same question gives the same bits in any number of threads.
//!
//! ```
//! use teeter_physics::Params;
//!
//! let scene = teeter_scene::config("(1L1)-(010)", &teeter_scene::TowerOptions::exact()).unwrap();
//! let blocks = teeter_study::forces(&scene, Params::default(), || ())?;
//! // the block in the middle is loose: its own weight times friction holds it
//! let expected = 0.4 * scene.blocks[1].mass * scene.gravity;
//! assert!((blocks[1].forward_n.unwrap() - expected).abs() < 2e-3);
//! # Ok::<(), teeter_physics::BuildError>(())
//! ```

mod each;
mod exact;
mod extraction;
mod forces;
mod linear;
mod places;
mod placing;
mod plan;
mod prediction;
mod removal;
mod rest;
mod settle;
mod solid;
mod start;
mod stiff;
mod tilt;
pub mod torsion;
mod turning;
mod twist;
mod xray;
mod yank;

pub use each::each;
pub use exact::{Answer, NoAnswer, Patch, Rigid};
pub use extraction::{Extraction, extract};
pub use forces::{BlockForces, forces, forces_from};
pub use places::{FELL_DROPPED, FELL_MOVED, Places, top};
pub use placing::{LONGEST, Placing, STILL, let_go};
pub use plan::long_axis;
pub use prediction::{Prediction, predict};
pub use removal::{Removal, legal, remove, without};
pub use rest::{Rest, rest};
pub use settle::{SETTLE, frames, run, settled};
pub use solid::{Solid, deepest, deepest_between};
pub use start::{SLID, STRONGEST, starting_force};
pub use turning::{Motion, Spread, motion};
pub use twist::twist;
pub use xray::{Load, xray};
pub use yank::{Yank, yank};
