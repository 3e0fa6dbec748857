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

use crate::args::Validate;
use crate::fault::Fault;
use crate::output;
use section::{Section, Size};
pub use topics::Topic;

/// Measures what was asked for and writes `validation.html` and `validation.json` into the folder.
pub fn main(args: Validate) -> Result<(), Fault> {
    let real = args.real.as_deref().map(real::read).transpose()?;
    fs::create_dir_all(&args.out)
        .map_err(|e| Fault::at(&args.out.display().to_string(), format!("cannot be made a folder: {e}")))?;
    let size = Size::of(&args);
    // a data sheet alone asks for nothing else
    let topics: Vec<Topic> = match (&args.only[..], &real) {
        ([], Some(_)) => Vec::new(),
        ([], None) => Topic::ALL.to_vec(),
        (only, _) => Topic::ALL.into_iter().filter(|t| only.contains(t)).collect(),
    };
    let mut sections: Vec<Section> = Vec::new();
    if let Some(sheet) = &real {
        sections.push(real::section(sheet, &size)?);
    }
    for topic in topics {
        sections.push(topic.measure(&size)?);
        // written after each, so that a run that is cut short leaves what it has
        write(&args.out, &size, &sections)?;
    }
    write(&args.out, &size, &sections)?;
    for section in &sections {
        output::line(section.title)?;
        for figure in &section.figures {
            let goal = figure.goal.as_deref().map_or(String::new(), |goal| format!(" (goal {goal})"));
            let mark = match figure.met {
                Some(true) => "ok    ",
                Some(false) => "MISSED",
                None => "      ",
            };
            output::line(&format!("  {mark} {}: {}{goal}", figure.what, figure.value))?;
        }
    }
    output::line(&format!("{}", args.out.join("validation.html").display()))
}

fn write(out: &Path, size: &Size, sections: &[Section]) -> Result<(), Fault> {
    let all: Value = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "size": size,
        "sections": sections.iter().map(Section::json).collect::<Vec<_>>(),
    });
    let save = |name: &str, text: String| {
        let file = out.join(name);
        fs::write(&file, text).map_err(|e| Fault::at(&file.display().to_string(), format!("cannot be written: {e}")))
    };
    save("validation.json", serde_json::to_string_pretty(&all).expect("plain data has JSON") + "\n")?;
    save("validation.html", html::page(size, sections))
}
