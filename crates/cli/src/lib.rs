#![doc = include_str!("../README.md")]

mod arguments;
mod commands;
mod error;
mod fallen;
mod game_event;
mod input;
mod interrupt;
mod message;
mod output;
mod trace;
mod warnings;
mod world;

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use commands::Command;
use error::Error;
use output::Output;

/// A real-time simulator of the tower game Jenga, where contact and friction are springs.
#[derive(Debug, Parser)]
#[command(name = "teeter", version, arg_required_else_help = true, disable_help_subcommand = true)]
struct Arguments {
    /// Print the licences of this program and of all parts in it.
    #[arg(long, alias = "licenses", exclusive = true)]
    licences: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

/// Notices that the licences ask for, written by `tools/dependencies`.
const LICENCES: &str = include_str!("../licences.txt");

impl Arguments {
    fn run(self) -> Result<(), Error> {
        match self.command {
            Some(command) => command.run(),
            None if self.licences => Output::Stdout.line(LICENCES.trim_end()),
            None => Err(Arguments::command().error(ErrorKind::MissingSubcommand, "a command is missing").into()),
        }
    }
}

/// Runs the program with the arguments of a shell, its own name first, and returns its exit code.
///
/// It writes to standard output and standard error, and commands other than `play` take over SIGINT
/// and SIGTERM: the process is meant to end with it.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let done = Arguments::try_parse_from(arguments).map_err(Error::from).and_then(Arguments::run);
    done.map_or_else(|error| error.report(), |()| 0)
}
