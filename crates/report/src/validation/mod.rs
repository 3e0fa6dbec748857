//! `teeter validate`: everything that is known exactly, or by measurement, against what the engine does; one page with figures and plots.

mod html;
mod plot;
mod real;
mod section;
mod stats;
mod topics;

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::error::Error;
pub use real::{Sheet, parse};
pub use section::{Options, Section, Size};
pub use topics::Topic;

/// Measures what was asked for and writes `validation.html` and `validation.json` into the folder.
pub fn run(out: &Path, size: &Size, only: &[Topic], real: Option<&Sheet>) -> Result<Vec<Section>, Error> {
    fs::create_dir_all(out)
        .map_err(|e| Error::at(&out.display().to_string(), format!("cannot be made a folder: {e}")))?;
    // a data sheet alone asks for nothing else
    let topics: Vec<Topic> = match (only, real) {
        ([], Some(_)) => Vec::new(),
        ([], None) => Topic::ALL.to_vec(),
        (only, _) => Topic::ALL.into_iter().filter(|t| only.contains(t)).collect(),
    };
    let mut sections: Vec<Section> = Vec::new();
    if let Some(sheet) = real {
        sections.push(real::section(sheet, size)?);
    }
    for topic in topics {
        sections.push(topic.measure(size)?);
        // written after each, so that a run that is cut short leaves what it has
        write(out, size, &sections)?;
    }
    write(out, size, &sections)?;
    Ok(sections)
}

fn write(out: &Path, size: &Size, sections: &[Section]) -> Result<(), Error> {
    let all: Value = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "size": size,
        "sections": sections.iter().map(Section::json).collect::<Vec<_>>(),
    });
    let save = |name: &str, text: String| {
        let file = out.join(name);
        fs::write(&file, text).map_err(|e| Error::at(&file.display().to_string(), format!("cannot be written: {e}")))
    };
    save("validation.json", serde_json::to_string_pretty(&all).expect("plain data has JSON") + "\n")?;
    save("validation.html", html::page(size, sections))
}
