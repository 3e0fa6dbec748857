//! Towers with known answers: a JSON scene a line, in UTF-8 or UTF-16, compressed by gzip or not.

use std::io::{self, BufRead, BufReader, Read};

use serde::Deserialize;
use teeter_scene::{MAX_BYTES, Scene, SceneError, utf8};

/// Maximum size of all lines together, unpacked, bytes: a small compressed file can hold any number
/// of them.
pub const MAX_UNPACKED: u64 = 1_000_000_000;
/// Maximum number of scenes.
pub const MAX_SCENES: usize = 100_000;
/// Maximum number of blocks of all scenes together: about 400 MB of memory.
pub const MAX_ALL_BLOCKS: usize = 2_000_000;

/// Scene with its exact answer.
#[derive(Debug)]
pub struct Labelled {
    /// Scene.
    pub scene: Scene,
    /// Exact answer about its tilt.
    pub truth: Truth,
}

/// Exact answer about a tilted tower.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub struct Truth {
    /// Minimum angle at which rigid blocks can no longer rest, degrees.
    pub tilt_deg: Option<f64>,
    /// True when the answer depends on contact between the sides of neighbours.
    pub side_sensitive: bool,
}

#[derive(Default, Deserialize)]
struct Extra {
    #[serde(default)]
    truth: Option<Truth>,
}

/// Error of reading labelled towers. `name` is that of the file or stream.
#[derive(Debug, thiserror::Error)]
pub enum LabelledError {
    /// Failure of the reader.
    #[error("{name}: {source}")]
    Read {
        /// Name of the input.
        name: String,
        /// Cause.
        source: io::Error,
    },
    /// Line that is not a labelled scene.
    #[error("{name}, line {line}: {source}")]
    Line {
        /// Name of the input.
        name: String,
        /// Line, from 1.
        line: usize,
        /// Cause.
        source: LineError,
    },
    /// Input above the limit of size.
    #[error("{name}: more than {} MB unpacked, the most that is read", MAX_UNPACKED / 1_000_000)]
    TooLarge {
        /// Name of the input.
        name: String,
    },
    /// Input with too many scenes or blocks.
    #[error(
        "{name}, line {line}: more than {MAX_SCENES} scenes or {MAX_ALL_BLOCKS} blocks in all, the most that is read: divide the file"
    )]
    TooMany {
        /// Name of the input.
        name: String,
        /// Line of the first scene too many, from 1.
        line: usize,
    },
    /// Input without a scene.
    #[error("{name}: no scenes, expected one JSON object a line")]
    Empty {
        /// Name of the input.
        name: String,
    },
}

/// Error of a line.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    /// Failure of the reader.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// Invalid scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Invalid answer.
    #[error("`truth` is not an object with `tilt_deg`, a number, and `side_sensitive`, true or false")]
    Truth(#[from] serde_json::Error),
}

/// Reads all scenes of an input; `name` names it in errors.
///
/// # Errors
/// When the input cannot be read or is too large, and when one of its lines is not a scene.
pub fn read(reader: impl Read + 'static, name: &str) -> Result<Vec<Labelled>, LabelledError> {
    let name = || name.to_owned();
    let text = utf8(reader).map_err(|source| LabelledError::Read { name: name(), source })?;
    let mut lines = BufReader::new(text.take(MAX_UNPACKED + 1));
    let (mut scenes, mut total, mut blocks) = (Vec::new(), 0, 0);
    for line in 1.. {
        let at = |source| LabelledError::Line { name: name(), line, source };
        let Some(bytes) = next_line(&mut lines).map_err(at)? else { break };
        total += bytes.len() as u64;
        if total > MAX_UNPACKED {
            return Err(LabelledError::TooLarge { name: name() });
        }
        let text = std::str::from_utf8(&bytes).map_err(|e| at(SceneError::NotUtf8(e.valid_up_to()).into()))?;
        if !text.trim().is_empty() {
            let labelled = parse(text).map_err(|error| at(in_line(error, line)))?;
            blocks += labelled.scene.blocks.len();
            if scenes.len() == MAX_SCENES || blocks > MAX_ALL_BLOCKS {
                return Err(LabelledError::TooMany { name: name(), line });
            }
            scenes.push(labelled);
        }
    }
    if scenes.is_empty() { Err(LabelledError::Empty { name: name() }) } else { Ok(scenes) }
}

/// Returns the error of a scene, which is a line for itself, with the line of the input.
fn in_line(error: LineError, line: usize) -> LineError {
    match error {
        LineError::Scene(SceneError::Json { location, message, column, .. }) => {
            SceneError::Json { location, message, line, column }.into()
        }
        error => error,
    }
}

/// Bytes of the next line with its end; none at the end of the input.
fn next_line(lines: &mut impl BufRead) -> Result<Option<Vec<u8>>, LineError> {
    let mut bytes = Vec::new();
    let length = lines.take(MAX_BYTES + 1).read_until(b'\n', &mut bytes)? as u64;
    if length > MAX_BYTES {
        return Err(SceneError::TooLarge { limit_mb: MAX_BYTES / 1_000_000 }.into());
    }
    Ok((length > 0).then_some(bytes))
}

/// Parses a line.
///
/// # Errors
/// When the line is not a scene, or its answer is not one.
pub fn parse(text: &str) -> Result<Labelled, LineError> {
    let scene = Scene::from_json(text)?;
    let extra: Extra = serde_json::from_str(text)?;
    Ok(Labelled { scene, truth: extra.truth.unwrap_or_default() })
}
