//! Messages on standard error.

use std::io::{self, Write};

use teeter_scene::printable;

/// Writes a line to standard error. Where that cannot be written nobody reads messages, so it is no
/// error.
pub fn message(text: &str) {
    let _ = writeln!(io::stderr(), "{}", printable_lines(text));
}

/// Returns text whose lines cannot change a terminal, although names of files and scenes may
/// contain any character.
pub fn printable_lines(text: &str) -> String {
    text.split('\n').map(printable).collect::<Vec<_>>().join("\n")
}
