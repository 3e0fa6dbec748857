//! `teeter dissertation`: the simulators and results of the 2003 dissertation.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
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
}

impl Dissertation {
    /// Writes the report and prints the path of its page.
    pub fn run(self) -> Result<(), Error> {
        let DissertationCommand::Report(report) = self.command;
        let path = write(&report.out, &report.only)?;
        output::line(&path.display().to_string())
    }
}
