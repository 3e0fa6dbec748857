//! Topics of the report, a file each.

mod closed;
mod collapses;
mod extraction;
mod forces;
mod labelled;
mod loose;
mod placing;
mod put_back;
mod range;
mod removal;
mod rest;
mod rotation;
mod tilt;

use super::section::Section;
use super::size::Size;
use crate::error::Error;

/// Topic of the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// Motions of one block or a column that have a formula.
    Closed,
    /// Stability of labelled towers.
    Labelled,
    /// Collapse angles of labelled towers.
    Tilt,
    /// Breakaway force of each block.
    Forces,
    /// Rotation of a tower above a tight block that is pulled.
    Rotation,
    /// Share of loose blocks by the scatter of heights.
    Loose,
    /// Long rest.
    Rest,
    /// Legal single removals.
    Removal,
    /// Loose blocks taken out by the hand.
    Extraction,
    /// Loose blocks drawn out and pushed in again.
    PutBack,
    /// Blocks placed and dropped on top.
    Placing,
    /// Blocks torn out of a tower.
    Collapses,
    /// Block presets, friction and stiffness.
    Range,
}

impl Topic {
    /// All topics, in the order of the report.
    pub const ALL: [Topic; 13] = [
        Topic::Closed,
        Topic::Labelled,
        Topic::Tilt,
        Topic::Forces,
        Topic::Rotation,
        Topic::Loose,
        Topic::Removal,
        Topic::Extraction,
        Topic::PutBack,
        Topic::Placing,
        Topic::Collapses,
        Topic::Range,
        Topic::Rest,
    ];

    /// Short name, as of its section.
    pub fn name(self) -> &'static str {
        self.description().0
    }

    /// Short description, for help.
    pub fn summary(self) -> &'static str {
        self.description().1
    }

    fn description(self) -> (&'static str, &'static str) {
        match self {
            Topic::Closed => ("closed", "Falls, slides, spins, impacts and pushes against closed forms"),
            Topic::Labelled => ("labelled", "Stability of towers with known answers"),
            Topic::Tilt => ("tilt", "Tilt at which towers with known answers collapse"),
            Topic::Forces => ("forces", "Breakaway force of each block, against rigid blocks"),
            Topic::Rotation => ("turning", "Rotation of a tower above a tight block that is pulled"),
            Topic::Loose => ("loose", "Share of loose blocks by the scatter of heights"),
            Topic::Rest => ("rest", "Long rest"),
            Topic::Removal => ("removal", "Every legal single removal"),
            Topic::Extraction => ("extraction", "Loose blocks taken out by the hand"),
            Topic::PutBack => ("put-back", "Loose blocks drawn out and pushed in again"),
            Topic::Placing => ("placing", "Blocks placed and dropped on top"),
            Topic::Collapses => ("yanks", "Blocks torn out, and the heaps that are left"),
            Topic::Range => ("range", "Both block presets over the range of friction and stiffness"),
        }
    }

    /// Measures the topic.
    ///
    /// # Errors
    /// When a scene of the topic cannot be built.
    pub fn measure(self, size: &Size) -> Result<Section, Error> {
        match self {
            Topic::Closed => closed::measure(size),
            Topic::Labelled => labelled::measure(size),
            Topic::Tilt => tilt::measure(size),
            Topic::Forces => forces::measure(size),
            Topic::Rotation => rotation::measure(size),
            Topic::Loose => loose::measure(size),
            Topic::Rest => rest::measure(size),
            Topic::Removal => removal::measure(size),
            Topic::Extraction => extraction::measure(size),
            Topic::PutBack => put_back::measure(size),
            Topic::Placing => placing::measure(size),
            Topic::Collapses => collapses::measure(size),
            Topic::Range => range::measure(size),
        }
    }
}
