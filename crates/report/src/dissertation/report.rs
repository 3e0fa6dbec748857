//! `teeter dissertation report`: all of chapter 6, run and written as one page.

use std::fs;
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use rayon::prelude::*;

use super::page::{Section, page};
use super::{disabled, flat, frame_rate, moves, requirements, soft, statics, table_5_2};
use crate::error::Error;
use crate::progress;

/// A part of the chapter.
pub struct Part {
    /// Its name for `--only`.
    pub name: &'static str,
    /// Its heading.
    title: &'static str,
    /// Whether it measures time, and so runs alone.
    timed: bool,
    /// Steps of the bar of progress.
    steps: u64,
    /// Runs it.
    run: fn(&ProgressBar) -> Result<String, Error>,
}

const fn part(
    name: &'static str,
    title: &'static str,
    timed: bool,
    steps: u64,
    run: fn(&ProgressBar) -> Result<String, Error>,
) -> Part {
    Part { name, title, timed, steps, run }
}

/// The parts in the order of the page.
pub const PARTS: &[Part] = &[
    part("table-5.2", "Table 5.2: potential collisions after each test", false, table_5_2::STEPS, table_5_2::counts),
    part("culling", "Section 5.4.1: what culling saves", true, table_5_2::CULLING_STEPS, table_5_2::culling),
    part("static-tests", "Section 6.1.1: six static tests", false, statics::STEPS, statics::run),
    part("moves", "Section 6.1.2: twelve moves", false, moves::STEPS, moves::run),
    part("soft-springs", "Figure 6.21: a full tower on soft springs", false, soft::STEPS, soft::run),
    part("disabled", "Figure 6.22: disabled blocks", false, disabled::STEPS, disabled::run),
    part("frame-rate", "Figure 6.23: frame rate against rows", true, frame_rate::STEPS, frame_rate::run),
    part("chapter-2", "Chapters 2 and 3: the methods side by side in the plane", false, flat::STEPS, flat::run),
    part("requirements", "Section 3.6: the requirements", false, requirements::STEPS, requirements::run),
];

/// Runs the parts asked for and writes the page.
pub fn write(out: &Path, only: &[String]) -> Result<PathBuf, Error> {
    let wanted: Vec<&Part> =
        PARTS.iter().filter(|p| only.is_empty() || only.iter().any(|name| name == p.name)).collect();
    let name = out.display().to_string();
    // Made first: a folder that cannot be written is better said now than in ten minutes.
    fs::create_dir_all(out).map_err(|e| Error::at(&name, format!("this folder cannot be made: {e}")))?;
    let path = out.join("index.html");
    fs::write(&path, "").map_err(|e| Error::at(&path.display().to_string(), format!("cannot be written: {e}")))?;

    let bar = progress(wanted.iter().map(|p| p.steps).sum(), "experiments");
    bar.tick();
    let mut sections: Vec<Option<Section>> = vec![None; wanted.len()];
    let run = |part: &Part| Ok::<_, Error>(Section { title: part.title, html: (part.run)(&bar)? });
    // One core for what measures time, and nothing beside it.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| Error::Said(e.to_string()))?;
    for (section, part) in sections.iter_mut().zip(&wanted).filter(|(_, p)| p.timed) {
        *section = Some(alone.install(|| run(part))?);
    }
    sections.par_iter_mut().zip(&wanted).filter(|(_, p)| !p.timed).try_for_each(|(section, part)| {
        *section = Some(run(part)?);
        Ok::<(), Error>(())
    })?;
    bar.finish_and_clear();
    let sections: Vec<Section> = sections.into_iter().flatten().collect();
    fs::write(&path, page(&sections))
        .map_err(|e| Error::at(&path.display().to_string(), format!("cannot be written: {e}")))?;
    Ok(path)
}
