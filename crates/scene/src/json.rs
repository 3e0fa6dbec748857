//! Scenes as JSON.

use std::io::Read;

use crate::error::SceneError;
use crate::scene::Scene;

/// Maximum size of a scene's JSON, bytes: about 500,000 blocks, far below a machine's memory.
pub const MAX_BYTES: u64 = 64_000_000;

impl Scene {
    /// Parses and validates a scene. Unknown fields are ignored.
    ///
    /// # Errors
    /// When the text is not JSON, lacks a field, or [`Scene::validate`] rejects the scene.
    ///
    /// ```
    /// use teeter_scene::Scene;
    ///
    /// let error = Scene::from_json("[]").unwrap_err().to_string();
    /// assert!(error.starts_with("the scene is a JSON list, expected a JSON object"));
    /// ```
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
        let scene: Scene = serde_path_to_error::deserialize(&mut reader).map_err(|e| path_error(text, e))?;
        reader.end().map_err(|e| json_error(String::new(), &e))?;
        scene.validate()?;
        Ok(scene)
    }

    /// Formats the scene as one line of JSON; parsing it returns the same bits.
    ///
    /// Non-finite values, which [`Scene::validate`] rejects, are written as `null`.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("keys are text and writing to memory does not fail")
    }

    /// Reads and validates a scene of at most `limit` bytes.
    ///
    /// # Errors
    /// As [`Scene::from_json`] and [`read_text`].
    pub fn read(reader: impl Read, limit: u64) -> Result<Self, SceneError> {
        Self::from_json(&read_text(reader, limit)?)
    }
}

/// Reads UTF-8 text and stops after `limit` bytes.
///
/// # Errors
/// When the reader fails, offers more than `limit` bytes, or the bytes are not UTF-8.
pub fn read_text(reader: impl Read, limit: u64) -> Result<String, SceneError> {
    let mut bytes = Vec::new();
    reader.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(|e| SceneError::Read(e.to_string()))?;
    if bytes.len() as u64 > limit {
        return Err(SceneError::TooLarge { limit_mb: limit / 1_000_000 });
    }
    String::from_utf8(bytes).map_err(|e| SceneError::NotUtf8(e.utf8_error().valid_up_to()))
}

/// Names the block of an error by its id, which the author of the file knows, or by its index in
/// the list where it has none.
fn path_error(text: &str, error: serde_path_to_error::Error<serde_json::Error>) -> SceneError {
    let path = error.path().to_string();
    let location = match path.strip_prefix("blocks[").and_then(|rest| rest.split_once(']')) {
        Some((index, field)) => {
            let value = serde_json::from_str::<serde_json::Value>(text).ok();
            let id = value.as_ref().and_then(|v| v["blocks"][index.parse::<usize>().ok()?]["id"].as_u64());
            let block = id.map_or(format!("block at index {index} of the list: "), |id| format!("block {id}: "));
            match field.trim_start_matches('.') {
                "" => block,
                field => format!("{block}`{field}`: "),
            }
        }
        None if path == "." || path == "?" => String::new(),
        None => format!("`{path}`: "),
    };
    json_error(location, error.inner())
}

fn json_error(location: String, error: &serde_json::Error) -> SceneError {
    let message = error.to_string();
    // serde_json ends its messages with the line and column, which are fields of their own here.
    let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(m, _)| m).to_owned();
    let (line, column) = (error.line(), error.column());
    if error.is_data() || message.contains("out of range") {
        return SceneError::Json { location, message, line, column };
    }
    SceneError::Json { location: String::new(), message: format!("this is not JSON: {message}"), line, column }
}
