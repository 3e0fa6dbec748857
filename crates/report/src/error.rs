//! Errors of the reports.

use std::fmt::Display;

/// Why a report was not written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// One line in the user's words.
    #[error("{0}")]
    Said(String),
}

impl Error {
    /// An error in `place`, a file or a line of it.
    pub fn at(place: &str, message: impl Display) -> Self {
        Error::Said(format!("{place}: {message}"))
    }
}

impl From<&str> for Error {
    fn from(message: &str) -> Self {
        Error::Said(message.to_owned())
    }
}
