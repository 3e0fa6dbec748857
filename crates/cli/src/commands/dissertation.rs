//! `teeter dissertation`: the simulators and results of the 2003 dissertation.

mod constants;
mod measurements;
mod run;
mod summary;

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use teeter_dissertation::jenga3d::Constants;
use teeter_report::dissertation::{part_names, write};

use crate::error::Error;
use crate::output;

/// Arguments of `teeter dissertation`.
#[derive(Debug, Args)]
#[command(arg_required_else_help = true, disable_help_subcommand = true)]
pub struct Dissertation {
    #[command(subcommand)]
    command: DissertationCommand,
}

#[derive(Debug, Subcommand)]
enum DissertationCommand {
    /// Simulate a scene by the method of 2003 and report whether it stands.
    Run(Box<run::Run>),
    /// Run its chapter of results again and write it as a page.
    Report(Report),
}

#[derive(Debug, Args)]
struct Report {
    /// Folder for the page, index.html; created where it is missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Part to run [default: all]; can be repeated.
    #[arg(long, value_name = "PART", value_parser = PossibleValuesParser::new(part_names()))]
    only: Vec<String>,
    /// File of constants of 2003, as `teeter dissertation run --write-ini` writes it; `-` for
    /// standard input.
    #[arg(long, value_name = "FILE")]
    ini: Option<PathBuf>,
}

impl Dissertation {
    /// Runs the command.
    pub fn run(self) -> Result<(), Error> {
        match self.command {
            DissertationCommand::Run(run) => run.run(),
            DissertationCommand::Report(report) => report.run(),
        }
    }
}

impl Report {
    /// Writes the report and prints the path of its page.
    fn run(self) -> Result<(), Error> {
        let mut constants = Constants::default();
        if let Some(path) = &self.ini {
            constants::apply_ini(&mut constants, path)?;
        }
        let path = write(&self.out, &self.only, &constants)?;
        output::line(&path.display().to_string())
    }
}
