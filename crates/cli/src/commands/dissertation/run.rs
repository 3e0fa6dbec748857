//! `teeter dissertation run`: simulates a scene by the method of 2003 and measures it.

use std::path::{Path, PathBuf};

use clap::Args;
use cpu_time::ThreadTime;
use teeter_dissertation::jenga3d::{Constants, Jenga3D};
use teeter_scene::{MAX_ROWS, Scene, TowerOptions, tower};

use super::constants::ConstantArguments;
use super::measurements::Measurements;
use crate::arguments::number;
use crate::error::Error;
use crate::output::Output;
use crate::warnings::Warnings;
use crate::{input, output};

/// Maximum time of a run, s.
const MAX_TIME: f64 = 86_400.0;

/// Arguments of `teeter dissertation run`.
#[derive(Debug, Args)]
pub struct Run {
    /// File of a scene, `-` for standard input, or the name of a scene of the list.
    #[arg(default_value = "tower")]
    scene: PathBuf,
    /// Rows of the tower, with the scene `tower` [default: 18].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_ROWS)))]
    rows: Option<u32>,
    /// Time to simulate, s.
    #[arg(long, default_value_t = 10.0, value_parser = number(0.02, MAX_TIME))]
    seconds: f64,
    #[command(flatten)]
    constants: ConstantArguments,
    /// Write the constants, each with its unit, range and reason, to this file instead of a run;
    /// `-` for standard output.
    #[arg(long, value_name = "FILE")]
    write_ini: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Simulates the scene and prints its report, or writes the constants.
    pub fn run(self) -> Result<(), Error> {
        if let Some(path) = &self.write_ini {
            return write_ini(path, &self.constants.constants(None)?);
        }
        if self.scene == Path::new("-") && self.constants.ini.as_ref() == Some(&self.scene) {
            return Err(Error::StdinTwiceIni);
        }
        let scene = self.read()?;
        let constants = self.constants.constants(Some(&scene))?;
        let frames = (self.seconds * constants.frame_rate).round().max(1.0) as u64;
        let mut jenga = Jenga3D::new(&scene, constants)
            .map_err(|source| Error::Dissertation { name: scene.name.clone(), source })?;
        let mut measurements = Measurements::new(&scene, &jenga);
        let mut warnings = Warnings::default();
        let clock = ThreadTime::now();
        for _ in 0..frames {
            let report = jenga.frame(None);
            if let Some(block) = jenga.first_non_finite() {
                let (id, time) = (scene.blocks[block].id, jenga.time);
                warnings.add(&format!("block {id} has no finite position after {time:.2} s: the run ends there"));
                measurements.end(block);
                break;
            }
            measurements.record(&jenga, &report);
        }
        let summary = measurements.summary(&scene, &jenga, clock.elapsed().as_secs_f64(), warnings);
        output::line(&if self.json { output::to_json(&summary) } else { summary.text(&scene) })
    }

    fn read(&self) -> Result<Scene, Error> {
        match self.rows {
            None => input::scene(&self.scene),
            Some(rows) if self.scene == Path::new("tower") => {
                Ok(tower(&TowerOptions { rows, ..TowerOptions::default() })?)
            }
            Some(_) => Err(Error::RowsOfScene { name: self.scene.display().to_string() }),
        }
    }
}

/// Writes constants as an ini file, and prints its path unless it is standard output.
fn write_ini(path: &Path, constants: &Constants) -> Result<(), Error> {
    let mut out = Output::create(path)?;
    out.line(constants.to_ini().trim_end())?;
    let is_file = !out.is_stdout();
    out.finish()?;
    if is_file { output::line(&path.display().to_string()) } else { Ok(()) }
}
