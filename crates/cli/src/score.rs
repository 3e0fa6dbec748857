//! `teeter score`: predictions for labelled towers, and how good they are.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use teeter_report::score::{self, Labelled, Summary};
use teeter_study::{Prediction, predict};

use crate::args::Score;
use crate::fault::Fault;
use crate::{input, output};

/// Predicts every scene of a file, on all cores, in the file's order.
pub fn main(args: Score) -> Result<(), Fault> {
    let source = input::open(&args.scenes, score::MAX_TOTAL)?;
    let scenes: Vec<Labelled> = score::read(source.reader, &source.name)?
        .into_iter()
        .map(|s| Labelled { scene: args.engine.material.applied(s.scene), ..s })
        .collect();
    // Opened first: a folder that is missing is better said now than in ten minutes.
    let mut out = args.out.as_deref().map(create).transpose()?;
    let params = args.engine.params(false);
    let bar = output::progress(scenes.len() as u64, "scenes");
    let predictions: Vec<Prediction> = scenes
        .par_iter()
        .progress_with(bar.clone())
        .map(|s| predict(&s.scene, params).map_err(|e| Fault::at(&s.scene.name, e)))
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();

    for prediction in &predictions {
        let line = output::json(prediction);
        match &mut out {
            Some((file, name)) => writeln!(file, "{line}").map_err(|e| Fault::at(name, e))?,
            None if args.json => {}
            None => output::line(&line)?,
        }
    }
    if let Some((file, name)) = &mut out {
        file.flush().map_err(|e| Fault::at(name, e))?;
    }
    let summary = Summary::of(&scenes, &predictions);
    if args.json {
        output::line(&output::json(&summary))
    } else if out.is_some() {
        output::line(&summary.to_string())
    } else {
        // Standard output holds the predictions.
        eprintln!("{summary}");
        Ok(())
    }
}

fn create(path: &Path) -> Result<(BufWriter<File>, String), Fault> {
    let name = path.display().to_string();
    match File::create(path) {
        Ok(file) => Ok((BufWriter::new(file), name)),
        Err(e) => Err(Fault::at(&name, format!("cannot be written: {e}"))),
    }
}
