//! Faults of a record file.

/// Reason why bytes are no record, or one that cannot be replayed.
///
/// ```
/// use teeter_game::{Record, RecordError};
///
/// assert_eq!(Record::decode(b"{}"), Err(RecordError::Foreign));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// The bytes do not begin like a record.
    #[error("this is no record of a game: it does not begin like one")]
    Foreign,
    /// The layout is that of another version.
    #[error("a record of version {found}, and this program reads versions up to {expected}")]
    Version {
        /// Version of the bytes.
        found: u8,
        /// Version that is read.
        expected: u8,
    },
    /// The bytes end early.
    #[error("the record is truncated: {found} of {expected} bytes")]
    Truncated {
        /// Number of bytes.
        found: u64,
        /// Number of bytes that the record says it has.
        expected: u64,
    },
    /// There are more bytes than the record says it has.
    #[error("the record is altered: {found} bytes, and it says {expected}")]
    TooLong {
        /// Number of bytes.
        found: u64,
        /// Number of bytes that the record says it has.
        expected: u64,
    },
    /// The checksum differs.
    #[error("the record is altered: its checksum is not that of its content")]
    Altered,
    /// A part has a content that no record can have.
    #[error("the record is damaged: {0}")]
    Damaged(&'static str),
    /// The scene of the record is not the one of that name in this program.
    #[error("the record is of another scene `{0}` than this program has")]
    OtherScene(String),
    /// No game can be begun from the scene, the parameters and the rules.
    #[error("no game begins like this: {0}")]
    Start(String),
    /// The replay is not the same, so its record cannot go on.
    #[error("the replay is not the same as its record from frame {0} on, and cannot be played on")]
    Diverged(u32),
    /// The record has as many frames as there may be.
    #[error("a record has at most {0} frames")]
    Full(u32),
}
