//! Steps as long as the last frame took, which section 5.2.2 leaves to the future "because of the
//! risk of stiff equations".

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::{BuildError, Constants};
use teeter_scene::{TowerOptions, tower};

use super::length::mm;
use super::part::Inputs;
use super::springs::Springs;
use super::tower::Tower;
use crate::error::Error;
use crate::table::Table;

/// Frame rates to which the steps adapt, frames per second.
const RATES: [f64; 6] = [60.0, 30.0, 20.0, 15.0, 12.0, 10.0];
/// Number of experiments.
pub const STEPS: u64 = RATES.len() as u64;
/// Rows of the tower.
const ROWS: u32 = 6;
/// Simulated time, s.
const SECONDS: f64 = 2.0;
/// Displacement beyond which a tower has flown apart, m.
const APART: f64 = 0.5;

/// Row of a frame rate: the loops a frame stay as they are, so each takes as much longer.
fn measure(constants: &Constants, frame_rate: f64) -> Result<Vec<String>, Error> {
    let scene = tower(&TowerOptions { rows: ROWS, ..TowerOptions::default() })?;
    let constants = Constants { frame_rate, ..constants.clone() };
    let force_step = constants.force_step();
    let row = |result: String| vec![format!("{frame_rate:.0}"), format!("{:.0}", 1e6 * force_step), result];
    let mut tower = match Springs::new(&scene, constants) {
        Ok(springs) => Tower::new(springs),
        Err(BuildError::Constant(_)) => return Ok(row("the springs diverge".to_owned())),
        Err(error) => return Err(error.into()),
    };
    let start = tower.centres();
    let mut moved = 0.0;
    for _ in 0..(SECONDS * frame_rate) as u32 {
        tower.step(None);
        let now = tower.centres();
        let each = now.iter().zip(&start).map(|(now, start)| now.distance(*start));
        moved = each.fold(0.0, |max: f64, d| if d.is_finite() { max.max(d) } else { f64::INFINITY });
        if moved > APART {
            break;
        }
    }
    let result = if moved > APART { "flies apart".to_owned() } else { format!("{} mm", mm(moved)) };
    Ok(row(result))
}

/// Lets a tower settle with each step.
pub fn run(Inputs { constants, bar, .. }: Inputs) -> Result<Markup, Error> {
    let rows: Vec<Vec<String>> = RATES
        .par_iter()
        .map(|rate| {
            let row = measure(constants, *rate);
            bar.inc(1);
            row
        })
        .collect::<Result<_, Error>>()?;
    let loops = constants.mid_loop_count;
    Ok(html! {
        p {
            "A step that is \"proportional to the length of time the last frame took\" keeps \
             simulated time at the clock's: at half the frame rate each of the " (loops) " loops \
             of a frame covers twice the time. The springs of a block diverge where the step is \
             beyond the limit of the integrator, which follows from their stiffness and the mass of \
             a particle. A tower of " (ROWS) " rows with such steps, after \
             " (SECONDS) " s:"
        }
        (Table::new(["frames a second", "a computation of forces, µs", "maximum displacement of a block"], rows))
    })
}
