//! Exceptions: the classes of `teeter.errors`, made from the errors of the library.

use std::fmt::Display;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Class of `teeter.errors`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Scene,
    Param,
    Input,
    Body,
    Snapshot,
    Rules,
    Command,
    Record,
}

impl Kind {
    /// Class, and where it is stored once it was imported.
    fn class(self) -> (&'static str, &'static PyOnceLock<Py<PyType>>) {
        static CLASSES: [PyOnceLock<Py<PyType>>; 8] = [const { PyOnceLock::new() }; 8];
        let name = match self {
            Self::Scene => "SceneError",
            Self::Param => "ParamError",
            Self::Input => "InputError",
            Self::Body => "BodyError",
            Self::Snapshot => "SnapshotError",
            Self::Rules => "RulesError",
            Self::Command => "CommandError",
            Self::Record => "RecordError",
        };
        (name, &CLASSES[self as usize])
    }

    /// Returns the exception with a message of one line. Its `field` is the first name in
    /// backticks.
    pub fn error(self, message: impl Display) -> PyErr {
        let message = message.to_string();
        let is_part = |c: char| c.is_alphanumeric() || "_.[]-".contains(c);
        let field = message.split('`').nth(1).filter(|name| name.chars().all(is_part)).map(str::to_owned);
        let (name, stored) = self.class();
        Python::attach(|py| {
            let made = stored.import(py, "teeter.errors", name).and_then(|class| class.call1((message, field)));
            made.map_or_else(|error| error, PyErr::from_value)
        })
    }
}

/// Returns the exception of a value that is not expected.
pub fn unexpected(kind: Kind, field: &str, value: impl Display, expected: impl Display) -> PyErr {
    kind.error(format_args!("`{field}` is {value}, expected {expected}"))
}
