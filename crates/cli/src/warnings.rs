//! Warnings of a command.

use serde::Serialize;
use teeter_game::engine_id;
use teeter_physics::{StepReport, World};
use teeter_scene::{Scene, printable};
use teeter_study::Timeline;

use crate::message::message;

/// Warnings of a command: printed to standard error as they come, a line each, and listed in its
/// report.
#[derive(Debug, Default, Serialize)]
#[serde(transparent)]
pub struct Warnings(Vec<String>);

impl Warnings {
    /// Prints a warning and adds it.
    pub fn add(&mut self, text: &str) {
        let line = printable(text);
        message(&format!("warning: {line}"));
        self.0.push(line);
    }

    /// Adds the warnings of a world.
    pub fn add_all_of(&mut self, world: &World) {
        world.warnings().iter().for_each(|warning| self.add(&warning.to_string()));
    }

    /// Adds a warning for each block of `scene` that was frozen in a step.
    pub fn add_quarantined(&mut self, scene: &Scene, step: &StepReport) {
        for body in &step.quarantined {
            let (id, time) = (scene.blocks[body.index()].id, step.time);
            self.add(&format!("block {id} ran away at {time:.2} s and was frozen there"));
        }
    }

    /// Adds a warning for a record of another engine, and what follows from that.
    pub fn add_engine(&mut self, engine: &str, consequence: &str) {
        self.add(&format!("the record is of engine {engine}, and this is {}: {consequence}", engine_id()));
    }

    /// Adds a warning for inputs that begin after the end of a run.
    pub fn add_pending(&mut self, timeline: &Timeline) {
        let [first, ..] = timeline.pending() else { return };
        let changes = match timeline.pending().len() {
            1 => "1 change of the inputs begins".into(),
            count => format!("{count} changes of the inputs begin"),
        };
        self.add(&format!("{changes} after the end of the run, the first at {} s", first.time));
    }
}
