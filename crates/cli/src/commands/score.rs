//! `teeter score`: predictions for labelled towers, and their comparison with the labels.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use teeter_report::progress;
use teeter_report::score::{self, Labelled, MAX_UNPACKED, Summary};
use teeter_study::{Prediction, predict};

use crate::arguments::EngineArguments;
use crate::error::Error;
use crate::{input, output};

/// Arguments of `teeter score`.
#[derive(Debug, Args)]
pub struct Score {
    /// Scenes, one JSON object a line, compressed by gzip or not; `-` for standard input.
    scenes: PathBuf,
    /// File for the predictions, one JSON object a line [default: standard output].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    engine: EngineArguments,
    /// Summary as one JSON object on standard output; predictions are then written only to --out.
    #[arg(long)]
    json: bool,
}

/// Output file with its name.
struct Output {
    file: BufWriter<File>,
    name: String,
}

impl Output {
    fn create(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        match File::create(path) {
            Ok(file) => Ok(Self { file: BufWriter::new(file), name }),
            Err(source) => Err(Error::Create { name, source }),
        }
    }

    fn write(&mut self, lines: &[String]) -> Result<(), Error> {
        let written = lines.iter().try_for_each(|line| writeln!(self.file, "{line}"));
        written.and_then(|()| self.file.flush()).map_err(|source| Error::Write { name: self.name.clone(), source })
    }
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
        let mut out = self.out.as_deref().map(Output::create).transpose()?;
        let predictions = self.predict(&scenes)?;
        let lines: Vec<String> = predictions.iter().map(output::to_json).collect();
        match &mut out {
            Some(out) => out.write(&lines)?,
            None if self.json => {}
            None => lines.iter().try_for_each(|line| output::line(line))?,
        }
        let summary = Summary::of(&scenes, &predictions);
        if self.json {
            output::json(&summary)
        } else if out.is_some() {
            output::line(&summary.to_string())
        } else {
            // Standard output has the predictions.
            eprintln!("{summary}");
            Ok(())
        }
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
