//! Chapter of results of the 2003 dissertation, run again: its own figures, those of its method,
//! and those of the engine.

mod backend;
mod column;
mod constants_note;
mod cost;
mod disabled;
mod engine;
mod fewer_springs;
mod frame_rate;
mod length;
mod moves;
mod oriented_box;
mod overlap;
mod part;
mod parts;
mod picture;
mod plane_methods;
mod played;
mod requirements;
mod rounds;
mod soft_springs;
mod springs;
mod static_tests;
mod step_size;
mod table_5_2;
mod tower;

use std::fs;
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use maud::html;
use rayon::prelude::*;
use teeter_dissertation::jenga3d::Constants;

use crate::error::Error;
use crate::output::{create_file, create_folder, progress, write_file};
use crate::page::{Page, PageSection};
use constants_note::note;
use part::{Inputs, Part};
use parts::PARTS;
use tower::FRAME_RATE;

/// Names of the parts of the report, in the order of the page.
pub fn part_names() -> impl Iterator<Item = &'static str> {
    PARTS.iter().map(|part| part.name)
}

/// Runs the parts named, all where none is, writes them as `index.html` into a folder and returns
/// the path of the page. The constants are those of the 2003 method; their gravity and friction are
/// those of the engine as well, and a part says where they are not the defaults.
///
/// The other parts of a page that is there stay, marked as those of an earlier run. The page
/// appears whole or not at all: until then the one before stays.
///
/// # Errors
/// When the frame rate is not that of the report, a scene cannot be built or the page cannot be
/// written.
pub fn write(out: &Path, only: &[String], constants: &Constants) -> Result<PathBuf, Error> {
    if constants.frame_rate != FRAME_RATE {
        return Err(Error::FrameRate(constants.frame_rate));
    }
    let parts: Vec<&Part> =
        PARTS.iter().filter(|part| only.is_empty() || only.iter().any(|name| name == part.name)).collect();
    write_parts(out, &parts, constants)
}

fn write_parts(out: &Path, parts: &[&Part], constants: &Constants) -> Result<PathBuf, Error> {
    create_folder(out)?;
    let path = out.join("index.html");
    // Now, so that a folder without permission is reported before minutes of experiments.
    drop(create_file(&path)?);
    let mut sections = run(parts, constants)?;
    let before = fs::read_to_string(&path).unwrap_or_default();
    let is_new = |id: &str| parts.iter().any(|part| part.name == id);
    sections.extend(PageSection::kept_from(&before).into_iter().filter(|section| !is_new(&section.id)));
    let index = |section: &PageSection| PARTS.iter().position(|part| part.name == section.id);
    sections.sort_by_key(index);
    write_file(&path, &page(sections).html())?;
    Ok(path)
}

/// Runs parts: first those that measure time, one by one on one thread, then the moves where a part
/// needs them, then all experiments in parallel.
fn run(parts: &[&Part], constants: &Constants) -> Result<Vec<PageSection>, Error> {
    let needs_moves = parts.iter().any(|part| part.moves);
    let steps: u64 = parts.iter().map(|part| part.steps).sum();
    let bar = progress(steps + if needs_moves { moves::STEPS } else { 0 }, "experiments");
    bar.tick();
    let times = time(parts, constants, &bar)?;
    let played = if needs_moves { moves::play_columns(constants, &bar)? } else { Vec::new() };
    let sections = parts
        .par_iter()
        .zip(&times)
        .map(|(part, times)| {
            let played = if part.moves { played.as_slice() } else { &[] };
            let content = (part.run)(Inputs { constants, bar: &bar, times, played })?;
            let content = html! { (note(constants, part.constants)) (content) };
            Ok(PageSection::new(part.name, part.title, content))
        })
        .collect::<Result<_, Error>>()?;
    bar.finish_and_clear();
    Ok(sections)
}

/// Returns the times of each part, measured on one thread.
fn time(parts: &[&Part], constants: &Constants, bar: &ProgressBar) -> Result<Vec<Vec<f64>>, Error> {
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    single
        .install(|| parts.iter().map(|part| part.clock.map_or(Ok(Vec::new()), |clock| clock(constants, bar))).collect())
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

#[cfg(test)]
mod tests {
    use super::part::Usage;
    use super::*;

    fn part(name: &'static str, run: fn(Inputs) -> Result<maud::Markup, Error>) -> Part {
        Part { name, title: "Title", steps: 0, clock: None, moves: false, constants: Usage::All, run }
    }

    fn files(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_part_that_fails_leaves_the_page_before_and_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("index.html");
        fs::write(&path, "the page before").unwrap();
        let failing = part("moves", |_| Err(Error::NoPulls));
        write_parts(folder.path(), &[&failing], &Constants::default()).unwrap_err();
        assert_eq!(fs::read_to_string(&path).unwrap(), "the page before");
        assert_eq!(files(folder.path()), ["index.html"]);
    }

    /// While the experiments run, the folder holds the page before and no other file: a run that is
    /// killed leaves just that.
    #[test]
    fn nothing_is_written_before_the_experiments_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("index.html");
        fs::write(&path, "the page before").unwrap();
        let times = time(&[&part("moves", |_| Ok(html! {}))], &Constants::default(), &ProgressBar::hidden()).unwrap();
        assert_eq!(times, [Vec::<f64>::new()]);
        static SEEN: std::sync::Mutex<Vec<String>> = std::sync::Mutex::new(Vec::new());
        static FOLDER: std::sync::OnceLock<PathBuf> = std::sync::OnceLock::new();
        FOLDER.set(folder.path().to_owned()).unwrap();
        let observing = part("moves", |_| {
            *SEEN.lock().unwrap() = files(FOLDER.get().unwrap());
            Ok(html! {})
        });
        write_parts(folder.path(), &[&observing], &Constants::default()).unwrap();
        assert_eq!(*SEEN.lock().unwrap(), ["index.html"]);
        assert!(fs::read_to_string(&path).unwrap().contains("<section id=\"moves\">"));
    }

    #[test]
    fn parts_that_run_one_by_one_make_one_page_in_its_order() {
        let folder = tempfile::tempdir().unwrap();
        let one =
            |name: &'static str, run| write_parts(folder.path(), &[&part(name, run)], &Constants::default()).unwrap();
        one("moves", |_| Ok(html! { p { "one and only" } }));
        one("table-5.2", |_| Ok(html! { p { "of the table" } }));
        let path = one("moves", |_| Ok(html! { p { "once more" } }));
        let page = fs::read_to_string(path).unwrap();
        let order = ["<section id=\"table-5.2\">", "of the table", "<section id=\"moves\">", "once more"];
        let found: Vec<usize> = order.iter().map(|text| page.find(text).unwrap()).collect();
        assert!(found.is_sorted(), "{page}");
        assert!(!page.contains("one and only"));
        assert_eq!(page.matches("earlier run").count(), 1, "{page}");
    }
}
