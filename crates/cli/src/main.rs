#![doc = include_str!("../README.md")]

mod arguments;
mod commands;
mod error;
mod fallen;
mod input;
mod json_fields;
mod output;
mod trace;
mod warnings;

use std::process::ExitCode;

use clap::Parser;

use commands::Command;
use error::Error;

/// A real-time simulator of the tower game Jenga, where contact and friction are springs.
#[derive(Debug, Parser)]
#[command(name = "teeter", version, arg_required_else_help = true, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    let done = Arguments::try_parse().map_err(Error::from).and_then(|arguments| arguments.command.run());
    done.map_or_else(|error| error.report(), |()| ExitCode::SUCCESS)
}
