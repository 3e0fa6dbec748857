//! Figure 6.21: a full tower on springs that are too soft for it.

use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::Constants;
use teeter_scene::{TowerOptions, tower};

use super::column::{Springs, Tower};
use super::page::table;
use super::picture;
use crate::error::Error;

/// Experiments.
pub const STEPS: u64 = STIFFNESSES.len() as u64;

/// Of the springs, N/m: the usual one, and softer ones.
const STIFFNESSES: [f64; 3] = [1e4, 1e3, 4e2];

/// Runs it.
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let scene = tower(&TowerOptions::default()).map_err(|e| Error::Said(e.to_string()))?;
    let results: Vec<(Vec<String>, String)> = STIFFNESSES
        .par_iter()
        .map(|&stiffness| {
            let damping = Constants::default().damping * (stiffness / Constants::default().stiffness).sqrt();
            let mut tower = Springs::new(&scene, Constants { stiffness, damping, ..Constants::default() })?;
            let full = tower.top(&|_| true);
            tower.rest(60);
            let sunk = full - tower.top(&|_| true);
            bar.inc(1);
            let caption = format!("{stiffness} N/m, after 1 s");
            Ok((vec![format!("{stiffness}"), format!("{:.2}", 1e3 * sunk)], picture::of(&tower, 0.33, false, &caption)))
        })
        .collect::<Result<_, Error>>()?;
    let (rows, pictures): (Vec<_>, Vec<_>) = results.into_iter().unzip();
    Ok(format!(
        "<p>The dissertation shows the lower rows of a full tower pressed flat, and gives no figure. The top of a tower of 18 rows, {:.0} mm high, sinks \
         in a second by:</p>{}{}",
        1e3 * 18.0 * 0.018,
        table(&["stiffness of a spring, N/m", "sinks, mm"], &rows),
        pictures.concat()
    ))
}
