//! Errors of scenes, one line each.

/// Error of reading, checking or building a scene.
///
/// ```
/// use teeter_scene::{SceneError, TowerOptions, config};
///
/// let error = config("(010)-(000)", &TowerOptions::exact()).unwrap_err();
/// assert!(matches!(error, SceneError::Notation { row: 2, .. }));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// Input without a single character.
    #[error("the scene is empty, expected JSON")]
    Empty,
    /// Input above the limit of size.
    #[error("the scene is larger than {limit_mb} MB, the most that is read")]
    TooLarge {
        /// Maximum size, MB.
        limit_mb: u64,
    },
    /// Input that is not UTF-8, with the index of the first byte that is not.
    #[error("the scene is not text: byte {0} is not UTF-8")]
    NotUtf8(usize),
    /// Failure of the reader.
    #[error("the scene cannot be read: {0}")]
    Read(String),
    /// Text that is not JSON, lacks a field, or has an unknown one.
    #[error("{location}{message} (line {line}, column {column})")]
    Json {
        /// Part of the scene, up to the message; empty where it is unknown.
        location: String,
        /// Value found and value expected.
        message: String,
        /// Line of the text, from 1.
        line: usize,
        /// Column of the line, from 1.
        column: usize,
    },
    /// JSON other than an object.
    #[error("the scene is {0}, expected a JSON object with `name`, `friction` and `blocks`")]
    NotObject(&'static str),
    /// Field of the scene out of its range.
    #[error("`{field}` is {value}, expected {expected}")]
    Field {
        /// Name of the field.
        field: &'static str,
        /// Value found.
        value: String,
        /// Range expected.
        expected: String,
    },
    /// Field of a block out of its range.
    #[error("block {id}: `{field}` is {value}, expected {expected}")]
    Block {
        /// Id of the block.
        id: u32,
        /// Name of the field.
        field: &'static str,
        /// Value found.
        value: String,
        /// Range expected.
        expected: String,
    },
    /// Angle that is in degrees.
    #[error("{location}`{field}` is {value}, which can only be degrees: write radians, {radians:.4}")]
    Degrees {
        /// Block, followed by a colon and a space; empty for a field of the scene.
        location: String,
        /// Name of the field.
        field: &'static str,
        /// Value found.
        value: f64,
        /// The value taken as degrees, rad.
        radians: f64,
    },
    /// Angle out of its range.
    #[error("{location}`{field}` is {value}, expected an angle of at most 12.566 rad in either direction")]
    Angle {
        /// Block, followed by a colon and a space; empty for a field of the scene.
        location: String,
        /// Name of the field.
        field: &'static str,
        /// Value found.
        value: f64,
    },
    /// Id of two blocks.
    #[error(
        "block {id}: `id` is used twice, by the blocks at indices {first} and {second} of the list, expected one block an id"
    )]
    DuplicateId {
        /// Shared id.
        id: u32,
        /// Index of the first block in the list.
        first: usize,
        /// Index of the second block in the list.
        second: usize,
    },
    /// Two blocks inside each other.
    #[error("blocks {a} and {b}: `pos` makes them overlap by {depth_mm:.3} mm, expected at most 0.02 mm")]
    Overlap {
        /// Id of the first block.
        a: u32,
        /// Id of the second block.
        b: u32,
        /// Minimum distance that separates them, mm.
        depth_mm: f64,
    },
    /// Configuration that does not follow the notation, such as `(010)-(0)`.
    #[error("row {row} of the configuration is `{text}`, expected {expected}")]
    Notation {
        /// Row, the bottom one being 1.
        row: usize,
        /// Text of the row.
        text: String,
        /// Form expected.
        expected: &'static str,
    },
    /// Name of no block preset.
    #[error("there is no block `{0}`, expected `dissertation` or `official`")]
    UnknownPreset(String),
    /// Name of no block form.
    #[error("expected rigid or lattice")]
    UnknownForm,
    /// Name of no arrangement of particles.
    #[error("expected inside or corners")]
    UnknownParticles,
}
