//! What can be wrong with a scene, said in one line each.

/// Why there is no scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// Nothing was read.
    #[error("the scene is empty, expected JSON")]
    Empty,
    /// More was offered than is read.
    #[error("the scene is larger than {limit_mb} MB, the most that is read")]
    TooLarge {
        /// The most that is read, MB.
        limit_mb: u64,
    },
    /// The bytes are no text.
    #[error("the scene is not text: byte {0} is not UTF-8")]
    NotUtf8(usize),
    /// The reader failed.
    #[error("the scene cannot be read: {0}")]
    Read(String),
    /// The text is no JSON, or lacks something that a scene has.
    #[error("{place}{message} (line {line}, column {column})")]
    Json {
        /// Which part of the scene, with a colon and a space; empty where that is not known.
        place: String,
        /// What was found and what was expected.
        message: String,
        /// Line of the text, from 1.
        line: usize,
        /// Column of the line, from 1.
        column: usize,
    },
    /// The text is JSON but no object.
    #[error("the scene is {0}, expected a JSON object with `name`, `friction` and `blocks`")]
    NotObject(&'static str),
    /// A value of the whole scene is out of its range.
    #[error("`{field}` is {value}, expected {expected}")]
    Field {
        /// Which one.
        field: &'static str,
        /// What it was.
        value: String,
        /// What it should be.
        expected: String,
    },
    /// A value of a block is out of its range.
    #[error("block {id}: `{field}` is {value}, expected {expected}")]
    Block {
        /// The block's id.
        id: u32,
        /// Which value.
        field: &'static str,
        /// What it was.
        value: String,
        /// What it should be.
        expected: String,
    },
    /// Two blocks have the same id.
    #[error(
        "block {id}: `id` is used twice, by the blocks at places {first} and {second} of the list, expected one block an id"
    )]
    DuplicateId {
        /// The id.
        id: u32,
        /// Place of the first in the list, from 0.
        first: usize,
        /// Place of the second in the list, from 0.
        second: usize,
    },
    /// Two blocks are inside each other.
    #[error("blocks {a} and {b}: `pos` makes them overlap by {depth_mm:.3} mm, expected at most 0.001 mm")]
    Overlap {
        /// Id of the first.
        a: u32,
        /// Id of the second.
        b: u32,
        /// Least distance that would part them, mm.
        depth_mm: f64,
    },
    /// A configuration such as `(010)-(011)` cannot be read.
    #[error("row {row} of the configuration is `{text}`, expected {expected}")]
    Notation {
        /// Which row, the bottom one being 1.
        row: usize,
        /// What it was.
        text: String,
        /// What it should be.
        expected: &'static str,
    },
    /// There is no such preset of a block.
    #[error("there is no block `{0}`, expected `dissertation` or `official`")]
    UnknownPreset(String),
}
