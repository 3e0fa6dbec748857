//! Figure 6.22: disabled blocks of a tower at rest, by the dissertation's rule and by others.

use maud::{Markup, html};
use rayon::prelude::*;
use teeter_dissertation::jenga3d::{Constants, Disabling};
use teeter_scene::{Scene, TowerOptions, tower};

use super::column::{Build, ENGINE};
use super::part::Inputs;
use super::picture::{self, Highlight};
use super::springs::Springs;
use super::tower::Tower;
use crate::error::Error;
use crate::table::Table;

/// Number of experiments.
pub const STEPS: u64 = 2 + ENGINE.len() as u64;
/// Frames before the count.
const SETTLING: u32 = 180;
/// Frames of the count: the rule of the dissertation judges single steps, so its counts differ from
/// frame to frame.
const FRAMES: usize = 30;
/// Height of the pictures, m.
const HEIGHT: f64 = 0.11;

fn by_listed_rule(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
    let constants = Constants { disabling: Disabling::Listed, ..constants.clone() };
    Ok(Tower::new(Springs::new(scene, constants)?))
}

fn by_rigid_motion(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
    let constants = Constants { disabling: Disabling::Rigid, ..constants.clone() };
    Ok(Tower::new(Springs::new(scene, constants)?))
}

/// Row and picture of a rule.
fn measure(scene: &Scene, constants: &Constants, (name, build): (&str, Build)) -> Result<(Vec<String>, Markup), Error> {
    let mut tower = build(scene, constants)?;
    tower.rest(SETTLING);
    let counts: Vec<usize> = (0..FRAMES)
        .map(|_| {
            tower.step(None);
            (0..tower.len()).filter(|block| tower.is_resting(*block)).count()
        })
        .collect();
    let mean = counts.iter().sum::<usize>() as f64 / FRAMES as f64;
    let (min, max) = (counts.iter().min().unwrap_or(&0), counts.iter().max().unwrap_or(&0));
    let row = vec![name.to_owned(), format!("{mean:.1}"), format!("{min} to {max}")];
    Ok((row, picture::figure(&tower, HEIGHT, Highlight::Resting, name)))
}

/// Counts disabled blocks.
pub fn run(Inputs { constants, bar, .. }: Inputs) -> Result<Markup, Error> {
    let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::default() })?;
    let mut cases: Vec<(String, Build)> = vec![
        ("2003 method, its rule (appendix 2.5)".into(), by_listed_rule),
        (format!("2003 method, by rigid motion over {} s", constants.rest_time), by_rigid_motion),
    ];
    cases.extend(ENGINE.iter().map(|column| (format!("engine, {}: asleep", column.name), column.build)));
    let results: Vec<(Vec<String>, Markup)> = cases
        .par_iter()
        .map(|(name, build)| {
            let result = measure(&scene, constants, (name, *build));
            bar.inc(1);
            result
        })
        .collect::<Result<_, Error>>()?;
    let (mut rows, pictures): (Vec<_>, Vec<_>) = results.into_iter().unzip();
    rows.insert(0, vec!["dissertation, Figure 6.22".into(), "12".into(), "6 of a tower at rest are not".into()]);
    let table = Table::new(["of 18 blocks, after 3 s", "disabled, mean", "in single frames"], rows);
    Ok(html! { (table) @for picture in pictures { (picture) } })
}
