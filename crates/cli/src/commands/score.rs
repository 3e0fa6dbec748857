//! `teeter score`: predictions for labelled towers, and their comparison with the labels.

use std::mem::discriminant;
use std::path::PathBuf;

use clap::Args;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;
use teeter_physics::Warning;
use teeter_report::progress;
use teeter_report::score::{self, Labelled, MAX_UNPACKED, Summary};
use teeter_study::{Prediction, predict};

use crate::arguments::EngineArguments;
use crate::error::Error;
use crate::output::Output;
use crate::warnings::Warnings;
use crate::{input, output};

/// Arguments of `teeter score`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Score {
    /// Scenes, one JSON object a line, compressed by gzip or not; `-` for standard input.
    scenes: PathBuf,
    /// File for the predictions, one JSON object a line; `-` for standard output, and the summary
    /// is then printed to standard error [default: standard output].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    engine: EngineArguments,
    /// Summary as one JSON object on standard output; predictions are then written only to --out.
    #[arg(long)]
    json: bool,
}

/// Report as JSON.
#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    summary: Summary,
    warnings: Warnings,
}

impl Score {
    /// Predicts every scene of a file, on all cores, in the order of the file.
    pub fn run(self) -> Result<(), Error> {
        let source = input::open(&self.scenes, MAX_UNPACKED)?;
        let scenes: Vec<Labelled> = score::read(source.reader, &source.name)?
            .into_iter()
            .map(|labelled| Labelled { scene: self.engine.material.apply(labelled.scene), ..labelled })
            .collect();
        // Before the predictions, so that a missing folder is reported before minutes of work.
        let out = match &self.out {
            Some(path) => Some(Output::create(path)?),
            None if self.json => None,
            None => Some(Output::Stdout),
        };
        let (predictions, found): (Vec<Prediction>, Vec<_>) = self.predict(&scenes)?.into_iter().unzip();
        let warnings = warnings(&scenes, &found);
        let to_stdout = out.as_ref().is_some_and(Output::is_stdout);
        if let Some(mut out) = out {
            predictions.iter().try_for_each(|prediction| out.line(&output::to_json(prediction)))?;
            out.finish()?;
        }
        let summary = Summary::of(&scenes, &predictions);
        let text = if self.json { output::to_json(&Report { summary, warnings }) } else { summary.to_string() };
        output::report(&text, to_stdout)
    }

    fn predict(&self, scenes: &[Labelled]) -> Result<Vec<(Prediction, Vec<Warning>)>, Error> {
        let params = self.engine.params(false);
        let bar = progress(scenes.len() as u64, "scenes");
        let predictions = scenes
            .par_iter()
            .progress_with(bar.clone())
            .map(|labelled| {
                let scene = &labelled.scene;
                let prediction = predict(scene, params);
                let prediction = prediction.map_err(|source| Error::Build { name: scene.name.clone(), source })?;
                Ok((prediction, Warning::all_of(scene)))
            })
            .collect::<Result<_, Error>>()?;
        bar.finish_and_clear();
        Ok(predictions)
    }
}

/// Prints the warnings about the scenes, one of each kind with the number of scenes that have it.
fn warnings(scenes: &[Labelled], found: &[Vec<Warning>]) -> Warnings {
    let mut kinds: Vec<(&Warning, &str, usize)> = Vec::new();
    for (labelled, warning) in scenes.iter().zip(found).flat_map(|(scene, all)| all.iter().map(move |one| (scene, one)))
    {
        match kinds.iter_mut().find(|(first, ..)| discriminant(*first) == discriminant(warning)) {
            Some((.., count)) => *count += 1,
            None => kinds.push((warning, &labelled.scene.name, 1)),
        }
    }
    let mut warnings = Warnings::default();
    for (warning, name, count) in kinds {
        let more = if count == 1 {
            String::new()
        } else {
            format!(" ({count} of {} scenes have such a warning)", scenes.len())
        };
        warnings.add(&format!("{name}: {warning}{more}"));
    }
    warnings
}
