//! `teeter run`: simulates a scene and measures it.

mod recorder;
mod report;
mod simulation;

use std::path::{Path, PathBuf};

use clap::Args;
use teeter_physics::Params;
use teeter_scene::Scene;
use teeter_study::{MAX_CHANGE_TIME, Timeline};

use crate::arguments::{EngineArguments, number};
use crate::error::Error;
use crate::output::Output;
use crate::trace::Trace;
use crate::warnings::Warnings;
use crate::{input, output, world};
use simulation::Simulation;

/// Arguments of `teeter run`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Run {
    /// File of a scene, `-` for standard input, or the name of a scene of the list.
    scene: PathBuf,
    /// Time to simulate, s.
    #[arg(long, default_value_t = 10.0, value_parser = number(0.02, MAX_CHANGE_TIME))]
    seconds: f64,
    #[command(flatten)]
    engine: EngineArguments,
    /// Time over which gravity grows to its full value at the start, s; at 0, what touches carries
    /// its weight from the first instant.
    #[arg(long, default_value_t = Params::default().ramp, value_parser = number(0.0, 60.0), value_name = "SECONDS")]
    ramp: f64,
    /// Push overlapping blocks apart before the run, and say by how much.
    #[arg(long)]
    settle: bool,
    /// File of hands, forces, drives and gravity, one JSON object a line with the time from which
    /// it holds, see docs/inputs.md; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    inputs: Option<PathBuf>,
    /// Simulate every block in every frame: slower, and shows that rest does not depend on sleep.
    #[arg(long)]
    no_sleep: bool,
    /// File for the state at the end, as a scene that goes on from there; `-` for standard output,
    /// and the report is then printed to standard error.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// File for the pose and velocity of each block after each frame: a table, whose extension is
    /// .parquet, .csv or .jsonl, see docs/trace.md.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Frames from a row of the trace to the next of the same block.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1_000_000), requires = "trace")]
    trace_every: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Simulates the scene and prints its report.
    pub fn run(self) -> Result<(), Error> {
        if self.scene == Path::new("-") && self.inputs.as_ref() == Some(&self.scene) {
            return Err(Error::StdinTwice);
        }
        let mut warnings = Warnings::default();
        let scene = self.engine.material.apply(self.read(&mut warnings)?);
        let timeline = self.inputs.as_deref().map_or(Ok(Timeline::default()), |path| input::inputs(path, &scene))?;
        let params = Params { ramp: self.ramp, ..self.engine.params(!self.no_sleep) };
        let world = world::build(&scene, params)?;
        // Before the run, so that a missing folder is reported before minutes of work.
        let out = self.out.as_deref().map(Output::create).transpose()?;
        let trace = match &self.trace {
            Some(path) => Some(Trace::create(path, &scene, &world, self.trace_every)?),
            None => None,
        };
        warnings.add_all_of(&world);
        let mut simulation = Simulation::new(&scene, world, timeline, trace, warnings);
        simulation.run(self.seconds)?;
        let to_stdout = out.as_ref().is_some_and(Output::is_stdout);
        let report = simulation.finish(out)?;
        let text = if self.json { output::to_json(&report) } else { report.text(&scene) };
        output::report(&text, to_stdout)
    }

    fn read(&self, warnings: &mut Warnings) -> Result<Scene, Error> {
        if !self.settle {
            return input::scene(&self.scene);
        }
        let (scene, settlement) = input::settled_scene(&self.scene)?;
        if !settlement.moves.is_empty() {
            warnings.add(&settlement.to_string());
        }
        Ok(scene)
    }
}
