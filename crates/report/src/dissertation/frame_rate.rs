//! Figure 6.23: frame rate against the rows of a tower.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use teeter_scene::{TowerOptions, tower};

use super::column::{COLUMNS, Column};
use super::page::{Line, chart, table};
use crate::error::Error;

/// Heights that are measured.
const ROWS: [u32; 10] = [1, 2, 3, 5, 6, 7, 9, 12, 15, 18];

/// Experiments.
pub const STEPS: u64 = (ROWS.len() * COLUMNS.len()) as u64;

/// Frames that settle before those that are timed, and frames that are timed: before anything has been still for long enough to sleep.
const FRAMES: (u32, u32) = (15, 30);

/// Frames a second of one core, each a sixtieth of a second of simulated time.
pub fn rate(column: &Column, rows: u32) -> Result<f64, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| Error::Said(e.to_string()))?;
    let mut tower = (column.build)(&scene)?;
    tower.rest(FRAMES.0);
    let clock = ThreadTime::now();
    tower.rest(FRAMES.1);
    Ok(f64::from(FRAMES.1) / clock.elapsed().as_secs_f64())
}

/// The highest number of rows whose rate is at least `least`, from measured rows, by the straight line between neighbours.
fn highest(points: &[(f64, f64)], least: f64) -> String {
    match points.iter().rposition(|p| p.1 >= least) {
        None => "none".into(),
        Some(n) if n + 1 == points.len() => format!("{} and more", points[n].0),
        Some(n) => {
            let ((x0, y0), (x1, y1)) = (points[n], points[n + 1]);
            format!("{:.0}", (x0 + (x1 - x0) * (y0 - least) / (y0 - y1)).floor())
        }
    }
}

/// Runs it.
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let mut lines = Vec::new();
    for column in COLUMNS {
        let mut points = Vec::new();
        for rows in ROWS {
            points.push((f64::from(rows), rate(column, rows)?));
            bar.inc(1);
        }
        lines.push(Line { name: column.name, colour: column.colour, points });
    }
    let row = |n: usize| {
        let rates = lines.iter().map(|line| format!("{:.0}", line.points[n].1));
        let printed = if ROWS[n] == 7 { "12" } else { "" };
        [ROWS[n].to_string(), printed.to_owned()].into_iter().chain(rates).collect()
    };
    let mut rows: Vec<Vec<String>> = (0..ROWS.len()).map(row).collect();
    for (name, least, printed) in
        [("most rows at 12 frames a second", 12.0, "7"), ("most rows at 60 frames a second", 60.0, "")]
    {
        let most = lines.iter().map(|line| highest(&line.points, least));
        rows.push([name.to_owned(), printed.to_owned()].into_iter().chain(most).collect());
    }
    let head: Vec<&str> = ["rows", "dissertation (2003)"].into_iter().chain(COLUMNS.iter().map(|c| c.name)).collect();
    let chart = chart(&lines, "rows", "frames a second", &[(12.0, "12: least"), (60.0, "60: real time")]);
    Ok(format!(
        "<p>The dissertation's graph has one figure in the text: seven rows at 12 frames a second, the least that counts as real time. Here a frame is a \
         sixtieth of a second of simulated time, so 60 frames a second are real time and fewer are slow motion. Timed from a quarter to three quarters of a second after the start.</p>{chart}{}",
        table(&head, &rows)
    ))
}
