//! Values as JSON text.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

/// Reads JSON; empty text is the default.
pub fn read<T: DeserializeOwned + Default>(subject: &'static str, text: &str) -> Result<T, Error> {
    if text.trim().is_empty() { Ok(T::default()) } else { read_all(subject, text) }
}

/// Reads JSON that has no default.
pub fn read_all<T: DeserializeOwned>(subject: &'static str, text: &str) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|e| Error::json(subject, e))
}

/// Writes JSON.
pub fn write(subject: &'static str, value: &impl Serialize) -> Result<String, Error> {
    serde_json::to_string(value).map_err(|e| Error::json(subject, e))
}
