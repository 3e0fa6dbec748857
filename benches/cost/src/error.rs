//! Errors of measurements, one line each.

use teeter_golden::GoldenError;
use teeter_physics::{BuildError, SnapshotError};
use teeter_scene::SceneError;

/// Error of building, playing or measuring a workload.
///
/// ```
/// let error = teeter_cost::Workload::golden("castle", 0).unwrap_err();
/// assert_eq!(error.to_string(), "there is no golden run called castle");
/// ```
#[derive(Debug, thiserror::Error)]
pub enum CostError {
    /// Error of the golden runs.
    #[error(transparent)]
    Golden(#[from] GoldenError),
    /// Error of building a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// World that cannot be built.
    #[error("{workload}: {error}")]
    World {
        /// Name of the workload.
        workload: String,
        /// Error of the engine.
        error: BuildError,
    },
    /// State that a world does not accept.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// Golden run that does not exist.
    #[error("there is no golden run called {0}")]
    UnknownRun(String),
    /// Workload that does not exist.
    #[error("there is no such workload")]
    UnknownWorkload,
    /// Scene that the list does not have.
    #[error("there is no {0} in the list of scenes")]
    UnknownScene(&'static str),
    /// File that cannot be read, written or parsed.
    #[error("{file}: {message}")]
    File {
        /// Path of the file.
        file: String,
        /// Message of the operating system or the parser.
        message: String,
    },
    /// Page without the marks of its table.
    #[error("{0} has no marks for the table")]
    NoTable(String),
    /// Thread pool that cannot be created.
    #[error("{0}")]
    Threads(String),
    /// Failure of node.
    #[error("{0}")]
    Node(String),
    /// Failure of counting a workload.
    #[error("{workload}: {message}")]
    Count {
        /// Name of the workload.
        workload: String,
        /// Failure.
        message: String,
    },
    /// Valgrind that cannot be started.
    #[error("valgrind: {0}; tools/setup valgrind installs it")]
    Valgrind(std::io::Error),
    /// Workloads in register widths that this processor does not have.
    #[error("nothing was accepted: this processor cannot play {0}")]
    Unavailable(String),
    /// Same workload with different final states.
    #[error("{workload}: {first} ends in {hash} and {second} in {other}")]
    Disagreement {
        /// Name of the workload.
        workload: String,
        /// Name of the first mode.
        first: String,
        /// Hash of the first mode.
        hash: String,
        /// Name of the second mode.
        second: String,
        /// Hash of the second mode.
        other: String,
    },
    /// Invalid command line.
    #[error("{0}")]
    Usage(String),
}

impl CostError {
    /// Creates an error of a file.
    pub fn file(file: impl ToString, error: impl ToString) -> Self {
        Self::File { file: file.to_string(), message: error.to_string() }
    }
}
