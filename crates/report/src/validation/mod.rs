//! Report on the engine against exact mechanics and against measurements of real towers.

mod data_sheet;
mod real_rows;
mod real_tower;
mod row_agreement;
mod section;
mod size;
mod topics;

use std::path::Path;

use maud::html;
use serde_json::{Map, Value, json};
use teeter_scene::Form;

pub use data_sheet::{DataSheet, DataSheetError};
pub use real_rows::{RealRows, RealRowsError};
pub use section::{Figure, Section};
pub use size::{Options, Size};
pub use topics::Topic;

use crate::error::Error;
use crate::output::{create_folder, write_file};
use crate::page::Page;

/// Measurements of a real set.
#[derive(Debug)]
pub enum RealSet {
    /// Breakaway forces of the blocks of a tower.
    Sheet(DataSheet),
    /// Loose blocks of the rows of several towers.
    Rows(RealRows),
}

/// Measures `topics`, all where none is named, and writes `validation.html` and `validation.json`
/// into a folder where one is given. With a real set only that and the topics named are measured.
///
/// # Errors
/// When a scene cannot be built, a sheet has no measured forces, or a file cannot be written.
pub fn run(out: Option<&Path>, size: &Size, topics: &[Topic], real: Option<&RealSet>) -> Result<Vec<Section>, Error> {
    out.map(create_folder).transpose()?;
    let write = |sections: &[Section]| out.map_or(Ok(()), |out| write(out, size, sections));
    let all = topics.is_empty() && real.is_none();
    let mut sections: Vec<Section> = Vec::new();
    match real {
        Some(RealSet::Sheet(sheet)) => sections.push(real_tower::measure(sheet)?),
        Some(RealSet::Rows(rows)) => sections.push(row_agreement::measure(rows, size)?),
        None => {}
    }
    for topic in Topic::ALL.into_iter().filter(|topic| all || topics.contains(topic)) {
        sections.push(topic.measure(size)?);
        // After each topic, so that an interrupted run leaves what it has measured.
        write(&sections)?;
    }
    write(&sections)?;
    Ok(sections)
}

/// Returns the results of the topics for programs: of each whether its goals are met, and its
/// figures as numbers.
pub fn summary(sections: &[Section]) -> Value {
    let of = |section: &Section| json!({"met": section.is_met(), "figures": section.numbers_json()});
    sections.iter().map(|section| (section.name.to_owned(), of(section))).collect::<Map<_, _>>().into()
}

fn write(out: &Path, size: &Size, sections: &[Section]) -> Result<(), Error> {
    let data: Value = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "size": size,
        "sections": sections.iter().map(Section::json).collect::<Vec<_>>(),
    });
    let text = serde_json::to_string_pretty(&data).expect("the data are strings, numbers and lists") + "\n";
    write_file(&out.join("validation.json"), &text)?;
    write_file(&out.join("validation.html"), &page(size, sections).html())
}

fn page(size: &Size, sections: &[Section]) -> Page {
    let form = match size.form {
        Form::Rigid => "rigid",
        Form::Lattice => "lattice",
    };
    let introduction = html! {
        p {
            "Version " (env!("CARGO_PKG_VERSION")) ", " (size.towers) " towers of " (size.rows) " \
             rows of each kind from seed "
            (size.seed) ", " (form) " blocks"
            @if size.quick { ", the small size that only shows that everything runs" }
            ". Nothing sleeps. All figures are in " a href="validation.json" { "validation.json" } "."
        }
        table.words {
            thead { tr { th { "figure" } th { "measured" } th { "goal" } th {} } }
            @for section in sections { (section.summary()) }
        }
    };
    Page { title: "Teeter: validation".into(), introduction, sections: sections.iter().map(Section::html).collect() }
}
