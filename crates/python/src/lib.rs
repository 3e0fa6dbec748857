#![doc = include_str!("../README.md")]
#![allow(clippy::too_many_arguments, reason = "arguments of Python are named where they are given")]

mod analysis;
mod argument;
mod batch;
mod command_line;
mod error;
mod game;
mod input;
mod opponent;
mod picture;
mod plain;
mod pool;
mod record;
mod report;
mod rollout;
mod scene;
mod statics;
mod twist;
mod world;

use pyo3::prelude::*;

/// Bindings of Teeter's library. The package `teeter` documents and exports them.
#[pymodule]
mod _teeter {
    #[pymodule_export]
    use crate::analysis::{analyse, breakdown, force_map, remove};
    #[pymodule_export]
    use crate::batch::WorldBatch;
    #[pymodule_export]
    use crate::command_line::run_command;
    #[pymodule_export]
    use crate::game::{Game, rules, step_games};
    #[pymodule_export]
    use crate::opponent::{Opponent, contest, thinking};
    #[pymodule_export]
    use crate::record::Record;
    #[pymodule_export]
    use crate::report::{Contacts, Energy, HandReport, Loads, StepReport};
    #[pymodule_export]
    use crate::rollout::Rollout;
    #[pymodule_export]
    use crate::scene::{cards, config, field, load, named, names, tower};
    #[pymodule_export]
    use crate::statics::{Footing, exact_fall, exact_forces, exact_tilt, labelled_towers, tilted_towers};
    #[pymodule_export]
    use crate::world::World;

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        crate::pool::note_process();
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("POSE_STRIDE", teeter_physics::POSE_STRIDE)
    }
}
