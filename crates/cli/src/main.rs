//! `teeter`: towers, experiments and the game, from a shell.

mod args;
mod dissertation;
mod fault;
mod forces;
mod input;
mod output;
mod play;
mod run;
mod scenes;
mod score;
mod validate;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use fault::Fault;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return fault::usage(&error),
    };
    let done = match arguments.command {
        Command::Scene(args) => scenes::main(args),
        Command::Run(args) => run::main(args),
        Command::Score(args) => score::main(args),
        Command::Forces(args) => forces::main(args),
        Command::Validate(args) => validate::main(args),
        Command::Play(args) => play::main(args),
        Command::Dissertation(args) => dissertation::main(args),
    };
    match done {
        // Whoever reads the output has seen enough: `teeter scene tower | head` is no fault.
        Ok(()) | Err(Fault::ReaderGone) => ExitCode::SUCCESS,
        Err(Fault::Said(message)) => fault::say(&message),
        Err(Fault::Usage(error)) => fault::usage(&error),
    }
}
