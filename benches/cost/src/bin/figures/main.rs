//! `figures`: cost of a tower natively and in WebAssembly, on one core and on two. `tools/figures`
//! builds the page's modules and calls it.
#![allow(clippy::disallowed_methods, reason = "it measures time")]

mod field;
mod figure;
mod measure;
mod report;

use std::path::PathBuf;
use std::process::ExitCode;

use teeter_cost::CostError;

const USAGE: &str = "figures [--rounds N] [--docs FILE]

  --rounds N    how often everything is measured, 3 to 1000 (15)
  --docs FILE   write the table into that page, between its marks";

/// Arguments of the command line.
struct Args {
    rounds: usize,
    docs: Option<PathBuf>,
}

fn main() -> ExitCode {
    match Args::read(std::env::args().skip(1)).and_then(|args| run(&args)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("figures: {error}");
            ExitCode::from(2)
        }
    }
}

impl Args {
    fn read(mut words: impl Iterator<Item = String>) -> Result<Self, CostError> {
        let usage = CostError::Usage;
        let mut args = Self { rounds: 15, docs: None };
        while let Some(word) = words.next() {
            if word == "--help" {
                return Err(CostError::Usage(format!("usage: {USAGE}")));
            }
            let value =
                words.next().ok_or_else(|| usage(format!("{word} needs a value, or is not known; try --help")))?;
            match word.as_str() {
                "--rounds" => {
                    args.rounds = value
                        .parse()
                        .ok()
                        .filter(|n| (3..=1000).contains(n))
                        .ok_or_else(|| usage("--rounds takes 3 to 1000".into()))?
                }
                "--docs" => args.docs = Some(value.into()),
                _ => return Err(usage(format!("{word} is not known; try --help"))),
            }
        }
        Ok(args)
    }
}

fn run(args: &Args) -> Result<(), CostError> {
    let mut timed = measure::all()?;
    measure::rounds(&mut timed, args.rounds)?;
    measure::same_bits(&timed)?;
    let text = report::markdown(&figure::figures(&timed), args.rounds);
    println!("{text}");
    if let Some(page) = &args.docs {
        let name = page.display().to_string();
        let old = std::fs::read_to_string(page).map_err(|e| CostError::file(&name, e))?;
        let new = report::with_table(&old, &text).ok_or_else(|| CostError::NoTable(name.clone()))?;
        std::fs::write(page, new).map_err(|e| CostError::file(&name, e))?;
    }
    Ok(())
}
