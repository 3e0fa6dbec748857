//! The program `teeter`, for the script of the package.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the program with its arguments, its own name first, and returns the exit code. It takes
/// over SIGINT and SIGTERM, so the process is meant to end with it.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| teeter_cli::run(arguments))
}
