#![doc = include_str!("../README.md")]
#![allow(clippy::disallowed_methods, reason = "it measures time")]

mod baseline;
mod clock;
mod compare;
mod error;
mod hash;
mod node;
mod workload;

pub use baseline::{Baseline, COMPILER, Count};
pub use clock::{Clocked, Measurement, one_thread, quartiles};
pub use compare::{Comparison, compare};
pub use error::CostError;
pub use hash::hex;
pub use node::Node;
pub use workload::{Workload, counted, swept};
