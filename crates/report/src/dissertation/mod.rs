//! Chapter of results of the 2003 dissertation, run again: its own figures, those of its method,
//! and those of the engine.

mod backend;
mod column;
mod cost;
mod disabled;
mod engine;
mod frame_rate;
mod length;
mod moves;
mod parts;
mod picture;
mod plane_methods;
mod requirements;
mod soft_springs;
mod springs;
mod static_tests;
mod table_5_2;
mod tower;

use std::path::{Path, PathBuf};

use maud::html;
use rayon::prelude::*;

use crate::error::Error;
use crate::output::{create_file, create_folder, finish_file, progress};
use crate::page::{Page, PageSection};
use parts::{PARTS, Part};

/// Names of the parts of the report, in the order of the page.
pub fn part_names() -> impl Iterator<Item = &'static str> {
    PARTS.iter().map(|part| part.name)
}

/// Runs the parts named, all where none is, writes them as `index.html` into a folder and returns
/// the path of the page.
///
/// # Errors
/// When a scene cannot be built or the page cannot be written.
pub fn write(out: &Path, only: &[String]) -> Result<PathBuf, Error> {
    let parts: Vec<&Part> =
        PARTS.iter().filter(|part| only.is_empty() || only.iter().any(|name| name == part.name)).collect();
    create_folder(out)?;
    let path = out.join("index.html");
    // Now, so that a folder without permission is reported before minutes of experiments.
    let file = create_file(&path)?;
    finish_file(file, &path, &page(run(&parts)?).html())?;
    Ok(path)
}

/// Runs parts in parallel, except those that measure time: they run first, one by one on one
/// thread.
fn run(parts: &[&Part]) -> Result<Vec<PageSection>, Error> {
    let bar = progress(parts.iter().map(|part| part.steps).sum(), "experiments");
    bar.tick();
    let mut sections: Vec<Option<PageSection>> = vec![None; parts.len()];
    let section = |part: &Part| {
        let (id, title) = (part.name.to_owned(), part.title.to_owned());
        Ok::<_, Error>(Some(PageSection { id, title, content: (part.run)(&bar)? }))
    };
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    for (slot, part) in sections.iter_mut().zip(parts).filter(|(_, part)| part.timed) {
        *slot = single.install(|| section(part))?;
    }
    sections.par_iter_mut().zip(parts).filter(|(_, part)| !part.timed).try_for_each(|(slot, part)| {
        *slot = section(part)?;
        Ok::<(), Error>(())
    })?;
    bar.finish_and_clear();
    Ok(sections.into_iter().flatten().collect())
}

fn page(sections: Vec<PageSection>) -> Page {
    let introduction = html! {
        p {
            "The results of chapter 6 of \"A Real-Time Physics Simulator for Jenga\" (Matthew \
             South, 2003), run again: the dissertation's own figures, those of its method in a new \
             implementation, and those of the engine of Teeter. Lengths are in millimetres, times \
             are those of one core."
        }
        p {
            i { "2003 method" } " is the method as described; " i { "2003 with 6.3" } " adds the \
                future work of section 6.3, static friction and rest by the motion of a whole \
                block. " i { "Lattice" } " and " i { "rigid" } " are the engine, with blocks of \
                eight particles and 28 springs, and with rigid ones."
        }
    };
    Page { title: "The dissertation's results, again".into(), introduction, sections }
}
