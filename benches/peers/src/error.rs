//! Errors of the bench, one line each.

use std::path::{Path, PathBuf};

use teeter_scene::SceneError;
use teeter_study::LimitError;

/// Error of the bench.
#[derive(Debug, thiserror::Error)]
pub enum PeersError {
    /// Invalid command line.
    #[error("{0}")]
    Usage(String),
    /// File that cannot be read, written or parsed.
    #[error("{}: {message}", file.display())]
    File {
        /// Path of the file.
        file: PathBuf,
        /// Message of the operating system or the parser.
        message: String,
    },
    /// Page without the marks of its table.
    #[error("{} has no marks for the table", .0.display())]
    NoTable(PathBuf),
    /// Name of no engine or setting.
    #[error("no engine or setting is called {0}")]
    UnknownEntry(String),
    /// Scene that the list does not have.
    #[error("there is no {0} in the list of scenes")]
    UnknownScene(&'static str),
    /// Error of building a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Error of the exact mechanics.
    #[error(transparent)]
    Exact(#[from] LimitError),
}

impl PeersError {
    /// Creates an error of a file.
    pub fn file(file: &Path, error: impl ToString) -> Self {
        Self::File { file: file.to_owned(), message: error.to_string() }
    }
}
