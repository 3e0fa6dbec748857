//! Figure 6.22: which blocks of a tower at rest are disabled, by the dissertation's rule and by others.

use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::{Constants, Disabling};
use teeter_scene::{Scene, TowerOptions, tower};

use super::column::{COLUMNS, ENGINE, Springs, Tower};
use super::page::table;
use super::picture;
use crate::error::Error;

/// Experiments.
pub const STEPS: u64 = 2 + ENGINE.len() as u64;

type Build = fn(&Scene) -> Result<Box<dyn Tower>, Error>;

/// Runs it.
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).map_err(|e| Error::Said(e.to_string()))?;
    let by_rigid_motion: Build =
        |scene| Ok(Box::new(Springs::new(scene, Constants { disabling: Disabling::Rigid, ..Constants::default() })?));
    let method = [
        ("2003 method, its rule (appendix 2.5)", COLUMNS[0].build),
        ("2003 method, by rigid motion over a quarter of a second", by_rigid_motion),
    ];
    let engine = ENGINE.iter().map(|column| (column.name, column.build));
    let cases: Vec<(String, Build)> = method
        .map(|(name, build)| (name.to_owned(), build))
        .into_iter()
        .chain(engine.map(|(name, build)| (format!("engine, {name}: asleep"), build)))
        .collect();
    let results: Vec<(Vec<String>, String)> = cases
        .par_iter()
        .map(|(name, build)| {
            let mut tower = build(&scene)?;
            tower.rest(180);
            // The rule looks at single steps: some frames tell more than one.
            let (mut sum, mut least, mut most) = (0, usize::MAX, 0);
            const LOOKS: usize = 30;
            for _ in 0..LOOKS {
                tower.frame(None);
                let resting = (0..tower.len()).filter(|b| tower.rests(*b)).count();
                (sum, least, most) = (sum + resting, least.min(resting), most.max(resting));
            }
            bar.inc(1);
            let row = vec![name.clone(), format!("{:.1}", sum as f64 / LOOKS as f64), format!("{least} to {most}")];
            Ok((row, picture::of(tower.as_ref(), 0.11, true, name)))
        })
        .collect::<Result<_, Error>>()?;
    let (mut rows, pictures): (Vec<_>, Vec<_>) = results.into_iter().unzip();
    rows.insert(0, vec!["dissertation, Figure 6.22".into(), "12".into(), "6 of a tower at rest are not".into()]);
    Ok(table(&["of 18 blocks, after 3 s", "disabled, mean", "in single frames"], &rows) + &pictures.concat())
}
