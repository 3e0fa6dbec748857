//! List of the parts of the report.

use super::part::Part;
use super::{
    disabled, fewer_springs, frame_rate, moves, plane_methods, requirements, rounds, soft_springs, static_tests,
    step_size, table_5_2,
};

/// Parts in the order of the page.
pub const PARTS: &[Part] = &[
    Part {
        name: "table-5.2",
        title: "Table 5.2: potential collisions after each test",
        steps: table_5_2::STEPS,
        clock: None,
        moves: false,
        run: table_5_2::counts,
    },
    Part {
        name: "culling",
        title: "Section 5.4.1: time saved by culling",
        steps: table_5_2::CULLING_STEPS,
        clock: Some(table_5_2::time_culling),
        moves: false,
        run: table_5_2::culling,
    },
    Part {
        name: "static-tests",
        title: "Section 6.1.1: six static tests",
        steps: static_tests::STEPS,
        clock: None,
        moves: false,
        run: static_tests::run,
    },
    Part {
        name: "moves",
        title: "Section 6.1.2: twelve moves",
        steps: moves::SPEED_STEPS,
        clock: None,
        moves: true,
        run: moves::run,
    },
    Part {
        name: "rounds",
        title: "Abstract and section 6.2.2: all collisions within a couple of iterations",
        steps: rounds::STEPS,
        clock: None,
        moves: true,
        run: rounds::run,
    },
    Part {
        name: "soft-springs",
        title: "Figure 6.21: a full tower on soft springs",
        steps: soft_springs::STEPS,
        clock: None,
        moves: false,
        run: soft_springs::run,
    },
    Part {
        name: "disabled",
        title: "Figure 6.22: disabled blocks",
        steps: disabled::STEPS,
        clock: None,
        moves: false,
        run: disabled::run,
    },
    Part {
        name: "frame-rate",
        title: "Figure 6.23: frame rate against rows",
        steps: frame_rate::STEPS,
        clock: Some(frame_rate::clock),
        moves: false,
        run: frame_rate::run,
    },
    Part {
        name: "step-size",
        title: "Section 5.2.2: steps as long as the last frame took",
        steps: step_size::STEPS,
        clock: None,
        moves: false,
        run: step_size::run,
    },
    Part {
        name: "fewer-springs",
        title: "Sections 6.2.2 and 6.3: fewer springs a block",
        steps: fewer_springs::STEPS,
        clock: None,
        moves: false,
        run: fewer_springs::run,
    },
    Part {
        name: "chapter-2",
        title: "Chapters 2 and 3: the methods side by side in the plane",
        steps: plane_methods::STEPS,
        clock: None,
        moves: false,
        run: plane_methods::run,
    },
    Part {
        name: "requirements",
        title: "Section 3.6: the requirements",
        steps: requirements::STEPS,
        clock: Some(requirements::clock),
        moves: true,
        run: requirements::run,
    },
];
