//! Move 5 at other speeds: a block that bears load drags the tower the further, the slower it is.

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::Constants;

use super::player::{Move, play};
use crate::dissertation::column::{ENGINE, kinetic_friction};
use crate::dissertation::length::mm;
use crate::dissertation::part::Inputs;
use crate::error::Error;
use crate::table::Table;

/// Speeds of the move, m/s.
const SPEEDS: [f64; 4] = [2.0, 1.5, 1.0, 0.3];
/// Number of experiments.
pub const STEPS: u64 = (SPEEDS.len() * ENGINE.len()) as u64;
/// Length of a block, m.
const LENGTH: f64 = 0.081;

/// Displacement by the last of the moves at a speed (m/s), as text.
fn measure(column: usize, constants: &Constants, moves: &[Move], speed: f64) -> Result<String, Error> {
    let mut played = moves.to_vec();
    if let Some(Move::Take(_, _, of_move)) = played.last_mut() {
        *of_move = speed;
    }
    let mut cell = String::new();
    play(&ENGINE[column], constants, &played, |_, outcome| {
        cell = if outcome.stands { mm(outcome.max_displacement) } else { "falls".to_owned() };
    })?;
    Ok(cell)
}

/// Plays moves with the engine, the last of them at each speed.
pub fn run(Inputs { constants, bar, .. }: Inputs, moves: &[Move]) -> Result<Markup, Error> {
    let cases: Vec<(f64, usize)> =
        SPEEDS.iter().flat_map(|speed| (0..ENGINE.len()).map(|column| (*speed, column))).collect();
    let cells: Vec<String> = cases
        .par_iter()
        .map(|&(speed, column)| {
            let cell = measure(column, constants, moves, speed);
            bar.inc(1);
            cell
        })
        .collect::<Result<_, Error>>()?;
    // Of what lies on a block that bears half of its weight.
    let acceleration = 0.5 * kinetic_friction(constants) * constants.gravity;
    let estimate = |speed: f64| 0.5 * acceleration * (LENGTH / speed) * (LENGTH / speed);
    let row = |(speed, cells): (&f64, &[String])| {
        [speed.to_string(), mm(estimate(*speed))].into_iter().chain(cells.iter().cloned()).collect()
    };
    let rows = SPEEDS.iter().zip(cells.chunks(ENGINE.len())).map(row).collect();
    let head = ["m/s", "a L² / (2 v²), mm"].into_iter().chain(ENGINE.iter().map(|column| column.name));
    Ok(html! {
        p {
            "The text gives no speed. A loaded block drags what lies on it while it slides out, \
             for L / v. If it bears half of the weight, friction accelerates that by a = μ g / 2, \
             and moves it by a L² / (2 v²) in that time. It then slides on until friction has \
             stopped it, which the estimate leaves out. Move 5 at other speeds, maximum \
             displacement in mm:"
        }
        (Table::new(head, rows))
    })
}
