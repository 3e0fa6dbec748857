//! The six static tests (section 6.1.1), before and after.

use glam::DVec3;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_scene::named;

use super::column::{COLUMNS, Column, FRAMES, Tower};
use super::page::table;
use super::picture;
use crate::error::Error;
use teeter_study::has_fallen;

/// The tests: scene, configuration, and what the dissertation says of the real tower and of its own.
pub const TESTS: [(&str, &str, bool); 6] = [
    ("test-1", "(010)-(010)-(010)-(010)-(010)-(010)", true),
    ("test-2", "(001)-(010)-(001)", true),
    ("test-3", "(001)-(101)-(001)", false),
    ("test-4", "(100)-(010)-(001)", false),
    ("test-5", "(010)-(010)-(011)", true),
    ("test-6", "(010)-(010)-(011)-(010)-(001)", true),
];

/// Experiments.
pub const STEPS: u64 = (TESTS.len() * COLUMNS.len()) as u64;

/// How long a tower has to stand, s.
const SECONDS: f64 = 5.0;

/// Whether a tower stands, and how far its blocks went at most, m. `look` sees it at the start and at the end.
pub fn stands(column: &Column, name: &str, mut look: impl FnMut(&dyn Tower)) -> Result<(bool, f64), Error> {
    let scene = named(name).ok_or_else(|| Error::Said(format!("there is no scene `{name}`")))?;
    let mut tower = (column.build)(&scene)?;
    let start = tower.centres();
    look(tower.as_ref());
    tower.rest((SECONDS * FRAMES) as u32);
    look(tower.as_ref());
    let moves =
        |of: fn(DVec3) -> f64| tower.centres().iter().zip(&start).map(|(now, was)| of(*now - *was)).fold(0.0, f64::max);
    let (moved, dropped) = (moves(DVec3::length), moves(|way| -way.z));
    Ok((!has_fallen(moved, dropped), moved))
}

/// Runs them.
pub fn run(bar: &ProgressBar) -> Result<String, Error> {
    let jobs: Vec<(usize, usize)> = (0..TESTS.len()).flat_map(|t| (0..COLUMNS.len()).map(move |c| (t, c))).collect();
    let results: Vec<(bool, f64, String)> = jobs
        .par_iter()
        .map(|&(t, c)| {
            let mut pictures = String::new();
            let column = &COLUMNS[c];
            let mut times = ["at the start", "after 5 s"].into_iter();
            let (stood, moved) = stands(column, TESTS[t].0, |tower| {
                let caption = format!("{}, {}", column.name, times.next().unwrap_or_default());
                pictures += &picture::of(tower, 0.11, false, &caption);
            })?;
            bar.inc(1);
            Ok((stood, moved, pictures))
        })
        .collect::<Result<_, Error>>()?;
    let word = |stable: bool| if stable { "stable" } else { "unstable" };
    let mut rows = Vec::new();
    let mut pictures = String::new();
    for (t, (_, configuration, printed)) in TESTS.iter().enumerate() {
        let mut row = vec![format!("{}: {configuration}", t + 1), word(*printed).to_owned()];
        pictures += &format!("<h3>Test {}: {configuration}</h3>", t + 1);
        for (_, (stood, moved, picture)) in jobs.iter().zip(&results).filter(|((test, _), _)| *test == t) {
            row.push(format!("{} ({}&nbsp;mm)", word(*stood), super::page::mm(*moved)));
            pictures += picture;
        }
        rows.push(row);
    }
    let head: Vec<&str> =
        ["test", "dissertation: real tower and its own"].into_iter().chain(COLUMNS.iter().map(|c| c.name)).collect();
    Ok(table(&head, &rows)
        + "<p>In brackets: how far a block went at most in 5 s. Test 2 is on a knife's edge: with blocks of the nominal size its upper two blocks are \
           0.15 mm short of balance, so that it falls, and a top block laid 1 mm further out stands.</p>"
        + &pictures)
}
