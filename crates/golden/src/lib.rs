#![doc = include_str!("../README.md")]

mod error;
mod files;
mod matrix;
mod record;
mod results;
mod runs;

pub use error::GoldenError;
pub use matrix::{Cell, table};
pub use record::{contest, record};
pub use results::{Golden, Minted, mint, reason};
pub use runs::{Outcome, Run, play_all, runs};
