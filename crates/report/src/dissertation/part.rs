//! Part of the report, and what its experiments get.

use indicatif::ProgressBar;
use maud::Markup;

use super::played::Played;
use crate::error::Error;

/// Measures times of a part and advances the bar after each.
pub type Clock = fn(&ProgressBar) -> Result<Vec<f64>, Error>;

/// Inputs of the experiments of a part.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// Bar to advance after each experiment.
    pub bar: &'a ProgressBar,
    /// Results of the clock of the part.
    pub times: &'a [f64],
    /// Twelve moves in each column; empty for a part that does not ask for them.
    pub played: &'a [Played],
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
    /// Experiments.
    pub run: fn(Inputs) -> Result<Markup, Error>,
}
