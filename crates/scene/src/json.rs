//! Scenes as JSON.

use std::io::Read;

use crate::{Scene, SceneError};

/// Most bytes of a scene that are read: room for some 500,000 blocks, and far from filling a machine's memory.
pub const MAX_BYTES: u64 = 64_000_000;

impl Scene {
    /// The scene in `text`, checked. Fields that a scene does not have are passed over.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        let start = text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
        match start.chars().next() {
            None => return Err(SceneError::Empty),
            Some('[') => return Err(SceneError::NotObject("a JSON list")),
            Some('"') => return Err(SceneError::NotObject("a JSON text")),
            Some('0'..='9' | '-') => return Err(SceneError::NotObject("a JSON number")),
            Some(_) => {}
        }
        let text = text.trim_start_matches('\u{feff}');
        let mut reader = serde_json::Deserializer::from_str(text);
        let scene: Scene = serde_path_to_error::deserialize(&mut reader).map_err(|e| located(text, e))?;
        reader.end().map_err(|e| plain(String::new(), &e))?;
        scene.validate()?;
        Ok(scene)
    }

    /// The scene as one line of JSON. Reading it back gives the same bits.
    ///
    /// A scene with values that are not finite, which `validate` refuses, has no JSON; they are written as `null`.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self)
            .expect("a scene has no maps with keys other than text, and writing to memory does not fail")
    }

    /// The scene in the bytes of `reader`, checked. Reading stops as soon as there are more than `limit` bytes.
    pub fn read(reader: impl Read, limit: u64) -> Result<Self, SceneError> {
        Self::from_json(&read_text(reader, limit)?)
    }
}

/// The text in `reader`. Reading stops as soon as there are more than `limit` bytes.
pub fn read_text(reader: impl Read, limit: u64) -> Result<String, SceneError> {
    let mut bytes = Vec::new();
    reader.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(|e| SceneError::Read(e.to_string()))?;
    if bytes.len() as u64 > limit {
        return Err(SceneError::TooLarge { limit_mb: limit / 1_000_000 });
    }
    String::from_utf8(bytes).map_err(|e| SceneError::NotUtf8(e.utf8_error().valid_up_to()))
}

/// Says which block a fault is in by its id, which is what the file's author knows it by; by its place in the list where it has none.
fn located(text: &str, error: serde_path_to_error::Error<serde_json::Error>) -> SceneError {
    let path = error.path().to_string();
    let place = match path.strip_prefix("blocks[").and_then(|rest| rest.split_once(']')) {
        Some((index, field)) => {
            let known = serde_json::from_str::<serde_json::Value>(text).ok();
            let id = known.as_ref().and_then(|v| v["blocks"][index.parse::<usize>().ok()?]["id"].as_u64());
            let block = id.map_or(format!("block at place {index} of the list: "), |id| format!("block {id}: "));
            match field.trim_start_matches('.') {
                "" => block,
                field => format!("{block}`{field}`: "),
            }
        }
        None if path == "." || path == "?" => String::new(),
        None => format!("`{path}`: "),
    };
    plain(place, error.inner())
}

fn plain(place: String, error: &serde_json::Error) -> SceneError {
    let message = error.to_string();
    // serde_json ends its messages with the place, which is told apart here.
    let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(m, _)| m).to_owned();
    let (line, column) = (error.line(), error.column());
    if error.is_data() || message.contains("out of range") {
        return SceneError::Json { place, message, line, column };
    }
    SceneError::Json { place: String::new(), message: format!("this is not JSON: {message}"), line, column }
}
