//! Warnings of a command.

use serde::Serialize;
use teeter_physics::World;
use teeter_scene::printable;

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
}
