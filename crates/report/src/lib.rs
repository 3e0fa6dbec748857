#![doc = include_str!("../README.md")]

pub mod chart;
pub mod dissertation;
mod error;
mod output;
pub mod page;
pub mod score;
pub mod statistics;
pub mod table;
pub mod validation;

pub use error::Error;
pub use output::progress;
