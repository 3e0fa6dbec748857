//! Simulation: a world, the inputs that act on it, and its measurements.

use cpu_time::ProcessTime;
use teeter_physics::World;
use teeter_report::progress;
use teeter_scene::Scene;
use teeter_study::Timeline;

use super::recorder::Recorder;
use super::report::Report;
use crate::error::Error;
use crate::output::{self, Output};
use crate::trace::Trace;
use crate::warnings::Warnings;

/// World with the inputs that act on it, and all that is recorded of it.
pub struct Simulation<'a> {
    scene: &'a Scene,
    world: World,
    timeline: Timeline,
    trace: Option<Trace>,
    warnings: Warnings,
    recorder: Recorder,
    /// Processor time of the steps, s.
    cpu_s: f64,
}

impl<'a> Simulation<'a> {
    /// Prepares a simulation of `world`, which was built from `scene`.
    pub fn new(scene: &'a Scene, world: World, timeline: Timeline, trace: Option<Trace>, warnings: Warnings) -> Self {
        let recorder = Recorder::new(scene, &world);
        Self { scene, world, timeline, trace, warnings, recorder, cpu_s: 0.0 }
    }

    /// Steps the world for a time, s.
    pub fn run(&mut self, seconds: f64) -> Result<(), Error> {
        let frames = (seconds / self.world.params().frame).round().max(1.0) as u64;
        let bar = progress(frames, "frames");
        self.trace()?;
        for _ in 0..frames {
            let input = self.timeline.input(&self.world);
            let held = input.hand.as_ref().map(|hand| hand.body);
            let clock = ProcessTime::now();
            let step = self.world.step(input);
            self.cpu_s += clock.elapsed().as_secs_f64();
            if !step.quarantined.is_empty() {
                bar.suspend(|| self.warnings.add_quarantined(self.scene, &step));
            }
            self.recorder.record(&self.world, &step, held);
            self.trace()?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    /// Finishes the trace, writes the state at the end and returns the report.
    pub fn finish(mut self, out: Option<Output>) -> Result<Report, Error> {
        self.trace.take().map_or(Ok(()), Trace::finish)?;
        self.warnings.add_pending(&self.timeline);
        let doubts = [self.recorder.energy_warning(), self.recorder.depth_warning(self.scene)];
        doubts.iter().flatten().for_each(|warning| self.warnings.add(warning));
        if let Some(mut out) = out {
            let end = self.world.to_scene();
            if let Err(error) = end.validate() {
                let remedy = "`teeter run --settle` reads it and pushes blocks apart";
                self.warnings.add(&format!("the state at the end is not a valid scene: {error}; {remedy}"));
            }
            out.line(&output::to_json(&end))?;
            out.finish()?;
        }
        Ok(self.recorder.report(self.scene, &self.world, self.cpu_s, self.warnings))
    }

    fn trace(&mut self) -> Result<(), Error> {
        self.trace.as_mut().map_or(Ok(()), |trace| trace.record(&self.world))
    }
}
