//! `teeter validate`: the engine against exact mechanics, as a page.

use teeter_report::validation::{self, Options, Size};
use teeter_scene::{MAX_BYTES, read_text};

use crate::args::Validate;
use crate::fault::Fault;
use crate::{input, output};

/// Measures what was asked for, writes the page and prints the figures.
pub fn main(args: Validate) -> Result<(), Fault> {
    let sheet = args.real.as_deref().map(sheet).transpose()?;
    let size = Size::of(&Options {
        quick: args.quick,
        form: args.form,
        towers: args.towers,
        seed: args.seed,
        hours: args.hours,
        yanks: args.yanks,
    });
    for section in validation::run(&args.out, &size, &args.only, sheet.as_ref())? {
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

/// Reads a data sheet.
fn sheet(path: &std::path::Path) -> Result<validation::Sheet, Fault> {
    let source = input::open(path, MAX_BYTES)?;
    let text = read_text(source.reader, MAX_BYTES).map_err(|e| Fault::at(&source.name, e))?;
    validation::parse(&text).map_err(|e| Fault::at(&source.name, e))
}
