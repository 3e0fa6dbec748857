//! Standard output and output files.

use std::io::{self, Write};
use std::path::Path;

use teeter_report::OutFile;
use teeter_scene::printable_json;

use crate::error::Error;
use crate::message::printable_lines;

/// Output of `--out`: a file that appears whole or not at all, or standard output.
pub enum Output {
    /// Standard output.
    Stdout,
    /// File, and its name for messages.
    File(OutFile, String),
}

impl Output {
    /// Creates an output file; `-` is standard output.
    pub fn create(path: &Path) -> Result<Self, Error> {
        if path == Path::new("-") {
            return Ok(Self::Stdout);
        }
        let name = path.display().to_string();
        match OutFile::create(path) {
            Ok(file) => Ok(Self::File(file, name)),
            Err(source) => Err(Error::Create { name, source }),
        }
    }

    /// Returns true if this is standard output.
    pub fn is_stdout(&self) -> bool {
        matches!(self, Self::Stdout)
    }

    /// Writes a line as it is.
    pub fn line(&mut self, text: &str) -> Result<(), Error> {
        match self {
            Self::Stdout => raw_line(text),
            Self::File(file, name) => {
                writeln!(file, "{text}").map_err(|source| Error::Write { name: name.clone(), source })
            }
        }
    }

    /// Writes bytes.
    pub fn bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        match self {
            Self::Stdout => written(io::stdout().lock().write_all(bytes).and_then(|()| io::stdout().flush())),
            Self::File(file, name) => {
                file.write_all(bytes).map_err(|source| Error::Write { name: name.clone(), source })
            }
        }
    }

    /// Gives a file its name.
    pub fn finish(self) -> Result<(), Error> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(file, name) => file.finish().map_err(|source| Error::Write { name, source }),
        }
    }
}

/// Writes text to standard output, with the end of its last line. Names of files and scenes may
/// contain what changes a terminal, so lines are made printable.
pub fn line(text: &str) -> Result<(), Error> {
    raw_line(&printable_lines(text))
}

fn raw_line(text: &str) -> Result<(), Error> {
    let mut out = io::stdout().lock();
    written(writeln!(out, "{text}").and_then(|()| out.flush()))
}

fn written(result: io::Result<()>) -> Result<(), Error> {
    result.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Error::StdoutClosed,
        _ => Error::Stdout(error),
    })
}

/// Writes the report of a command to standard output, or to standard error where standard output
/// has the data.
pub fn report(text: &str, stdout_has_data: bool) -> Result<(), Error> {
    if stdout_has_data {
        return writeln!(io::stderr(), "{}", printable_lines(text)).map_err(Error::Stderr);
    }
    line(text)
}

/// Writes a value to standard output as one line of JSON.
pub fn json(value: &impl serde::Serialize) -> Result<(), Error> {
    raw_line(&to_json(value))
}

/// Returns a value as one line of printable JSON.
pub fn to_json(value: &impl serde::Serialize) -> String {
    let json = serde_json::to_string(value).expect("the values are plain data, and memory can be written");
    printable_json(&json)
}
