//! Fields of a JSON object, read one by one, with errors in the words of JSON.

use glam::{DQuat, DVec3};
use serde_json::{Map, Value};
use teeter_scene::printable_start;

/// Similarity from which a name counts as misspelt: 0 for none, 1 for the same name.
const NEAR: f64 = 0.6;
/// Maximum deviation of a quaternion's length from 1.
const UNIT_TOLERANCE: f64 = 1e-3;
/// Maximum number of characters of a name or a text that is quoted.
const MAX_QUOTED: usize = 40;

/// Kind of object: its noun with an article, its fields, and names of other formats with the field
/// that they stand for.
pub struct Kind {
    /// Noun, such as `a hand`.
    pub noun: &'static str,
    /// Names of the fields.
    pub fields: &'static [&'static str],
    /// Other names, and the field meant.
    pub aliases: &'static [(&'static str, &'static str)],
}

/// Error of a field.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// Text that is not JSON.
    #[error("this is not JSON: {0}")]
    Syntax(String),
    /// Name of no field.
    #[error("`{path}` is not a field of {noun}{}", hint(nearest, fields))]
    Unknown {
        /// Path of the field.
        path: String,
        /// Kind of object.
        noun: &'static str,
        /// Nearest field.
        nearest: Option<&'static str>,
        /// All fields.
        fields: &'static [&'static str],
    },
    /// Field that must be there.
    #[error("{noun} lacks `{path}`, expected {expected}")]
    Missing {
        /// Path of the field.
        path: String,
        /// Kind of object.
        noun: &'static str,
        /// Value expected.
        expected: String,
    },
    /// Value of another kind, or out of range.
    #[error("{}is {found}, expected {expected}", quoted_path(path))]
    Value {
        /// Path of the field; empty for the whole line.
        path: String,
        /// Value found.
        found: String,
        /// Value expected.
        expected: String,
    },
}

fn hint(nearest: &Option<&str>, fields: &[&str]) -> String {
    match nearest {
        Some(name) => format!(": did you mean `{name}`?"),
        None => format!(", which are {}", fields.join(", ")),
    }
}

fn quoted_path(path: &str) -> String {
    if path.is_empty() { "this ".to_owned() } else { format!("`{path}` ") }
}

/// Object whose fields are all known.
pub struct Fields<'a> {
    map: &'a Map<String, Value>,
    path: String,
    noun: &'static str,
}

impl<'a> Fields<'a> {
    /// Returns the fields of an object at a path, empty for the whole line. Refuses other values
    /// and unknown fields.
    pub fn new(value: &'a Value, path: &str, kind: &Kind) -> Result<Self, FieldError> {
        let Value::Object(map) = value else {
            let expected = format!("an object with the fields of {}: {}", kind.noun, kind.fields.join(", "));
            return Err(FieldError::Value { path: path.to_owned(), found: found(value), expected });
        };
        let fields = Self { map, path: path.to_owned(), noun: kind.noun };
        match map.keys().find(|name| !kind.fields.contains(&name.as_str())) {
            None => Ok(fields),
            Some(name) => Err(FieldError::Unknown {
                path: fields.path_of(&printable_start(name, MAX_QUOTED)),
                noun: kind.noun,
                nearest: nearest(name, kind),
                fields: kind.fields,
            }),
        }
    }

    /// Path of a field.
    pub fn path_of(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    /// Value of a field; none where it is absent.
    pub fn get(&self, name: &str) -> Option<&'a Value> {
        self.map.get(name)
    }

    /// Value of a field that must be there.
    pub fn required(&self, name: &str, expected: &str) -> Result<&'a Value, FieldError> {
        let missing =
            || FieldError::Missing { path: self.path_of(name), noun: self.noun, expected: expected.to_owned() };
        self.get(name).ok_or_else(missing)
    }

    /// Error of the value of a field.
    pub fn error(&self, name: &str, expected: impl Into<String>) -> FieldError {
        let found = self.get(name).map_or("absent".to_owned(), found);
        FieldError::Value { path: self.path_of(name), found, expected: expected.into() }
    }

    /// Number from 0 to `max`, in `unit`.
    pub fn number(&self, name: &str, max: f64, unit: &str) -> Result<Option<f64>, FieldError> {
        let Some(value) = self.get(name) else { return Ok(None) };
        match value.as_f64() {
            Some(x) if (0.0..=max).contains(&x) => Ok(Some(x)),
            _ => Err(self.error(name, format!("a number from 0 to {max} {unit}"))),
        }
    }

    /// Vector of three numbers, in `unit`.
    pub fn vector(&self, name: &str, unit: &str) -> Result<Option<DVec3>, FieldError> {
        let Some(value) = self.get(name) else { return Ok(None) };
        let vector = numbers(value).map(DVec3::from_array);
        vector.map(Some).ok_or_else(|| self.error(name, format!("a list of three numbers, {unit}")))
    }

    /// Orientation of unit length.
    pub fn orientation(&self, name: &str) -> Result<Option<DQuat>, FieldError> {
        let Some(value) = self.get(name) else { return Ok(None) };
        let orientation = numbers(value).map(DQuat::from_array);
        match orientation.filter(|q| (q.length() - 1.0).abs() <= UNIT_TOLERANCE) {
            Some(q) => Ok(Some(q.normalize())),
            None => Err(self.error(name, "a quaternion x, y, z, w of unit length")),
        }
    }

    /// Objects of a list, each with its path.
    pub fn list(&self, name: &str) -> Result<Option<Vec<(String, &'a Value)>>, FieldError> {
        let Some(value) = self.get(name) else { return Ok(None) };
        let Value::Array(list) = value else { return Err(self.error(name, "a list")) };
        Ok(Some(list.iter().enumerate().map(|(i, value)| (format!("{}[{i}]", self.path_of(name)), value)).collect()))
    }
}

/// Parses one JSON value.
pub fn parse(text: &str) -> Result<Value, FieldError> {
    serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        // The line is that of the file, which the caller knows.
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(start, _)| start);
        FieldError::Syntax(format!("{message} (column {})", error.column()))
    })
}

/// Field that a name is near to.
fn nearest(name: &str, kind: &Kind) -> Option<&'static str> {
    let lower = name.to_lowercase();
    if let Some((_, field)) = kind.aliases.iter().find(|(alias, _)| *alias == lower) {
        return Some(field);
    }
    let similarity = |field: &str| strsim::normalized_damerau_levenshtein(&lower, field);
    let best = kind.fields.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)))?;
    (similarity(best) >= NEAR).then_some(best)
}

/// Numbers of a list of that length.
fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let list: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    list.try_into().ok()
}

/// Value of a message.
fn found(value: &Value) -> String {
    match value {
        Value::Null => "null".to_owned(),
        Value::Bool(flag) => flag.to_string(),
        Value::Number(number) => number.to_string(),
        Value::String(text) if text.chars().count() <= MAX_QUOTED => format!("{text:?}"),
        Value::String(_) => "a long text".to_owned(),
        Value::Array(list) if list.len() <= 4 && list.iter().all(Value::is_number) => value.to_string(),
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(_) => "an object".to_owned(),
    }
}
