//! Figure 6.21: a full tower on soft springs.

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::Constants;
use teeter_scene::{Scene, TowerOptions, tower};

use super::part::Inputs;
use super::picture::{self, Highlight};
use super::springs::Springs;
use super::tower::{FRAME_RATE, Tower};
use crate::error::Error;
use crate::table::Table;

/// Factors by which the springs are softer.
const SOFTER: [f64; 3] = [1.0, 10.0, 25.0];
/// Rows of the tower.
const ROWS: u32 = 18;
/// Number of experiments.
pub const STEPS: u64 = SOFTER.len() as u64;
/// Height of the pictures, m.
const HEIGHT: f64 = 0.33;

/// Row and picture of a tower after a second on springs that are softer by a factor.
fn measure(scene: &Scene, constants: &Constants, softer: f64) -> Result<(Vec<String>, Markup), Error> {
    let stiffness = constants.stiffness / softer;
    let damping = constants.damping * (stiffness / constants.stiffness).sqrt();
    // The rows begin apart, and fall onto each other before they press.
    let gaps = f64::from(ROWS) * constants.row_spacing;
    let mut tower = Tower::new(Springs::new(scene, Constants { stiffness, damping, ..constants.clone() })?);
    let full = tower.top(|_| true) - gaps;
    tower.rest(FRAME_RATE as u32);
    let sink = full - tower.top(|_| true);
    let picture = picture::figure(&tower, HEIGHT, Highlight::None, &format!("{stiffness} N/m, after 1 s"));
    Ok((vec![stiffness.to_string(), format!("{:.2}", 1e3 * sink)], picture))
}

/// Lets full towers sink.
pub fn run(Inputs { constants, bar, .. }: Inputs) -> Result<Markup, Error> {
    let scene = tower(&TowerOptions { rows: ROWS, ..TowerOptions::default() })?;
    let results: Vec<(Vec<String>, Markup)> = SOFTER
        .par_iter()
        .map(|&softer| {
            let result = measure(&scene, constants, softer);
            bar.inc(1);
            result
        })
        .collect::<Result<_, Error>>()?;
    let (rows, pictures): (Vec<_>, Vec<_>) = results.into_iter().unzip();
    Ok(html! {
        p {
            "The dissertation illustrates \"the results of simulating a full tower with soft \
             springs\", and gives neither their stiffness nor a length. The top of a tower of \
             " (ROWS) " rows is in a second below the sum of the heights of its blocks by:"
        }
        (Table::new(["stiffness of a spring, N/m", "sink, mm"], rows))
        @for picture in pictures { (picture) }
    })
}
