//! Collapse angles of the labelled towers of `data/oracle/tilt.jsonl.gz`.

use serde_json::json;
use teeter_study::Prediction;

use super::labelled::{predictions, towers};
use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::score::OracleSet;
use crate::statistics::quantile;
use crate::validation::section::Section;
use crate::validation::size::Size;

/// Angle of a tower that stands at all angles tried, degrees: the largest of them.
const NEVER_FELL: f64 = 60.0;

/// Compares collapse angles with limit analysis.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let towers = towers(size, OracleSet::Tilt, if size.quick { 10 } else { 1 })?;
    let predictions = predictions(&towers)?;
    let mut section = Section::new(
        "tilt",
        "Tilt",
        "The angle of the floor at which a tower collapses, by bisection with constant gravity, \
         against limit analysis. Towers whose answer depends on contact between the sides of \
         neighbours are left out of the figures and drawn as a series of their own.",
    );
    let (mut plain, mut sides, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for (tower, prediction) in towers.iter().zip(&predictions) {
        let (Prediction::Tilt { tilt_deg, .. }, Some(truth)) = (prediction, tower.truth.tilt_deg) else { continue };
        let predicted = tilt_deg.unwrap_or(NEVER_FELL);
        if tower.truth.side_sensitive {
            sides.push((truth, predicted));
        } else {
            plain.push((truth, predicted));
            errors.push((predicted - truth).abs());
        }
    }
    let (median, p95) = (quantile(&errors, 0.5), quantile(&errors, 0.95));
    section.goal("tilt, median error", format!("{median:.3} degrees"), "0.1 degrees", median <= 0.1);
    section.goal("tilt, 95 % within", format!("{p95:.3} degrees"), "0.3 degrees", p95 <= 0.3);
    section.number("median_error_deg", median);
    section.number("p95_error_deg", p95);
    section.number("towers", plain.len() as f64);
    section.inform("towers", format!("{} and {} that depend on sides", plain.len(), sides.len()));
    section.data = json!({"plain": plain, "sides": sides});
    section.charts.push(Chart {
        title: "Collapse angle".into(),
        x: Axis::new("limit analysis, degrees"),
        y: Axis::new("engine, degrees"),
        series: vec![Series::points("towers", plain), Series::points("depends on sides", sides)],
        diagonal: true,
        ..Chart::default()
    });
    Ok(section)
}
