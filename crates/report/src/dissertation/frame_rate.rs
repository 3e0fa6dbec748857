//! Figure 6.23: frame rate against the rows of a tower.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use maud::{Markup, html};
use teeter_scene::{TowerOptions, tower};

use super::column::{COLUMNS, Column, headings};
use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::table::Table;

/// Heights that are measured, rows.
const ROWS: [u32; 10] = [1, 2, 3, 5, 6, 7, 9, 12, 15, 18];
/// Number of experiments.
pub const STEPS: u64 = (ROWS.len() * COLUMNS.len()) as u64;
/// Frames before those that are timed.
const SETTLING: u32 = 15;
/// Frames that are timed: before any block has been still for long enough to sleep.
const TIMED: u32 = 30;
/// Minimum frame rate of the dissertation, and that of real time, frames per second.
const GOALS: [(f64, &str); 2] = [(12.0, "12: minimum"), (60.0, "60: real time")];

/// Frame rate on one core, frames per second. A frame covers 1/60 s of simulated time.
fn frame_rate(column: &Column, rows: u32) -> Result<f64, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let mut tower = (column.build)(&scene)?;
    tower.rest(SETTLING);
    let clock = ThreadTime::now();
    tower.rest(TIMED);
    Ok(f64::from(TIMED) / clock.elapsed().as_secs_f64())
}

/// Maximum number of rows with a frame rate of at least `rate`, interpolated linearly between the
/// points (rows, rate).
fn max_rows(points: &[(f64, f64)], rate: f64) -> String {
    match points.iter().rposition(|point| point.1 >= rate) {
        None => "none".into(),
        Some(n) if n + 1 == points.len() => format!("{} and more", points[n].0),
        Some(n) => {
            let ((x0, y0), (x1, y1)) = (points[n], points[n + 1]);
            format!("{:.0}", (x0 + (x1 - x0) * (y0 - rate) / (y0 - y1)).floor())
        }
    }
}

fn table(series: &[Series]) -> Table {
    let row = |first: [String; 2], cells: &mut dyn Iterator<Item = String>| first.into_iter().chain(cells).collect();
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (n, height) in ROWS.iter().enumerate() {
        let printed = if *height == 7 { "12" } else { "" };
        let rates = &mut series.iter().map(|series| format!("{:.0}", series.points[n].1));
        rows.push(row([height.to_string(), printed.to_owned()], rates));
    }
    for ((rate, _), printed) in GOALS.into_iter().zip(["7", ""]) {
        let heights = &mut series.iter().map(|series| max_rows(&series.points, rate));
        rows.push(row([format!("maximum rows at {rate} frames a second"), printed.to_owned()], heights));
    }
    Table::new(headings(["rows", "dissertation (2003)"]), rows)
}

/// Measures the frame rates.
pub fn run(bar: &ProgressBar) -> Result<Markup, Error> {
    let mut all = Vec::new();
    for column in COLUMNS {
        let mut points = Vec::new();
        for rows in ROWS {
            points.push((f64::from(rows), frame_rate(column, rows)?));
            bar.inc(1);
        }
        all.push(Series::line(column.name, points));
    }
    let table = table(&all);
    let chart = Chart {
        title: "Frame rate of one core".into(),
        x: Axis::new("rows"),
        y: Axis::log("frames a second"),
        series: all,
        goals: GOALS.map(|(rate, name)| (rate, name.to_owned())).to_vec(),
        ..Chart::default()
    };
    Ok(html! {
        p {
            "The dissertation's graph has one figure in the text: seven rows at 12 frames a \
             second, its minimum for real time. Here a frame is a sixtieth of a second of \
             simulated time, so 60 frames a second are real time and fewer are slow motion. Timed \
             from a quarter to three quarters of a second after the start."
        }
        (chart) (table)
    })
}
