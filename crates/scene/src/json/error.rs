//! Errors of the JSON parser, in the words of JSON, with the block that they are about.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::error::SceneError;
use crate::printable::shown;

/// Messages of the parser that speak of its own, and the words for them.
const PHRASES: &[(&str, &str)] = &[
    ("EOF while parsing a list", "the text ends inside a list"),
    ("EOF while parsing an object", "the text ends inside an object"),
    ("EOF while parsing a string", "the text ends inside a text, whose closing quotation mark is missing"),
    ("EOF while parsing a value", "the text ends where a value is expected"),
    ("expected ident", "expected true, false or null"),
    ("key must be a string", "the name of a field must be in double quotation marks"),
    ("trailing characters", "there is more after the end of the scene, expected one JSON object"),
    ("trailing comma", "a comma is followed by no value, remove it"),
    (
        "control character (\\u0000-\\u001F) found while parsing a string",
        "a text contains a line break or another control character, write it as \\n or the like",
    ),
    ("invalid escape", "a text contains a backslash that begins no escape, write \\\\ for the character itself"),
    ("recursion limit exceeded", "more than 100 lists or objects are inside each other"),
];

/// Values of other languages that JSON lacks, by their first characters.
const NOT_JSON: &[(&str, &str)] = &[
    ("NaN", "JSON has no NaN"),
    ("nan", "JSON has no NaN"),
    ("Infinity", "JSON has no Infinity"),
    ("-Infinity", "JSON has no Infinity"),
    ("inf", "JSON has no infinity"),
    ("-inf", "JSON has no infinity"),
    ("True", "JSON writes true"),
    ("False", "JSON writes false"),
    ("None", "JSON writes null"),
    ("'", "JSON has double quotation marks, \""),
    ("//", "JSON has no comments: write a field `comment`"),
    ("/*", "JSON has no comments: write a field `comment`"),
    ("#", "JSON has no comments: write a field `comment`"),
    ("+", "JSON numbers have no plus sign"),
    (".", "JSON numbers have a digit before the point"),
    ("<", "this begins like XML or a web page"),
];

/// Describes an error at a path of the scene. It names the block by its id, which the author of the
/// file knows, or by its index in the list where it has none.
pub fn located(text: &str, error: &serde_path_to_error::Error<serde_json::Error>) -> SceneError {
    let inner = error.inner();
    if inner.is_syntax() && !inner.to_string().starts_with("number out of range") || inner.is_eof() {
        return not_json(text, inner);
    }
    let path = error.path().to_string();
    let (block, field) = match path.strip_prefix("blocks[").and_then(|rest| rest.split_once(']')) {
        Some((index, field)) => {
            let id = index.parse().ok().and_then(|index| block_id(text, index));
            let block = id.map_or(format!("block at index {index} of the list"), |id| format!("block {id}"));
            (block, field.trim_start_matches('.'))
        }
        None if path == "." || path == "?" => (String::new(), ""),
        None => (String::new(), path.as_str()),
    };
    let message = match message(inner) {
        m if m.starts_with("number out of range") => "is too large a number, expected at most 1.8e308".to_owned(),
        m => m,
    };
    // A message about a value begins with its verb, one about an object names the field.
    let is_about_value = message.starts_with("is ") || message.starts_with("has ");
    let location = match (block.as_str(), field) {
        ("", "") if is_about_value => "the scene ".to_owned(),
        ("", "") => String::new(),
        ("", field) if is_about_value => format!("`{}` ", shown(field)),
        ("", field) => format!("`{}`: ", shown(field)),
        (block, "") if is_about_value => format!("{block} "),
        (block, "") => format!("{block}: "),
        (block, field) if is_about_value => format!("{block}: `{}` ", shown(field)),
        (block, field) => format!("{block}: `{}`: ", shown(field)),
    };
    SceneError::Json { location, message, line: inner.line(), column: inner.column() }
}

/// Describes an error of a text that is not JSON, with a hint for values of other languages.
pub fn not_json(text: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let message = message(error);
    let phrase =
        PHRASES.iter().find(|(rust, _)| message.starts_with(rust)).map_or(message.as_str(), |(_, words)| words);
    let hint = hint(text, line, column).map_or(String::new(), |hint| format!("; {hint}"));
    SceneError::Json { location: String::new(), message: format!("this is not JSON: {phrase}{hint}"), line, column }
}

/// Message of the parser without line and column, which are fields of their own.
fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message).to_owned()
}

/// Hint about the word at a position of the text.
fn hint(text: &str, line: usize, column: usize) -> Option<&'static str> {
    let line = text.split('\n').nth(line.checked_sub(1)?)?;
    // The parser stops at or after the first character of the word that it does not know.
    let is_word = |c: &u8| c.is_ascii_alphanumeric() || matches!(c, b'-' | b'+' | b'.');
    let at = column.saturating_sub(1).min(line.len());
    let bytes = line.as_bytes();
    let before = bytes[..at].iter().rev().take(20).take_while(|c| is_word(c)).count();
    let rest = [at - before, at, at.saturating_sub(1)].map(|start| line.get(start..).unwrap_or_default());
    NOT_JSON.iter().find(|(start, _)| rest.iter().any(|rest| rest.starts_with(start))).map(|(_, hint)| *hint)
}

/// Id of the block at an index of the list. The text is parsed again up to there, without storing
/// any of it, and need not be valid after it.
fn block_id(text: &str, index: usize) -> Option<u64> {
    let found = Cell::new(None);
    let mut reader = serde_json::Deserializer::from_str(text);
    // The text has an error: the id, if any, is found before that.
    let _ = Step { found: &found, path: &[Find::Field("blocks"), Find::Index(index), Find::Field("id")] }
        .deserialize(&mut reader);
    found.get()
}

/// Step into a value.
#[derive(Clone, Copy)]
enum Find {
    Field(&'static str),
    Index(usize),
}

/// Walk along a path to a whole number.
#[derive(Clone, Copy)]
struct Step<'a> {
    found: &'a Cell<Option<u64>>,
    path: &'a [Find],
}

impl<'de> DeserializeSeed<'de> for Step<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Step<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value on the path to an id")
    }

    fn visit_u64<E>(self, x: u64) -> Result<(), E> {
        if self.path.is_empty() {
            self.found.set(Some(x));
        }
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((Find::Field(field), path)) = self.path.split_first() else {
            return while_some(|| map.next_entry::<IgnoredAny, IgnoredAny>());
        };
        while let Some(is_match) = map.next_key_seed(IsName(field))? {
            if is_match {
                map.next_value_seed(Step { path, ..self })?;
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Some((Find::Index(index), path)) = self.path.split_first() else {
            return while_some(|| list.next_element::<IgnoredAny>());
        };
        for _ in 0..*index {
            list.next_element::<IgnoredAny>()?;
        }
        list.next_element_seed(Step { path, ..self })?;
        while_some(|| list.next_element::<IgnoredAny>())
    }
}

fn while_some<T, E>(mut next: impl FnMut() -> Result<Option<T>, E>) -> Result<(), E> {
    while next()?.is_some() {}
    Ok(())
}

/// True for a key of this name.
struct IsName(&'static str);

impl<'de> DeserializeSeed<'de> for IsName {
    type Value = bool;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<bool, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for IsName {
    type Value = bool;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_str<E>(self, name: &str) -> Result<bool, E> {
        Ok(name == self.0)
    }
}
