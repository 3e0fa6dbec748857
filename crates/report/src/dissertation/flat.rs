//! The methods of chapter 2 side by side in the plane, on stacks that fall onto themselves (section 3.4, Figures 3.3 and 3.5).

use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::flat::rigid::Constants;
use teeter_dissertation::flat::{Method, Rigid2D, Springs2D, scene, springs};

use super::page::table;
use crate::error::Error;

const HEIGHTS: [u32; 5] = [1, 2, 3, 5, 8];

/// Experiments.
pub const STEPS: u64 = HEIGHTS.len() as u64;

/// How far above each other the blocks begin, m.
const GAP: f64 = 1e-3;

/// How a stack fared by one method.
pub struct Fare {
    /// Most pairs, impulses or rounds that a step took.
    pub most: u32,
    /// Steps that reached the limit.
    pub capped: u32,
    /// Steps whose resting forces could not be found.
    pub unsolved: u32,
    /// How far the top block ended from where it should rest, m.
    pub off: f64,
}

/// Two seconds of a stack of rigid blocks.
pub fn rigid(count: u32, method: Method) -> Fare {
    let constants = Constants::of(method);
    let mut world = Rigid2D::new(&scene::stack(count, GAP), constants);
    let mut fare = Fare { most: 0, capped: 0, unsolved: 0, off: 0.0 };
    for _ in 0..(2.0 / constants.step) as u32 {
        let report = world.step();
        fare.most = fare.most.max(report.iterations);
        fare.capped += u32::from(report.capped);
        fare.unsolved += u32::from(report.failure.is_some());
    }
    Fare { off: off(world.pose(count as usize - 1).0, count), ..fare }
}

/// The same of springs.
pub fn of_springs(count: u32) -> Fare {
    let constants = springs::Constants::default();
    let mut world = Springs2D::new(&scene::stack(count, GAP), constants);
    let mut fare = Fare { most: 0, capped: 0, unsolved: 0, off: 0.0 };
    for _ in 0..(2.0 / constants.step) as u32 {
        let report = world.step();
        fare.most = fare.most.max(report.sweeps);
        fare.capped += u32::from(report.unresolved);
    }
    Fare { off: off(world.pose(count as usize - 1).0, count), ..fare }
}

fn off(top: glam::DVec2, count: u32) -> f64 {
    top.distance(glam::DVec2::new(0.0, 0.018 * (f64::from(count) - 0.5)))
}

/// Runs them.
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let rows: Vec<Vec<String>> = HEIGHTS
        .par_iter()
        .map(|&count| {
            let fares = Method::ALL.map(|method| rigid(count, method)).into_iter().chain([of_springs(count)]);
            let cell = |fare: Fare| {
                let mut text = format!("{}; {} mm", fare.most, super::page::mm(fare.off));
                if fare.capped > 0 {
                    text += &format!("; {} steps cut short", fare.capped);
                }
                if fare.unsolved > 0 {
                    text += &format!("; {} steps unsolved", fare.unsolved);
                }
                text
            };
            let row = std::iter::once(count.to_string()).chain(fares.map(cell)).collect();
            bar.inc(1);
            row
        })
        .collect();
    let head: Vec<&str> = std::iter::once("blocks").chain(Method::ALL.map(Method::name)).chain(["springs"]).collect();
    Ok(format!(
        "<p>Blocks 1 mm above each other fall into a stack. Each cell has the most iterations of a step (pairs resolved, impulses, or rounds over the pairs; \
         the penalty method has none) and how far the top block is after 2 s from where it belongs. The constraint method resolves pair by pair, which \
         in a stack undoes what it did before: Figure 3.3. Its limit of {} pairs a step keeps it from never ending. Springs give way and are done in a \
         couple of rounds: Figure 3.5.</p>{}",
        Constants::of(Method::Constraint).max_iterations,
        table(&head, &rows)
    ))
}
