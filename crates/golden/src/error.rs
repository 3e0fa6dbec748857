//! Errors of golden runs, one line each.

use teeter_game::RecordError;
use teeter_physics::BuildError;

/// Error of reading, playing or minting golden runs.
///
/// ```
/// let error = teeter_golden::reason("the bits", "faster").unwrap_err();
/// assert!(error.to_string().starts_with("the bits may change for a reason only"));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum GoldenError {
    /// File that cannot be read, written or parsed.
    #[error("{file}: {message}")]
    File {
        /// Path or name of the file.
        file: String,
        /// Message of the operating system or the parser.
        message: String,
    },
    /// Scene of a run that the list of scenes does not have.
    #[error("run {run}: there is no scene called `{scene}`")]
    UnknownScene {
        /// Name of the run.
        run: String,
        /// Name of the scene.
        scene: String,
    },
    /// Line of a run's inputs that does not parse.
    #[error("run {run}: line {line} of its inputs: {message}")]
    Input {
        /// Name of the run.
        run: String,
        /// Line, from 1.
        line: usize,
        /// Message of the parser.
        message: String,
    },
    /// Run whose world cannot be built.
    #[error("run {run}: {error}")]
    World {
        /// Name of the run.
        run: String,
        /// Error of the engine.
        error: BuildError,
    },
    /// World of the recording that cannot be built.
    #[error(transparent)]
    Record(#[from] BuildError),
    /// Game of opponents that cannot begin.
    #[error(transparent)]
    Game(#[from] RecordError),
    /// Tower without a loose block to pull.
    #[error("the tower has no loose block to pull")]
    NoLooseBlock,
    /// Reason that is too short.
    #[error("{subject} may change for a reason only: say in {words} words or more what changed them")]
    Reason {
        /// Name of the data to be changed.
        subject: String,
        /// Minimum number of words.
        words: usize,
    },
    /// Run with different results in two register widths, which is an error of the engine.
    #[error("nothing was minted: two widths disagree on run {run}, {first} and {second}")]
    Disagreement {
        /// Name of the run.
        run: String,
        /// Hash of the first width.
        first: String,
        /// Hash of the second width.
        second: String,
    },
    /// Thread pool that cannot be created.
    #[error("{0}")]
    Threads(String),
}

impl GoldenError {
    /// Creates an error of a file.
    pub(crate) fn file(file: impl ToString, error: impl ToString) -> Self {
        Self::File { file: file.to_string(), message: error.to_string() }
    }
}
