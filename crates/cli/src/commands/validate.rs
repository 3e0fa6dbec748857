//! `teeter validate`: the engine against exact mechanics and data of real towers, as a page.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use teeter_report::validation::{self, DataSheet, Figure, Options, RealRows, RealSet, Size, Topic};
use teeter_scene::{Form, MAX_BYTES};

use crate::arguments::number;
use crate::error::Error;
use crate::{input, output};

/// Arguments of `teeter validate`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Validate {
    /// Folder for `validation.html` and `validation.json`; created where it is missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Topics to measure, with commas in between [default: all].
    #[arg(long, value_delimiter = ',', value_name = "TOPICS", value_parser = topic())]
    only: Vec<Topic>,
    /// Small report of few low towers, which shows in a minute that everything runs.
    #[arg(long)]
    quick: bool,
    /// Form of the blocks [default: rigid]. A lattice takes six times as long.
    #[arg(long)]
    form: Option<Form>,
    /// Towers of each kind [default: 20].
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    towers: Option<u64>,
    /// Seed of the first tower.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Simulated rest of all towers together, h [default: 24].
    #[arg(long, value_parser = number(0.001, 1000.0))]
    hours: Option<f64>,
    /// Blocks torn out of a tower [default: 1000].
    #[arg(long = "yanks", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    collapses: Option<u32>,
    /// Data sheet of a real tower, or with `--rows` the table of its blocks, see
    /// docs/validation.md; without `--only`, no other topic is measured.
    #[arg(long, value_name = "FILE")]
    real: Option<PathBuf>,
    /// Table of rows of real towers with the blocks that were loose.
    #[arg(long, value_name = "FILE", requires = "real")]
    rows: Option<PathBuf>,
}

impl Validate {
    /// Measures the topics, writes the report and prints the figures.
    pub fn run(self) -> Result<(), Error> {
        let real = match (&self.real, &self.rows) {
            (Some(blocks), Some(rows)) => Some(RealSet::Rows(real_rows(blocks, rows)?)),
            (Some(sheet), None) => Some(RealSet::Sheet(data_sheet(sheet)?)),
            _ => None,
        };
        let size = Size::new(&Options {
            quick: self.quick,
            form: self.form,
            towers: self.towers,
            seed: self.seed,
            hours: self.hours,
            collapses: self.collapses,
        });
        for section in validation::run(&self.out, &size, &self.only, real.as_ref())? {
            output::line(section.title)?;
            section.figures.iter().try_for_each(print)?;
        }
        output::line(&self.out.join("validation.html").display().to_string())
    }
}

fn print(figure: &Figure) -> Result<(), Error> {
    let goal = figure.goal.as_deref().map_or(String::new(), |goal| format!(" (goal {goal})"));
    let result = match figure.met {
        Some(true) => "ok    ",
        Some(false) => "MISSED",
        None => "      ",
    };
    output::line(&format!("  {result} {}: {}{goal}", figure.what, figure.value))
}

fn data_sheet(path: &Path) -> Result<DataSheet, Error> {
    let (text, name) = input::text(path, MAX_BYTES)?;
    text.parse::<DataSheet>().map_err(|error| Error::input(&name, error))
}

fn real_rows(blocks: &Path, rows: &Path) -> Result<RealRows, Error> {
    let (blocks, name) = input::text(blocks, MAX_BYTES)?;
    let (rows, other) = input::text(rows, MAX_BYTES)?;
    RealRows::parse(&blocks, &rows).map_err(|error| Error::input(&format!("{name}, {other}"), error))
}

/// Parser of the names of topics.
fn topic() -> impl TypedValueParser<Value = Topic> {
    let values = Topic::ALL.map(|topic| PossibleValue::new(topic.name()).help(topic.summary()));
    let find = |name: String| Topic::ALL.into_iter().find(|topic| topic.name() == name);
    PossibleValuesParser::new(values).map(move |name| find(name).expect("the parser admits only names of topics"))
}
