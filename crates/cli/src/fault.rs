//! What went wrong, said in one line.

use std::fmt::Display;
use std::process::ExitCode;

/// Why a command ended early.
#[derive(Debug)]
pub enum Fault {
    /// Something is wrong with what the user gave; one line in the user's words.
    Said(String),
    /// Standard output was closed by its reader.
    ReaderGone,
    /// The command line is none, or asks for help.
    Usage(clap::Error),
}

impl Fault {
    /// A fault in `place`, a file or a line of it.
    pub fn at(place: &str, message: impl Display) -> Self {
        Fault::Said(format!("{place}: {message}"))
    }
}

impl From<clap::Error> for Fault {
    fn from(error: clap::Error) -> Self {
        Fault::Usage(error)
    }
}

impl From<teeter_report::Error> for Fault {
    fn from(error: teeter_report::Error) -> Self {
        Fault::Said(error.to_string())
    }
}

impl From<String> for Fault {
    fn from(message: String) -> Self {
        Fault::Said(message)
    }
}

impl From<&str> for Fault {
    fn from(message: &str) -> Self {
        Fault::Said(message.to_owned())
    }
}

/// Writes the one line to standard error; the exit code of bad input.
pub fn say(message: &str) -> ExitCode {
    // A file's name or a scene's may hold anything, a new line included.
    let line: String = message.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    eprintln!("teeter: {line}");
    ExitCode::from(2)
}

/// Says what is wrong with the command line, or prints the help that was asked for.
pub fn usage(error: &clap::Error) -> ExitCode {
    use clap::error::ErrorKind;
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let _ = error.print();
            ExitCode::SUCCESS
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            ExitCode::from(2)
        }
        _ => {
            // clap's first paragraph says what is wrong, the others how the command is used.
            let text = error.to_string();
            let first = text.split("\n\n").next().unwrap_or_default();
            let words: Vec<&str> = first.trim_start_matches("error: ").split_whitespace().collect();
            say(&format!("{}; `teeter --help` and `teeter COMMAND --help` tell more", words.join(" ")))
        }
    }
}

/// Says something that the user should know and that ends nothing.
pub fn warn(message: &str) {
    eprintln!("teeter: {message}");
}
