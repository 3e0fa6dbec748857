//! Fewer springs a block: "the sheer number of springs that have to be used to model an object"
//! (sections 6.2.2 and 6.3).

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::{Constants, SpringSet};
use teeter_scene::{TowerOptions, tower};

use super::cost;
use super::length::mm;
use super::part::Inputs;
use super::springs::Springs;
use super::tower::{FRAME_RATE, Tower};
use crate::error::Error;
use crate::table::Table;

/// Sets of springs.
const SETS: [(SpringSet, &str); 3] = [
    (SpringSet::All, "every two particles"),
    (SpringSet::Sides, "edges and both diagonals of each side"),
    (SpringSet::Faces, "edges and one diagonal of each side"),
];
/// Number of experiments.
pub const STEPS: u64 = SETS.len() as u64;
/// Rows of the tower.
const ROWS: u32 = 6;
/// Simulated time, s.
const SECONDS: f64 = 2.0;

/// Row of a set of springs.
fn measure(constants: &Constants, (springs, name): (SpringSet, &str)) -> Result<Vec<String>, Error> {
    let scene = tower(&TowerOptions { rows: ROWS, ..TowerOptions::default() })?;
    let mut tower = Tower::new(Springs::new(&scene, Constants { springs, ..constants.clone() })?);
    let start = tower.centres();
    tower.rest((SECONDS * FRAME_RATE) as u32);
    let moved = tower.centres().iter().zip(&start).map(|(now, start)| now.distance(*start)).fold(0.0, f64::max);
    let count = springs.mask().count_ones();
    let operations = format!("{:.0}", cost::of_block(count as usize));
    Ok(vec![name.to_owned(), count.to_string(), operations, mm(moved)])
}

/// Lets a tower of blocks with each set of springs settle.
pub fn run(Inputs { constants, bar, .. }: Inputs) -> Result<Markup, Error> {
    let rows: Vec<Vec<String>> = SETS
        .par_iter()
        .map(|set| {
            let row = measure(constants, *set);
            bar.inc(1);
            row
        })
        .collect::<Result<_, Error>>()?;
    let head = ["springs of a block", "number", "operations a block, each time", "maximum displacement in 2 s, mm"];
    Ok(html! {
        p {
            "Every two of the eight particles are joined in 2003. Eight particles have 24 \
             coordinates, six of them those of the whole block, so 18 springs are enough. A tower \
             of " (ROWS) " rows, each spring as stiff as before:"
        }
        (Table::new(head, rows))
    })
}
