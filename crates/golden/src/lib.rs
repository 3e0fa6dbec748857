//! Golden runs: scenes and inputs whose every bit is known, and what came of them.
//!
//! The runs are data, in `data/golden`: `runs.json` names scene, constants and number of steps of each, and a file of inputs with one
//! line a step (empty where there is none). Rust and the wasm face under node play the same files, so nothing about a run is said
//! twice. `hashes.json` holds the results that all of them must give; `docs/determinism.md` says what is promised.

mod matrix;
mod record;
mod results;
mod runs;

pub use matrix::{Cell, table};
pub use record::record;
pub use results::{Golden, Minted, mint, reason};
pub use runs::{Outcome, Run, play_all, runs};

/// What went wrong, in one line.
pub type Fault = String;

/// Reads a file of golden data.
fn read(dir: &std::path::Path, name: &str) -> Result<String, Fault> {
    let path = dir.join(name);
    std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a file of golden data.
fn write(dir: &std::path::Path, name: &str, text: &str) -> Result<(), Fault> {
    let path = dir.join(name);
    std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}
