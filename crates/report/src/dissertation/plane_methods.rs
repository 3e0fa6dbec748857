//! Methods of chapter 2 side by side in the plane, on stacks that fall onto themselves (section
//! 3.4, Figures 3.3 and 3.5).

use glam::DVec2;
use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::flat::rigid::Constants;
use teeter_dissertation::flat::{Method, Rigid2D, Springs2D, scene, springs};

use super::length::mm;
use super::part::Inputs;
use crate::error::Error;
use crate::table::Table;

/// Blocks of the stacks.
const BLOCKS: [u32; 5] = [1, 2, 3, 5, 8];
/// Number of experiments.
pub const STEPS: u64 = BLOCKS.len() as u64;
/// Initial gap between the blocks, m.
const GAP: f64 = 1e-3;
/// Height of a block, m.
const BLOCK_HEIGHT: f64 = 0.018;
/// Simulated time, s.
const SECONDS: f64 = 2.0;

/// Result of a stack under a method.
#[derive(Debug, Default)]
struct Outcome {
    /// Maximum of pairs, impulses or rounds in a step.
    iterations: u32,
    /// Steps that reached the limit of iterations.
    capped: u32,
    /// Steps whose resting forces could not be found.
    unsolved: u32,
    /// Displacement of the top block from its position at rest, m.
    error: DVec2,
}

impl Outcome {
    fn cell(&self) -> String {
        let mut text = format!("{}; {} mm up, {} aside", self.iterations, mm(self.error.y), mm(self.error.x.abs()));
        if self.capped > 0 {
            text += &format!("; {} steps cut short", self.capped);
        }
        if self.unsolved > 0 {
            text += &format!("; {} steps unsolved", self.unsolved);
        }
        text
    }
}

/// Stack of `count` rigid blocks.
fn rigid(count: u32, method: Method) -> Outcome {
    let constants = Constants::of(method);
    let mut world = Rigid2D::new(&scene::stack(count, GAP), constants);
    let mut outcome = Outcome::default();
    for _ in 0..(SECONDS / constants.step) as u32 {
        let report = world.step();
        outcome.iterations = outcome.iterations.max(report.iterations);
        outcome.capped += u32::from(report.capped);
        outcome.unsolved += u32::from(report.failure.is_some());
    }
    Outcome { error: top_error(world.pose(count as usize - 1).0, count), ..outcome }
}

/// Stack of `count` blocks of springs.
fn of_springs(count: u32) -> Outcome {
    let constants = springs::Constants::default();
    let mut world = Springs2D::new(&scene::stack(count, GAP), constants);
    let mut outcome = Outcome::default();
    for _ in 0..(SECONDS / constants.step) as u32 {
        let report = world.step();
        outcome.iterations = outcome.iterations.max(report.sweeps);
        outcome.capped += u32::from(report.unresolved);
    }
    Outcome { error: top_error(world.pose(count as usize - 1).0, count), ..outcome }
}

/// Displacement of the top block from its position at rest, m.
fn top_error(top: DVec2, count: u32) -> DVec2 {
    top - DVec2::new(0.0, BLOCK_HEIGHT * (f64::from(count) - 0.5))
}

/// Lets the stacks fall.
pub fn run(Inputs { bar, .. }: Inputs) -> Result<Markup, Error> {
    let rows: Vec<Vec<String>> = BLOCKS
        .par_iter()
        .map(|&count| {
            let mut row = vec![count.to_string()];
            row.extend(Method::ALL.map(|method| rigid(count, method).cell()));
            row.push(of_springs(count).cell());
            bar.inc(1);
            row
        })
        .collect();
    let head = ["blocks"].into_iter().chain(Method::ALL.map(Method::name)).chain(["springs"]);
    let limit = Constants::of(Method::Constraint).max_iterations;
    Ok(html! {
        p {
            "Blocks 1 mm above each other fall into a stack. Each cell has the maximum number of \
             iterations of a step (pairs resolved, impulses, or rounds over the pairs; the penalty \
             method has none) and the displacement of the top block from its position at rest \
             after 2 s. The constraint method resolves pair by pair, which in a stack undoes what \
             it did before: Figure 3.3. Its limit of " (limit) " pairs a step keeps it from never \
             ending. Springs give and need a couple of rounds: Figure 3.5."
        }
        p {
            "The constraints have no friction, as in Baraff's notes. Blocks that have fallen come \
             to rest a thousandth of a radian askew, within the margin of a resting contact, and \
             their forces act along the normals of those faces. So they slide apart, with opposite \
             momenta. Where steps are cut short the blocks stay where they are, and do not slide."
        }
        (Table::new(head, rows))
    })
}
