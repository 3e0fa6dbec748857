//! List of the parts of the report.

use indicatif::ProgressBar;
use maud::Markup;

use super::{disabled, frame_rate, moves, plane_methods, requirements, soft_springs, static_tests, table_5_2};
use crate::error::Error;

/// Runs a part and advances the bar after each experiment.
type Run = fn(&ProgressBar) -> Result<Markup, Error>;

/// Part of the report.
pub struct Part {
    /// Name for selection.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// True when the part measures time, and so runs alone.
    pub timed: bool,
    /// Number of experiments.
    pub steps: u64,
    /// Experiments.
    pub run: Run,
}

/// Parts in the order of the page.
pub const PARTS: &[Part] = &[
    Part {
        name: "table-5.2",
        title: "Table 5.2: potential collisions after each test",
        timed: false,
        steps: table_5_2::STEPS,
        run: table_5_2::counts,
    },
    Part {
        name: "culling",
        title: "Section 5.4.1: time saved by culling",
        timed: true,
        steps: table_5_2::CULLING_STEPS,
        run: table_5_2::culling,
    },
    Part {
        name: "static-tests",
        title: "Section 6.1.1: six static tests",
        timed: false,
        steps: static_tests::STEPS,
        run: static_tests::run,
    },
    Part { name: "moves", title: "Section 6.1.2: twelve moves", timed: false, steps: moves::STEPS, run: moves::run },
    Part {
        name: "soft-springs",
        title: "Figure 6.21: a full tower on soft springs",
        timed: false,
        steps: soft_springs::STEPS,
        run: soft_springs::run,
    },
    Part {
        name: "disabled",
        title: "Figure 6.22: disabled blocks",
        timed: false,
        steps: disabled::STEPS,
        run: disabled::run,
    },
    Part {
        name: "frame-rate",
        title: "Figure 6.23: frame rate against rows",
        timed: true,
        steps: frame_rate::STEPS,
        run: frame_rate::run,
    },
    Part {
        name: "chapter-2",
        title: "Chapters 2 and 3: the methods side by side in the plane",
        timed: false,
        steps: plane_methods::STEPS,
        run: plane_methods::run,
    },
    Part {
        name: "requirements",
        title: "Section 3.6: the requirements",
        timed: false,
        steps: requirements::STEPS,
        run: requirements::run,
    },
];
