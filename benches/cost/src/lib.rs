//! What the engine costs.
//!
//! [`Workload`] is what is measured: a scene, the constants of a run, what acts, and which frames count. Three programs measure the
//! same workloads. `counts` has them played under valgrind and holds the instructions against a committed baseline: the gate, for a
//! count does not know what else the machine does. `figures` times them natively and in WebAssembly in turn and makes the table of
//! `docs/performance.md`. The bench `frame` is for criterion, which knows best whether a change made a frame faster.
//!
//! Whatever is measured is printed with the hash of the state that it ended in: another hash is another computation.
#![allow(clippy::disallowed_methods, reason = "it measures time")]

mod baseline;
mod node;
mod stretch;
mod workload;

pub use baseline::{Baseline, COMPILER, Comparison, Count, compare};
pub use node::Node;
pub use stretch::{Clocked, Stretch, one_thread, quartiles};
pub use workload::{Workload, counted, swept};

/// What went wrong, in one line.
pub type Fault = String;

/// A hash as it is printed and compared: 16 hexadecimal digits.
pub fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}
