//! `teeter score`: predictions for labelled towers, and their comparison with the labels.

use std::path::PathBuf;

use clap::Args;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use teeter_report::progress;
use teeter_report::score::{self, Labelled, MAX_UNPACKED, Summary};
use teeter_study::{Prediction, predict};

use crate::arguments::EngineArguments;
use crate::error::Error;
use crate::output::Output;
use crate::{input, output};

/// Arguments of `teeter score`.
#[derive(Debug, Args)]
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
        let predictions = self.predict(&scenes)?;
        let to_stdout = out.as_ref().is_some_and(Output::is_stdout);
        if let Some(mut out) = out {
            predictions.iter().try_for_each(|prediction| out.line(&output::to_json(prediction)))?;
            out.finish()?;
        }
        let summary = Summary::of(&scenes, &predictions);
        let text = if self.json { output::to_json(&summary) } else { summary.to_string() };
        output::report(&text, to_stdout)
    }

    fn predict(&self, scenes: &[Labelled]) -> Result<Vec<Prediction>, Error> {
        let params = self.engine.params(false);
        let bar = progress(scenes.len() as u64, "scenes");
        let predictions = scenes
            .par_iter()
            .progress_with(bar.clone())
            .map(|labelled| {
                let scene = &labelled.scene;
                predict(scene, params).map_err(|source| Error::Build { name: scene.name.clone(), source })
            })
            .collect::<Result<_, _>>()?;
        bar.finish_and_clear();
        Ok(predictions)
    }
}
