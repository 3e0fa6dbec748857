//! Table 5.2, and the time saved by culling.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::counters::{StepCounts, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{TowerOptions, tower};

use super::part::Inputs;
use super::springs::Springs;
use crate::error::Error;
use crate::table::Table;

/// Number of experiments of [`counts`].
pub const STEPS: u64 = (ROWS.len() * READINGS.len()) as u64;
/// Number of experiments of [`time_culling`].
pub const CULLING_STEPS: u64 = LEVELS.len() as u64;

/// Levels of culling, and whether the bounding boxes are compared as listed.
const LEVELS: [(Culling, bool, &str); 5] = [
    (Culling::None, false, "none: the roots of every cubic"),
    (Culling::Blocks, false, "boxes of blocks"),
    (Culling::Boxes, false, "all boxes"),
    (Culling::Planes, true, "all boxes as listed, planes and lines"),
    (Culling::Planes, false, "all boxes corrected, planes and lines"),
];

/// Rows of the towers.
const ROWS: [u32; 3] = [6, 9, 18];

/// Printed table, from no test to actual collisions.
const PRINTED: [[u64; 3]; 5] =
    [[102_816, 235_872, 961_632], [30_240, 48_384, 102_816], [8_274, 13_480, 27_584], [174, 213, 767], [40, 67, 158]];

const NAMES: [&str; 5] = ["no test", "boxes of blocks", "all boxes", "boxes, planes and lines", "collisions"];

/// Comparison of the boxes of corners and faces: true as Figure 5.5 lists it, false with the
/// indices that must be meant.
const READINGS: [(&str, bool); 2] = [("as listed", true), ("corrected", false)];

/// Frames before the counts.
const SETTLING: u32 = 30;

fn settled(rows: u32, constants: Constants) -> Result<Jenga3D, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let mut simulator = Springs::new(&scene, constants)?.0;
    for _ in 0..SETTLING {
        simulator.frame(None);
    }
    Ok(simulator)
}

/// Counts of a step, both calls of `CollideBlocks` in full: mean over a frame.
fn counts_of(constants: &Constants, rows: u32, listed_boxes: bool) -> Result<[f64; 5], Error> {
    let constants = Constants {
        listed_boxes,
        culling: Culling::Planes,
        skip_unchanged: false,
        disabling: Disabling::Off,
        ..constants.clone()
    };
    let mut simulator = settled(rows, constants)?;
    let steps = simulator.constants.mid_loop_count;
    let mut sums = [0u64; 5];
    for _ in 0..steps {
        let StepCounts { first: c, .. } = simulator.step(None);
        let counts = [c.potential, c.after_blocks, c.after_boxes, c.after_planes, c.collisions];
        sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
    }
    Ok(sums.map(|sum| sum as f64 / f64::from(steps)))
}

/// Counts the tests of each level, beside the printed table.
pub fn counts(Inputs { constants, bar, .. }: Inputs) -> Result<Markup, Error> {
    let cases: Vec<(u32, bool)> = ROWS.iter().flat_map(|rows| READINGS.map(|(_, listed)| (*rows, listed))).collect();
    let counted: Vec<[f64; 5]> = cases
        .par_iter()
        .map(|&(rows, listed)| {
            let counts = counts_of(constants, rows, listed);
            bar.inc(1);
            counts
        })
        .collect::<Result<_, _>>()?;
    let formula: Vec<String> = ROWS.iter().map(|rows| (2 * tests(u64::from(3 * rows))).to_string()).collect();
    let listed = Ratios::of(&counted);
    let printed_per_collision =
        list(&PRINTED[3].iter().zip(PRINTED[4]).map(|(left, hits)| *left as f64 / hits as f64).collect::<Vec<_>>());
    Ok(html! {
        (table(&counted))
        p {
            "The printed columns are headed 6, 9 and 18 blocks. They are rows: twice the 168 n (n \
             - 1) tests of section 4.4.3 is " (formula.join(", ")) " for 18, 27 and 54 blocks, as \
             printed. Here the two are the calls of " code { "CollideBlocks" } " in a step; a loop \
             over the pairs in both orders would give the same. The printed second line is exactly \
             nine pairs for each two neighbouring rows. The counts of this \
             implementation are means over the " (constants.mid_loop_count) " steps of a frame of a tower that has settled for half a \
             second; blocks of one row have their boxes 0.3 mm apart, and count once they have \
             moved together."
        }
        p {
            "Figure 5.5 compares in the first of its inner loops, over the corners p1 of one block \
             and the faces f2 of the other, the boxes of p2 and f1. So it keeps each corner for \
             every face that meets the other block, near or not. Counted as listed, the last three \
             lines are " (listed.of_printed) " of the printed ones, and " (listed.per_collision) " \
             times as many tests are left as there are collisions. The text has \"about 4-5 \
             times\", its table " (printed_per_collision) ". Corrected, the boxes leave \
             " (listed.corrected) " of the tests as listed. The collisions are the same except for \
             corners that pass a face by less than " (micrometres(constants.tolerance)) " µm. The rest of the difference is the same \
             in all three lines: how often touching blocks collide, which depends on constants \
             that the text does not give."
        }
    })
}

/// Printed and counted tests; `counted` has the readings of each height in turn.
fn table(counted: &[[f64; 5]]) -> Table {
    let row = |n: usize, name: &str| {
        let mut row = vec![name.to_owned()];
        for (printed, readings) in PRINTED[n].iter().zip(counted.chunks(READINGS.len())) {
            row.push(printed.to_string());
            row.extend(readings.iter().map(|counts| format!("{:.0}", counts[n])));
        }
        row
    };
    let mut head = vec!["left after".to_owned()];
    for rows in ROWS {
        head.push(format!("{rows} rows: printed"));
        head.extend(READINGS.map(|(name, _)| name.to_owned()));
    }
    Table::new(head, NAMES.iter().enumerate().map(|(n, name)| row(n, name)).collect())
}

/// Ratios of the counts, as text.
struct Ratios {
    /// Smallest and largest ratio of the last three lines as listed to those printed.
    of_printed: String,
    /// Tests left as listed for each collision, by height.
    per_collision: String,
    /// Smallest and largest part of the tests as listed that the corrected boxes leave.
    corrected: String,
}

impl Ratios {
    /// Ratios of counts that have the readings of each height in turn.
    fn of(counted: &[[f64; 5]]) -> Self {
        let heights = || counted.chunks(READINGS.len()).enumerate();
        let of_printed: Vec<f64> =
            heights().flat_map(|(h, counts)| (2..5).map(move |n| counts[0][n] / PRINTED[n][h] as f64)).collect();
        let per_collision: Vec<f64> = heights().map(|(_, counts)| counts[0][3] / counts[0][4]).collect();
        let corrected: Vec<f64> = heights().map(|(_, counts)| counts[1][2] / counts[0][2]).collect();
        Self { of_printed: range(&of_printed), per_collision: list(&per_collision), corrected: range(&corrected) }
    }
}

/// Length (m) in µm.
fn micrometres(length: f64) -> f64 {
    (1e9 * length).round() / 1e3
}

fn range(values: &[f64]) -> String {
    let (min, max) = values.iter().fold((f64::INFINITY, 0.0f64), |(min, max), v| (min.min(*v), max.max(*v)));
    format!("{min:.2} to {max:.2}")
}

fn list(values: &[f64]) -> String {
    values.iter().map(|v| format!("{v:.1}")).collect::<Vec<_>>().join(", ")
}

/// Times a step with each level of culling, s.
pub fn time_culling(constants: &Constants, bar: &ProgressBar) -> Result<Vec<f64>, Error> {
    let mut times = Vec::new();
    for (culling, listed_boxes, _) in LEVELS {
        let mut simulator = settled(6, Constants { skip_unchanged: false, listed_boxes, ..constants.clone() })?;
        simulator.constants.culling = culling;
        let steps = if culling < Culling::Boxes { 40 } else { 640 };
        let clock = ThreadTime::now();
        for _ in 0..steps {
            simulator.step(None);
        }
        times.push(clock.elapsed().as_secs_f64() / f64::from(steps));
        bar.inc(1);
    }
    Ok(times)
}

/// Shows the times of a step with each level of culling.
pub fn culling(Inputs { times, .. }: Inputs) -> Result<Markup, Error> {
    let row = |n: usize| {
        vec![LEVELS[n].2.to_owned(), format!("{:.0}", 1e6 * times[n]), format!("{:.1}", times[0] / times[n])]
    };
    let rows = (0..LEVELS.len()).map(row).collect();
    Ok(html! {
        p {
            "The dissertation: \"an overall speed increase for the simulation of at least 10 \
             fold\". Six rows, the whole step with its forces:"
        }
        (Table::new(["tests before the exact one", "a step, µs", "speed-up"], rows))
    })
}
