//! Standard output and warnings.

use std::io::{self, Write};

use crate::error::Error;

/// Writes a line to standard output.
pub fn line(text: &str) -> Result<(), Error> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}").and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Error::StdoutClosed,
        _ => Error::Stdout(error),
    })
}

/// Writes a value to standard output as one line of JSON.
pub fn json(value: &impl serde::Serialize) -> Result<(), Error> {
    line(&to_json(value))
}

/// Returns a value as one line of JSON.
pub fn to_json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("the values are plain data, and memory can be written")
}

/// Writes a warning to standard error.
pub fn warn(message: &str) {
    eprintln!("teeter: {message}");
}
