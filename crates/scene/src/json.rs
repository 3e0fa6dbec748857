//! Scenes as JSON.

mod error;
mod fields;
mod names;
mod object;
mod value;

use std::io::Read;

use crate::error::SceneError;
use crate::scene::Scene;
use crate::text::read_text;

/// Maximum size of a scene's JSON, bytes: about 500,000 blocks, far below a machine's memory.
pub const MAX_BYTES: u64 = 64_000_000;

impl Scene {
    /// Parses and validates a scene.
    ///
    /// # Errors
    /// When the text is not JSON, lacks a field or has an unknown one, or [`Scene::validate`]
    /// rejects the scene.
    ///
    /// ```
    /// use teeter_scene::Scene;
    ///
    /// let error = Scene::from_json("[]").unwrap_err().to_string();
    /// assert!(error.starts_with("the scene is a JSON list, expected a JSON object"));
    /// let error = Scene::from_json(r#"{"Name": "one"}"#).unwrap_err().to_string();
    /// assert!(error.starts_with("`Name` is not a field of a scene: did you mean `name`?"));
    /// ```
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        let scene = Self::parse(text)?;
        scene.validate()?;
        Ok(scene)
    }

    /// Parses a scene without [`Scene::validate`], for a caller that repairs it.
    ///
    /// # Errors
    /// When the text is not JSON, lacks a field or has an unknown one, or a field has another kind
    /// of value.
    ///
    /// ```
    /// use teeter_scene::{Scene, named};
    ///
    /// let mut scene = named("column").expect("the list has it");
    /// scene.blocks[1].pos = scene.blocks[0].pos;
    /// assert!(Scene::from_json(&scene.to_json()).is_err());
    /// assert_eq!(Scene::parse(&scene.to_json())?, scene);
    /// # Ok::<(), teeter_scene::SceneError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, SceneError> {
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
        let scene = serde_path_to_error::deserialize(&mut reader).map_err(|e| error::located(text, &e))?;
        reader.end().map_err(|e| error::not_json(text, &e))?;
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
