//! Table 5.2 and the speed that culling gains.

use cpu_time::ThreadTime;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::counters::{StepCounts, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{TowerOptions, tower};

use super::column::Springs;
use super::page::table;
use crate::fault::Fault;

/// Experiments of [`counts`].
pub const STEPS: u64 = ROWS.len() as u64;
/// Experiments of [`culling`].
pub const CULLING_STEPS: u64 = 4;

const ROWS: [u32; 3] = [6, 9, 18];

/// The printed table, from no test to actual collisions.
const PRINTED: [[u64; 3]; 5] =
    [[102_816, 235_872, 961_632], [30_240, 48_384, 102_816], [8_274, 13_480, 27_584], [174, 213, 767], [40, 67, 158]];

const NAMES: [&str; 5] = ["no test", "boxes of blocks", "all boxes", "boxes, planes and lines", "collisions"];

fn settled(rows: u32, constants: Constants) -> Result<Jenga3D, Fault> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| Fault::Said(e.to_string()))?;
    let mut simulator = Springs::new(&scene, constants)?.0;
    for _ in 0..30 {
        simulator.frame(None);
    }
    Ok(simulator)
}

/// Counts of one step, both calls of `CollideBlocks` in full, as a mean over a frame.
pub fn counts_of(rows: u32) -> Result<[f64; 5], Fault> {
    let constants = Constants { skip_unchanged: false, disabling: Disabling::Off, ..Constants::default() };
    let mut simulator = settled(rows, constants)?;
    let steps = simulator.constants.mid_loop_count;
    let mut sums = [0u64; 5];
    for _ in 0..steps {
        let StepCounts { first: c, .. } = simulator.step(None);
        for (sum, count) in sums.iter_mut().zip([c.potential, c.after_blocks, c.after_boxes, c.after_planes, c.collisions]) {
            *sum += count;
        }
    }
    Ok(sums.map(|sum| sum as f64 / f64::from(steps)))
}

/// The table.
pub fn counts(bar: &ProgressBar) -> Result<String, Fault> {
    let ours: Vec<[f64; 5]> = ROWS
        .par_iter()
        .map(|&rows| {
            let counts = counts_of(rows);
            bar.inc(1);
            counts
        })
        .collect::<Result<_, _>>()?;
    let rows: Vec<Vec<String>> = NAMES
        .iter()
        .enumerate()
        .map(|(n, name)| {
            let cells = (0..ROWS.len()).flat_map(|column| [PRINTED[n][column].to_string(), format!("{:.0}", ours[column][n])]);
            std::iter::once((*name).to_owned()).chain(cells).collect()
        })
        .collect();
    let head = ["left after", "6 rows: printed", "ours", "9 rows: printed", "ours", "18 rows: printed", "ours"];
    let formula: Vec<String> = ROWS.iter().map(|rows| format!("{} rows {}", rows, 2 * tests(u64::from(3 * rows)))).collect();
    Ok(table(&head, &rows)
        + &format!(
            "<p>The printed columns are headed 6, 9 and 18 blocks. They are rows: 168 n (n - 1) tests of section 4.4.3 for 18, 27 and 54 blocks, twice \
             over because <code>CollideBlocks</code> is called twice a step, give {}, as printed. The printed second line is exactly nine pairs for each \
             two neighbouring rows. Ours are means over 160 steps of a tower that has settled for half a second; blocks of one row have their boxes 0.3 mm \
             apart, and count once they have moved together. The boxes of the blocks are looked at before those of their parts in both; why the printed \
             third line is larger cannot be told from the text: boxes that were wider than needed would do it, as would a step that moves further.</p>",
            formula.join(", ")
        ))
}

/// What a step costs with each level of culling.
pub fn culling(bar: &ProgressBar) -> Result<String, Fault> {
    let levels = [
        (Culling::None, "none: the roots of every cubic"),
        (Culling::Blocks, "boxes of blocks"),
        (Culling::Boxes, "all boxes"),
        (Culling::Planes, "all boxes, planes and lines"),
    ];
    let mut times = Vec::new();
    for (culling, _) in levels {
        let mut simulator = settled(6, Constants { skip_unchanged: false, ..Constants::default() })?;
        simulator.constants.culling = culling;
        let steps = if culling < Culling::Boxes { 40 } else { 640 };
        let clock = ThreadTime::now();
        for _ in 0..steps {
            simulator.step(None);
        }
        times.push(clock.elapsed().as_secs_f64() / f64::from(steps));
        bar.inc(1);
    }
    let row = |n: usize| vec![levels[n].1.to_owned(), format!("{:.0}", 1e6 * times[n]), format!("{:.1}", times[0] / times[n])];
    let rows: Vec<Vec<String>> = (0..levels.len()).map(row).collect();
    Ok(format!(
        "<p>The dissertation: \"an overall speed increase for the simulation of at least 10 fold\". Six rows, the whole step with its forces:</p>{}",
        table(&["tests before the exact one", "a step, µs", "times as fast"], &rows)
    ))
}
