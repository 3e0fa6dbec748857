//! Part of the report, and what its experiments get.

use indicatif::ProgressBar;
use maud::Markup;
use teeter_dissertation::jenga3d::Constants;

use super::played::Played;
use crate::error::Error;

/// Measures times of a part with the constants of 2003 and advances the bar after each.
pub type Clock = fn(&Constants, &ProgressBar) -> Result<Vec<f64>, Error>;

/// Inputs of the experiments of a part.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// Constants of the 2003 method.
    pub constants: &'a Constants,
    /// Bar to advance after each experiment.
    pub bar: &'a ProgressBar,
    /// Results of the clock of the part.
    pub times: &'a [f64],
    /// Twelve moves in each column; empty for a part that does not ask for them.
    pub played: &'a [Played],
}

/// Use of the constants of the 2003 method in a part.
#[derive(Debug, Clone, Copy)]
pub enum Usage {
    /// The part has constants of its own.
    Nothing,
    /// All reach each measurement of the method.
    All,
    /// The part compares values of these; all others reach each measurement.
    Varies(&'static [&'static str]),
}

/// Part of the report.
pub struct Part {
    /// Name for selection.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Number of experiments, timed ones included, without those of the moves.
    pub steps: u64,
    /// Measurement of times. It runs alone, before all experiments.
    pub clock: Option<Clock>,
    /// True for a part that needs the twelve moves.
    pub moves: bool,
    /// Use of the constants of the 2003 method.
    pub constants: Usage,
    /// Experiments.
    pub run: fn(Inputs) -> Result<Markup, Error>,
}
