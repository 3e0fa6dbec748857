//! Standard output, whose reader may leave, and bars of progress on standard error.

use std::io::{self, Write};

use indicatif::{ProgressBar, ProgressStyle};

use crate::fault::Fault;

/// Writes a line to standard output.
pub fn line(text: &str) -> Result<(), Fault> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}").and_then(|()| out.flush()).map_err(|e| match e.kind() {
        io::ErrorKind::BrokenPipe => Fault::ReaderGone,
        _ => Fault::Said(format!("standard output cannot be written: {e}")),
    })
}

/// A bar of `length` steps on standard error; nothing is drawn where that is no terminal.
pub fn progress(length: u64, unit: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!("{{wide_bar}} {{pos}} of {{len}} {unit}, {{eta}} left"))
        .expect("the template is one of indicatif's own forms");
    ProgressBar::new(length).with_style(style)
}

/// The bytes of a value as JSON on one line.
pub fn json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("plain data has JSON, and writing to memory does not fail")
}
