//! Constant of the simulator as data: name, unit, range and reason, its value in a set of
//! constants, and its text in an ini file.

use std::fmt;

use serde::Serialize;

use super::constants::Constants;

/// Constant as data.
///
/// ```
/// use teeter_dissertation::jenga3d::Constant;
///
/// let stiffness = Constant::find("stiffness").expect("the table has it");
/// assert_eq!((stiffness.section, stiffness.unit), ("Springs", "N/m"));
/// assert_eq!(stiffness.default().to_string(), "10000");
/// assert_eq!(stiffness.expected(), "a number from 1 to 1e9 N/m");
/// ```
#[derive(Debug, Serialize)]
pub struct Constant {
    /// Section of an ini file.
    pub section: &'static str,
    /// Name in an ini file.
    pub name: &'static str,
    /// Unit; empty for a number without one.
    pub unit: &'static str,
    /// Values that are accepted.
    pub range: Range,
    /// Meaning.
    pub meaning: &'static str,
    /// Reason of the default.
    pub reason: &'static str,
    /// Value in a set of constants. As data it is that of the default.
    #[serde(rename = "default", serialize_with = "serialize_default")]
    pub(super) get: fn(&Constants) -> Value,
    #[serde(skip)]
    pub(super) set: fn(&mut Constants, Value),
}

/// Values that a constant accepts.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constant, Range};
///
/// let restitution = Constant::find("restitution").expect("the table has it");
/// assert_eq!(restitution.range, Range::Number { min: 0.0, max: 1.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Range {
    /// Number.
    Number {
        /// Minimum.
        min: f64,
        /// Maximum.
        max: f64,
    },
    /// Number, or `none`.
    NumberOrNone {
        /// Minimum.
        min: f64,
        /// Maximum.
        max: f64,
    },
    /// Whole number.
    Whole {
        /// Minimum.
        min: u32,
        /// Maximum.
        max: u32,
    },
    /// `true` or `false`.
    Switch,
    /// One of a list of names.
    Choice {
        /// Names.
        names: &'static [&'static str],
        /// Other names that are read, each with the name that it stands for.
        #[serde(skip)]
        aliases: &'static [(&'static str, &'static str)],
    },
}

/// Value of a constant.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Value};
///
/// let constants = Constants::default();
/// assert_eq!(constants.value("static_friction"), Some(Value::None));
/// assert_eq!(constants.value("order"), Some(Value::Choice("naive")));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Number.
    Number(f64),
    /// Whole number.
    Whole(u32),
    /// Switch.
    Switch(bool),
    /// Name of a choice.
    Choice(&'static str),
    /// No number.
    None,
}

/// Error of a constant.
///
/// ```
/// use teeter_dissertation::jenga3d::Constants;
///
/// let error = Constants::default().set("restitution", "2").unwrap_err();
/// assert_eq!(error.to_string(), "`restitution` is 2, expected a number from 0 to 1");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConstantError {
    /// Name of no constant.
    #[error("there is no constant `{name}`")]
    Unknown {
        /// Name.
        name: String,
    },
    /// Value that is not accepted.
    #[error("`{name}` is {value}, expected {expected}")]
    Value {
        /// Name of the constant.
        name: &'static str,
        /// Value found.
        value: String,
        /// Values accepted.
        expected: String,
    },
}

impl Constant {
    /// Default.
    pub fn default(&self) -> Value {
        (self.get)(&Constants::default())
    }

    /// Value in a set of constants.
    pub fn value(&self, constants: &Constants) -> Value {
        (self.get)(constants)
    }

    /// Values accepted, in words.
    pub fn expected(&self) -> String {
        let numbers = |min: &dyn fmt::Display, max: &dyn fmt::Display| {
            let unit = if self.unit.is_empty() { "" } else { " " };
            format!("from {min} to {max}{unit}{}", self.unit)
        };
        match self.range {
            Range::Number { min, max } => format!("a number {}", numbers(&Value::Number(min), &Value::Number(max))),
            Range::NumberOrNone { min, max } => {
                format!("none or a number {}", numbers(&Value::Number(min), &Value::Number(max)))
            }
            Range::Whole { min, max } => format!("a whole number {}", numbers(&min, &max)),
            Range::Switch => "true or false".to_owned(),
            Range::Choice { names, .. } => match names {
                [first @ .., last] => format!("{} or {last}", first.join(", ")),
                [] => String::new(),
            },
        }
    }

    /// Returns the value that a text names, if it is accepted. Numbers are decimal, with or without
    /// an exponent.
    pub fn parse(&self, text: &str) -> Result<Value, ConstantError> {
        let value = match self.range {
            Range::NumberOrNone { .. } if text == "none" => Some(Value::None),
            Range::Number { .. } | Range::NumberOrNone { .. } => text.parse().ok().map(Value::Number),
            Range::Whole { .. } => text.parse().ok().map(Value::Whole),
            Range::Switch => match text {
                "true" | "on" | "yes" | "1" => Some(Value::Switch(true)),
                "false" | "off" | "no" | "0" => Some(Value::Switch(false)),
                _ => None,
            },
            Range::Choice { names, aliases } => {
                let text = aliases.iter().find(|(alias, _)| *alias == text).map_or(text, |(_, name)| name);
                names.iter().find(|name| **name == text).map(|name| Value::Choice(name))
            }
        };
        value.filter(|value| self.accepts(*value)).ok_or_else(|| {
            let is_number = text.parse::<f64>().is_ok();
            self.error(if is_number { text.to_owned() } else { format!("`{text}`") })
        })
    }

    /// Returns true if a value is of the right kind and within the range.
    pub fn accepts(&self, value: Value) -> bool {
        match (self.range, value) {
            (Range::Number { min, max } | Range::NumberOrNone { min, max }, Value::Number(x)) => {
                (min..=max).contains(&x)
            }
            (Range::NumberOrNone { .. }, Value::None) => true,
            (Range::Whole { min, max }, Value::Whole(n)) => (min..=max).contains(&n),
            (Range::Switch, Value::Switch(_)) => true,
            (Range::Choice { names, .. }, Value::Choice(name)) => names.contains(&name),
            _ => false,
        }
    }

    pub(super) fn error(&self, value: String) -> ConstantError {
        ConstantError::Value { name: self.name, value, expected: self.expected() }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Exponents where a decimal would be long; either text reads back as the same number.
            Value::Number(x) if *x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => write!(f, "{x:e}"),
            Value::Number(x) => write!(f, "{x}"),
            Value::Whole(n) => write!(f, "{n}"),
            Value::Switch(on) => write!(f, "{on}"),
            Value::Choice(name) => f.write_str(name),
            Value::None => f.write_str("none"),
        }
    }
}

fn serialize_default<S: serde::Serializer>(get: &fn(&Constants) -> Value, serializer: S) -> Result<S::Ok, S::Error> {
    get(&Constants::default()).serialize(serializer)
}
