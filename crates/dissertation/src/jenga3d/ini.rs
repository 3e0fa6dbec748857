//! Constants as an ini file (section 5.5.1): sections in brackets, `name = value`, comments after
//! `;` or `#`.

use super::constant::{Constant, ConstantError};
use super::constants::Constants;
use super::table::TABLE;

/// Error in an ini file. Lines count from 1.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, IniError};
///
/// let error = Constants::from_ini("[Spring]").unwrap_err();
/// assert_eq!(error, IniError::UnknownSection { line: 1, section: "Spring".into() });
/// assert_eq!(
///     error.to_string(),
///     "line 1: there is no section [Spring], expected Simulation, Integration, Springs, Contact, \
///      Friction, Disabling or Hand"
/// );
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IniError {
    /// Section that the file format does not have.
    #[error("line {line}: there is no section [{section}], expected {}", section_names())]
    UnknownSection {
        /// Line.
        line: usize,
        /// Name of the section.
        section: String,
    },
    /// Constant that the section does not have.
    #[error("line {line}: there is no `{name}` {}", section_of(section, name))]
    UnknownName {
        /// Line.
        line: usize,
        /// Name of the section; empty before the first.
        section: String,
        /// Name of the constant.
        name: String,
    },
    /// Value that is not accepted.
    #[error("line {line}: {source}")]
    InvalidValue {
        /// Line.
        line: usize,
        /// Constant and value.
        source: ConstantError,
    },
    /// Constant that the file sets twice.
    #[error("line {line}: `{name}` is set again, expected once: line {first} sets it")]
    Repeated {
        /// Line.
        line: usize,
        /// Line that set it before.
        first: usize,
        /// Name of the constant.
        name: &'static str,
    },
    /// Line that is neither a section nor a constant.
    #[error("line {line}: `{text}`, expected `name = value` or `[Section]`")]
    Syntax {
        /// Line.
        line: usize,
        /// Text of the line.
        text: String,
    },
}

/// Names of the sections, in order.
fn sections() -> Vec<&'static str> {
    let mut names: Vec<&str> = TABLE.iter().map(|constant| constant.section).collect();
    names.dedup();
    names
}

fn section_names() -> String {
    match sections().as_slice() {
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
        [] => String::new(),
    }
}

/// Section in which a name was not found, and the one that has it.
fn section_of(section: &str, name: &str) -> String {
    let here =
        if section.is_empty() { "before the first section".to_owned() } else { format!("in section [{section}]") };
    match Constant::find(name) {
        Some(constant) => format!("{here}: it is in [{}]", constant.section),
        None => here,
    }
}

impl Constants {
    /// Parses an ini file; constants that it does not set have their defaults.
    ///
    /// # Errors
    /// Those of [`Constants::apply_ini`].
    pub fn from_ini(text: &str) -> Result<Self, IniError> {
        let mut constants = Self::default();
        constants.apply_ini(text)?;
        Ok(constants)
    }

    /// Sets the constants that an ini file sets.
    ///
    /// # Errors
    /// Names the line of an unknown section or name, of a value out of its range, of a constant
    /// that is set twice, or of another syntax. The constants before that line are then set.
    pub fn apply_ini(&mut self, text: &str) -> Result<(), IniError> {
        let mut section: &str = "";
        let mut seen: Vec<(&'static str, usize)> = Vec::new();
        for (n, whole) in text.strip_prefix('\u{feff}').unwrap_or(text).lines().enumerate() {
            let (line, text) = (n + 1, whole.split([';', '#']).next().unwrap_or_default().trim());
            if text.is_empty() {
                continue;
            }
            if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                section = name.trim();
                if !sections().contains(&section) {
                    return Err(IniError::UnknownSection { line, section: section.to_owned() });
                }
                continue;
            }
            let Some((name, value)) = text.split_once('=') else {
                return Err(IniError::Syntax { line, text: text.to_owned() });
            };
            let (name, value) = (name.trim(), value.trim());
            let Some(constant) = TABLE.iter().find(|c| c.section == section && c.name == name) else {
                return Err(IniError::UnknownName { line, section: section.to_owned(), name: name.to_owned() });
            };
            if let Some(&(name, first)) = seen.iter().find(|(other, _)| *other == name) {
                return Err(IniError::Repeated { line, first, name });
            }
            seen.push((constant.name, line));
            self.set(name, value).map_err(|source| IniError::InvalidValue { line, source })?;
        }
        Ok(())
    }

    /// Formats all constants as an ini file, each with its meaning, its range, its default and the
    /// reason of the default.
    pub fn to_ini(&self) -> String {
        let mut text = String::new();
        let mut section = "";
        for constant in TABLE {
            if constant.section != section {
                let gap = if section.is_empty() { "" } else { "\n" };
                section = constant.section;
                text += &format!("{gap}[{section}]\n");
            }
            let (expected, default) = (constant.expected(), constant.default());
            comment(&mut text, &format!("{}: {expected}", constant.meaning));
            comment(&mut text, &format!("default {default}: {}", constant.reason));
            text += &format!("{} = {}\n", constant.name, constant.value(self));
        }
        text
    }
}

/// Maximum width of a comment, characters.
const WIDTH: usize = 100;

/// Appends a comment, broken into lines.
fn comment(text: &mut String, words: &str) {
    let mut line = String::from(";");
    for word in words.split(' ') {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            *text += &line;
            text.push('\n');
            line = String::from(";  ");
        }
        line.push(' ');
        line += word;
    }
    *text += &line;
    text.push('\n');
}
