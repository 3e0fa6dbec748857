//! Pages, tables and charts about the simulator, and the measurements behind them.

pub mod dissertation;
mod error;
pub mod score;
pub mod validation;

pub use error::Error;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of `length` steps on standard error; nothing is drawn where that is no terminal.
pub fn progress(length: u64, unit: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!("{{wide_bar}} {{pos}} of {{len}} {unit}, {{eta}} left"))
        .expect("the template is one of indicatif's own forms");
    ProgressBar::new(length).with_style(style)
}
