//! `teeter validate`: the engine against exact mechanics and data of real towers, as a page.

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use teeter_report::validation::{self, DataSheet, Figure, Options, RealRows, RealSet, Size, Topic};
use teeter_scene::{Form, MAX_BYTES};

use crate::arguments::number;
use crate::error::Error;
use crate::{input, output};

/// Maximum number of towers of each kind.
const MAX_TOWERS: u64 = 1000;

/// Arguments of `teeter validate`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Validate {
    /// Folder for `validation.html` and `validation.json`; created where it is missing.
    #[arg(long, value_name = "DIR", required_unless_present = "json")]
    out: Option<PathBuf>,
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
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=MAX_TOWERS))]
    towers: Option<u64>,
    /// Seed of the first tower.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Seeds of the towers, as in 101..121, without the last; instead of `--seed` and `--towers`.
    #[arg(long, value_name = "A..B", value_parser = seeds, conflicts_with_all = ["seed", "towers"])]
    seeds: Option<Range<u64>>,
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
    /// Print one JSON object: of each topic `met` and its `figures` as numbers.
    #[arg(long)]
    json: bool,
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
            towers: self.seeds.as_ref().map_or(self.towers, |seeds| Some(seeds.end - seeds.start)),
            seed: self.seeds.as_ref().map_or(self.seed, |seeds| seeds.start),
            hours: self.hours,
            collapses: self.collapses,
        });
        let sections = validation::run(self.out.as_deref(), &size, &self.only, real.as_ref())?;
        if self.json {
            return output::line(&validation::summary(&sections).to_string());
        }
        for section in sections {
            output::line(section.title)?;
            section.figures.iter().try_for_each(print)?;
        }
        self.out.map_or(Ok(()), |out| output::line(&out.join("validation.html").display().to_string()))
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

/// Parses a range of seeds, `A..B` without `B`.
fn seeds(text: &str) -> Result<Range<u64>, String> {
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let range = text.split_once("..").and_then(|(start, end)| Some(number(start)?..number(end)?));
    let range = range.ok_or("expected two whole numbers, as in 101..121")?;
    match range.end.saturating_sub(range.start) {
        0 => Err(format!("no seed from {} up to but not including {}", range.start, range.end)),
        1..=MAX_TOWERS => Ok(range),
        count => Err(format!("{count} seeds, expected at most {MAX_TOWERS}")),
    }
}

/// Parser of the names of topics.
fn topic() -> impl TypedValueParser<Value = Topic> {
    let values = Topic::ALL.map(|topic| PossibleValue::new(topic.name()).help(topic.summary()));
    let find = |name: String| Topic::ALL.into_iter().find(|topic| topic.name() == name);
    PossibleValuesParser::new(values).map(move |name| find(name).expect("the parser admits only names of topics"))
}
