//! Table 5.2, and the time saved by culling.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::counters::{StepCounts, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{TowerOptions, tower};

use super::springs::Springs;
use crate::error::Error;
use crate::table::Table;

/// Number of experiments of [`counts`].
pub const STEPS: u64 = (ROWS.len() * READINGS.len()) as u64;
/// Number of experiments of [`culling`].
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
fn counts_of(rows: u32, listed_boxes: bool) -> Result<[f64; 5], Error> {
    let constants =
        Constants { listed_boxes, skip_unchanged: false, disabling: Disabling::Off, ..Constants::default() };
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
pub fn counts(bar: &ProgressBar) -> Result<Markup, Error> {
    let cases: Vec<(u32, bool)> = ROWS.iter().flat_map(|rows| READINGS.map(|(_, listed)| (*rows, listed))).collect();
    let counted: Vec<[f64; 5]> = cases
        .par_iter()
        .map(|&(rows, listed)| {
            let counts = counts_of(rows, listed);
            bar.inc(1);
            counts
        })
        .collect::<Result<_, _>>()?;
    let formula: Vec<String> =
        ROWS.iter().map(|rows| format!("{rows} rows {}", 2 * tests(u64::from(3 * rows)))).collect();
    Ok(html! {
        (table(&counted))
        p {
            "The printed columns are headed 6, 9 and 18 blocks. They are rows: 168 n (n - 1) tests \
             of section 4.4.3 for 18, 27 and 54 blocks, twice because " code { "CollideBlocks" } " \
             is called twice a step, give " (formula.join(", ")) ", as printed. The printed second \
             line is exactly nine pairs for each two neighbouring rows. The counts of this \
             implementation are means over 160 steps of a tower that has settled for half a \
             second; blocks of one row have their boxes 0.3 mm apart, and count once they have \
             moved together."
        }
        p {
            "Figure 5.5 compares in the first of its inner loops, over the corners p1 of one block \
             and the faces f2 of the other, the boxes of p2 and f1. So it keeps each corner for \
             every face that meets the other block, near or not. Counted as listed, all lines are \
             close to the printed ones, and four to five times as many tests are left as there are \
             collisions, as the text says. Corrected, the boxes leave a sixth to an eighth of \
             that. The collisions are the same except for corners that pass a face by less than \
             0.1 µm."
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

/// Times a step with each level of culling.
pub fn culling(bar: &ProgressBar) -> Result<Markup, Error> {
    let mut times = Vec::new();
    for (culling, listed_boxes, _) in LEVELS {
        let mut simulator = settled(6, Constants { skip_unchanged: false, listed_boxes, ..Constants::default() })?;
        simulator.constants.culling = culling;
        let steps = if culling < Culling::Boxes { 40 } else { 640 };
        let clock = ThreadTime::now();
        for _ in 0..steps {
            simulator.step(None);
        }
        times.push(clock.elapsed().as_secs_f64() / f64::from(steps));
        bar.inc(1);
    }
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
