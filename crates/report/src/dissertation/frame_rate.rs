//! Figure 6.23: frame rate against the rows of a tower.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use maud::{Markup, html};
use teeter_dissertation::jenga3d::Constants;
use teeter_scene::{TowerOptions, tower};

use super::column::{COLUMNS, Column, headings};
use super::part::Inputs;
use super::tower::Tower;
use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::statistics::quantile;
use crate::table::Table;

/// Heights that are measured, rows.
const ROWS: [u32; 10] = [1, 2, 3, 5, 6, 7, 9, 12, 15, 18];
/// Number of experiments.
pub const STEPS: u64 = (ROWS.len() * COLUMNS.len() + RESTING_ROWS.len()) as u64;
/// Frames before those that are timed.
const SETTLING: u32 = 15;
/// Frames that are timed.
const TIMED: u32 = 30;
/// Minimum frame rate of the dissertation, and that of real time, frames per second.
const GOALS: [(f64, &str); 2] = [(12.0, "12: minimum"), (60.0, "60: real time")];

/// Rows of the towers that come to rest.
const RESTING_ROWS: [u32; 3] = [6, 9, 18];
/// Maximum number of frames until all of a tower is disabled.
const MAX_REST: u32 = 300;
/// Column of the method with disabling by rigid motion.
const WITH_FUTURE_WORK: usize = 1;

/// Frame rate of a tower that never rests on one core, frames per second. A frame covers 1/60 s of
/// simulated time.
pub fn frame_rate(column: &Column, constants: &Constants, rows: u32) -> Result<f64, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let mut tower = (column.awake)(&scene, constants)?;
    tower.rest(SETTLING);
    Ok(rate(&mut tower))
}

/// Inverse of the median time of a frame: a frame that the machine interrupts does not count.
fn rate(tower: &mut Tower) -> f64 {
    let times: Vec<f64> = (0..TIMED)
        .map(|_| {
            let clock = ThreadTime::now();
            tower.step(None);
            clock.elapsed().as_secs_f64()
        })
        .collect();
    1.0 / quantile(&times, 0.5)
}

/// Number of disabled blocks of a tower at rest, and its frame rate, frames per second.
fn at_rest(constants: &Constants, rows: u32) -> Result<[f64; 2], Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let mut tower = (COLUMNS[WITH_FUTURE_WORK].build)(&scene, constants)?;
    let disabled = |tower: &Tower| (0..tower.len()).filter(|block| tower.is_resting(*block)).count();
    let mut frames = 0;
    while frames < MAX_REST && disabled(&tower) < tower.len() {
        tower.step(None);
        frames += 1;
    }
    let rate = rate(&mut tower);
    Ok([disabled(&tower) as f64, rate])
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

/// Measures the frame rates of all columns at all heights, then those at rest with the number of
/// disabled blocks before each.
pub fn clock(constants: &Constants, bar: &ProgressBar) -> Result<Vec<f64>, Error> {
    let mut measured = Vec::new();
    for column in COLUMNS {
        for rows in ROWS {
            measured.push(frame_rate(column, constants, rows)?);
            bar.inc(1);
        }
    }
    for rows in RESTING_ROWS {
        measured.extend(at_rest(constants, rows)?);
        bar.inc(1);
    }
    Ok(measured)
}

/// Shows the frame rates.
pub fn run(Inputs { times, .. }: Inputs) -> Result<Markup, Error> {
    let (settling, resting) = times.split_at(ROWS.len() * COLUMNS.len());
    let points = |rates: &[f64]| ROWS.iter().zip(rates).map(|(rows, rate)| (f64::from(*rows), *rate)).collect();
    let all: Vec<Series> = COLUMNS
        .iter()
        .zip(settling.chunks(ROWS.len()))
        .map(|(column, rates)| Series::line(column.name, points(rates)))
        .collect();
    let at_rest = |(rows, measured): (&u32, &[f64])| {
        vec![rows.to_string(), format!("{:.0} of {}", measured[0], 3 * rows), format!("{:.0}", measured[1])]
    };
    let resting = RESTING_ROWS.iter().zip(resting.chunks(2)).map(at_rest).collect();
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
             simulated time, so 60 frames a second are real time and fewer are slow motion, on one \
             core of this machine. Nothing sleeps, and nothing stays disabled. Medians of the \
             frames from a quarter to three quarters of a second after the start."
        }
        (chart) (table)
        p {
            "The engine is slower with one row than with two. Blocks that touch the floor alone \
             stand so exactly that their velocities along it begin below 1e-25 m/s. Products of \
             such numbers are subnormal, which processors compute slowly, and which the engine \
             keeps, because WebAssembly does and the bits are to be the same. Rounding triples the \
             velocities in a tenth of a second."
        }
        p {
            "Section 6.3 expects that with a better rule \"the whole tower would be disabled most \
             of the time, speeding up the simulation vastly\". At rest, by the rule of 2003 with \
             6.3:"
        }
        (Table::new(["rows", "disabled", "frames a second"], resting))
    })
}
