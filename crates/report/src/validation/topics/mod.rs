//! What is measured, a file a topic.

mod closed;
mod extraction;
mod forces;
mod labelled;
mod loose;
mod placing;
mod range;
mod removal;
mod rest;
mod turning;
mod yanks;

use super::section::{Section, Size};
use crate::error::Error;

/// A part of the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// Falls, slides, spins, impacts and pushes against closed forms.
    Closed,
    /// Towers with known answers: which stand.
    Labelled,
    /// Towers with known answers: at what tilt they collapse.
    Tilt,
    /// The force that starts each block, against rigid blocks.
    Forces,
    /// How a tower turns above a tight block that is pulled.
    Turning,
    /// The share of loose blocks against the scatter of heights.
    Loose,
    /// Long rest.
    Rest,
    /// Every legal single removal.
    Removal,
    /// Loose blocks taken out by the hand.
    Extraction,
    /// Blocks placed and dropped on top.
    Placing,
    /// Blocks torn out, and the heaps that are left.
    Yanks,
    /// Both makes of block, friction and stiffness.
    Range,
}

impl Topic {
    /// All of them, in the order of the report.
    pub const ALL: [Topic; 12] = [
        Topic::Closed,
        Topic::Labelled,
        Topic::Tilt,
        Topic::Forces,
        Topic::Turning,
        Topic::Loose,
        Topic::Removal,
        Topic::Extraction,
        Topic::Placing,
        Topic::Yanks,
        Topic::Range,
        Topic::Rest,
    ];

    /// Name for selection.
    pub fn name(self) -> &'static str {
        match self {
            Topic::Closed => "closed",
            Topic::Labelled => "labelled",
            Topic::Tilt => "tilt",
            Topic::Forces => "forces",
            Topic::Turning => "turning",
            Topic::Loose => "loose",
            Topic::Rest => "rest",
            Topic::Removal => "removal",
            Topic::Extraction => "extraction",
            Topic::Placing => "placing",
            Topic::Yanks => "yanks",
            Topic::Range => "range",
        }
    }

    /// One line of help.
    pub fn summary(self) -> &'static str {
        match self {
            Topic::Closed => "Falls, slides, spins, impacts and pushes against closed forms",
            Topic::Labelled => "Towers with known answers: which stand",
            Topic::Tilt => "Towers with known answers: at what tilt they collapse",
            Topic::Forces => "The force that starts each block, against rigid blocks",
            Topic::Turning => "How a tower turns above a tight block that is pulled",
            Topic::Loose => "The share of loose blocks against the scatter of heights",
            Topic::Rest => "Long rest",
            Topic::Removal => "Every legal single removal",
            Topic::Extraction => "Loose blocks taken out by the hand",
            Topic::Placing => "Blocks placed and dropped on top",
            Topic::Yanks => "Blocks torn out, and the heaps that are left",
            Topic::Range => "Both makes of block, friction and stiffness",
        }
    }

    /// Measures it.
    pub fn measure(self, size: &Size) -> Result<Section, Error> {
        match self {
            Topic::Closed => closed::measure(size),
            Topic::Labelled => labelled::standing(size),
            Topic::Tilt => labelled::tilt(size),
            Topic::Forces => forces::measure(size),
            Topic::Turning => turning::measure(size),
            Topic::Loose => loose::measure(size),
            Topic::Rest => rest::measure(size),
            Topic::Removal => removal::measure(size),
            Topic::Extraction => extraction::measure(size),
            Topic::Placing => placing::measure(size),
            Topic::Yanks => yanks::measure(size),
            Topic::Range => range::measure(size),
        }
    }
}

/// A fault of the report's own scenes, which are valid.
fn built(error: impl std::fmt::Display) -> Error {
    Error::Said(format!("a scene of the report cannot be built: {error}"))
}
