//! Table 5.2 and the speed that culling gains.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::counters::{StepCounts, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{TowerOptions, tower};

use super::column::Springs;
use super::page::table;
use crate::error::Error;

/// Experiments of [`counts`].
pub const STEPS: u64 = (ROWS.len() * READINGS.len()) as u64;
/// Experiments of [`culling`].
pub const CULLING_STEPS: u64 = LEVELS.len() as u64;

/// Levels of culling, the last two with the boxes compared as listed and put right.
const LEVELS: [(Culling, bool, &str); 5] = [
    (Culling::None, false, "none: the roots of every cubic"),
    (Culling::Blocks, false, "boxes of blocks"),
    (Culling::Boxes, false, "all boxes"),
    (Culling::Planes, true, "all boxes as listed, planes and lines"),
    (Culling::Planes, false, "all boxes put right, planes and lines"),
];

const ROWS: [u32; 3] = [6, 9, 18];

/// The printed table, from no test to actual collisions.
const PRINTED: [[u64; 3]; 5] =
    [[102_816, 235_872, 961_632], [30_240, 48_384, 102_816], [8_274, 13_480, 27_584], [174, 213, 767], [40, 67, 158]];

const NAMES: [&str; 5] = ["no test", "boxes of blocks", "all boxes", "boxes, planes and lines", "collisions"];

/// How the boxes of corners and faces are compared: as Figure 5.5 lists it, and as it must be meant.
const READINGS: [(&str, bool); 2] = [("as listed", true), ("put right", false)];

fn settled(rows: u32, constants: Constants) -> Result<Jenga3D, Error> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| Error::Said(e.to_string()))?;
    let mut simulator = Springs::new(&scene, constants)?.simulator;
    for _ in 0..30 {
        simulator.frame(None);
    }
    Ok(simulator)
}

/// Counts of one step, both calls of `CollideBlocks` in full, as a mean over a frame, with the boxes compared as Figure 5.5 lists it or put right.
fn counts_of(rows: u32, listed_boxes: bool) -> Result<[f64; 5], Error> {
    let constants =
        Constants { listed_boxes, skip_unchanged: false, disabling: Disabling::Off, ..Constants::default() };
    let mut simulator = settled(rows, constants)?;
    let steps = simulator.constants.mid_loop_count;
    let mut sums = [0u64; 5];
    for _ in 0..steps {
        let StepCounts { first: c, .. } = simulator.step(None);
        for (sum, count) in
            sums.iter_mut().zip([c.potential, c.after_blocks, c.after_boxes, c.after_planes, c.collisions])
        {
            *sum += count;
        }
    }
    Ok(sums.map(|sum| sum as f64 / f64::from(steps)))
}

/// The table.
pub fn counts(bar: &ProgressBar) -> Result<String, Error> {
    let cases: Vec<(u32, bool)> = ROWS.iter().flat_map(|rows| READINGS.map(|(_, listed)| (*rows, listed))).collect();
    let ours: Vec<[f64; 5]> = cases
        .par_iter()
        .map(|&(rows, listed)| {
            let counts = counts_of(rows, listed);
            bar.inc(1);
            counts
        })
        .collect::<Result<_, _>>()?;
    let row = |n: usize, name: &str| {
        let cells = PRINTED[n].iter().zip(ours.chunks(READINGS.len()));
        let cells = cells.flat_map(|(printed, ours)| {
            std::iter::once(printed.to_string()).chain(ours.iter().map(move |counts| format!("{:.0}", counts[n])))
        });
        std::iter::once(name.to_owned()).chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = NAMES.iter().enumerate().map(|(n, name)| row(n, name)).collect();
    let head = ROWS.iter().flat_map(|rows| {
        std::iter::once(format!("{rows} rows: printed")).chain(READINGS.map(|(name, _)| name.to_owned()))
    });
    let head: Vec<String> = std::iter::once("left after".to_owned()).chain(head).collect();
    let formula: Vec<String> =
        ROWS.iter().map(|rows| format!("{} rows {}", rows, 2 * tests(u64::from(3 * rows)))).collect();
    Ok(table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &rows)
        + &format!(
            "<p>The printed columns are headed 6, 9 and 18 blocks. They are rows: 168 n (n - 1) tests of section 4.4.3 for 18, 27 and 54 blocks, twice \
             over because <code>CollideBlocks</code> is called twice a step, give {}, as printed. The printed second line is exactly nine pairs for each \
             two neighbouring rows. Ours are means over 160 steps of a tower that has settled for half a second; blocks of one row have their boxes 0.3 mm \
             apart, and count once they have moved together.</p>\
             <p>Figure 5.5 compares in the first of its inner loops, which goes over the corners p1 of one block and the faces f2 of the other, the boxes of \
             p2 and f1. So it leaves each corner for every face that meets the other block, whether it is near or not. Counted as listed, all lines are \
             near what is printed, and four to five times as many tests are left as there are collisions, as the text says. Put right, the boxes leave \
             a sixth to an eighth of that. What collides is the same but for corners that pass a face by less than 0.1 µm.</p>",
            formula.join(", ")
        ))
}

/// What a step costs with each level of culling.
pub fn culling(bar: &ProgressBar) -> Result<String, Error> {
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
    let rows: Vec<Vec<String>> = (0..LEVELS.len()).map(row).collect();
    Ok(format!(
        "<p>The dissertation: \"an overall speed increase for the simulation of at least 10 fold\". Six rows, the whole step with its forces:</p>{}",
        table(&["tests before the exact one", "a step, µs", "times as fast"], &rows)
    ))
}
