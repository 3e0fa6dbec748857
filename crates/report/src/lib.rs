#![doc = include_str!("../README.md")]

pub mod chart;
pub mod dissertation;
mod error;
mod out_file;
mod output;
pub mod page;
pub mod score;
pub mod statistics;
pub mod table;
pub mod validation;

pub use error::Error;
pub use out_file::OutFile;
pub use output::{progress, waiting};
