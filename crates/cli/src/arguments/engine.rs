//! Arguments of commands that simulate.

use clap::{Args, ValueEnum};
use teeter_physics::{Params, Precision};

use super::material::Material;

/// Arguments of the engine.
#[derive(Debug, Args)]
pub struct EngineArguments {
    #[command(flatten)]
    pub material: Material,
    /// Number format of the inner loop.
    #[arg(long, value_enum, default_value_t = Format::Single)]
    precision: Format,
}

/// Number format of the inner loop.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// f32: fast, as in the game.
    Single,
    /// f64: accurate.
    Double,
}

impl EngineArguments {
    /// Parameters of a run.
    pub fn params(&self, sleep: bool) -> Params {
        let precision = match self.precision {
            Format::Single => Precision::Single,
            Format::Double => Precision::Double,
        };
        Params { precision, sleep, ..Params::default() }
    }
}
