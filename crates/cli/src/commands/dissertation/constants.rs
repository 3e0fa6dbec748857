//! Arguments that set the constants of 2003.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Method, Order, SpringSet};
use teeter_scene::Scene;

use crate::error::Error;
use crate::input;

/// Maximum size of an ini file, bytes.
const MAX_INI_BYTES: u64 = 1_000_000;

/// Arguments that set constants. An option has priority over the ini file, the ini file over the
/// scene, and the scene, which has gravity and friction, over the defaults.
#[derive(Debug, Args)]
pub struct ConstantArguments {
    /// File of constants, as --write-ini writes it; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    pub ini: Option<PathBuf>,
    /// Any constant of the ini file; can be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Integrator.
    #[arg(long, value_parser = names(Method::NAMES, Method::ALIASES))]
    method: Option<String>,
    /// Stiffness of every spring, N/m.
    #[arg(long, value_name = "N/M", allow_negative_numbers = true)]
    stiffness: Option<String>,
    /// Springs of a block: all 28, 24 of its sides, or 18 of its faces.
    #[arg(long, value_parser = names(SpringSet::NAMES, SpringSet::ALIASES))]
    springs: Option<String>,
    /// Steps of integrating and colliding in a frame.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    mid_loop_count: Option<String>,
    /// Rule that disables blocks.
    #[arg(long, value_parser = names(Disabling::NAMES, Disabling::ALIASES))]
    disabling: Option<String>,
    /// Order of the pairs of blocks.
    #[arg(long, value_parser = names(Order::NAMES, Order::ALIASES))]
    order: Option<String>,
    /// Tests before the exact one; on is planes, off is none.
    #[arg(long, value_parser = names(Culling::NAMES, Culling::ALIASES))]
    culling: Option<String>,
    /// Contacts without friction.
    #[arg(long, conflicts_with = "static_friction")]
    no_friction: bool,
    /// Coefficient of static friction, which the method of 2003 lacks.
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    static_friction: Option<String>,
    /// Kinetic friction only, as in 2003, where the ini file has static friction.
    #[arg(long, conflicts_with = "static_friction")]
    no_static_friction: bool,
}

/// Parser of one of the names of an option.
fn names(names: &[&'static str], aliases: &[(&'static str, &'static str)]) -> PossibleValuesParser {
    PossibleValuesParser::new(names.iter().map(|name| {
        let others = aliases.iter().filter(|(_, of)| of == name).map(|(alias, _)| *alias);
        clap::builder::PossibleValue::new(*name).aliases(others)
    }))
}

/// Sets the constants that a file sets; `-` is standard input.
pub fn apply_ini(constants: &mut Constants, path: &Path) -> Result<(), Error> {
    let (text, name) = input::text(path, MAX_INI_BYTES)?;
    constants.apply_ini(&text).map_err(|source| Error::Ini { name, source })
}

impl ConstantArguments {
    /// Returns the constants for a scene.
    pub fn constants(&self, scene: Option<&Scene>) -> Result<Constants, Error> {
        let mut constants = Constants::default();
        if let Some(scene) = scene {
            constants.gravity = scene.gravity;
            constants.friction = scene.kinetic_friction.unwrap_or(scene.friction);
        }
        if let Some(path) = &self.ini {
            apply_ini(&mut constants, path)?;
        }
        for (name, value) in self.options()? {
            constants.set(&name, &value)?;
        }
        Ok(constants)
    }

    /// Constants that the options name, with the texts of their values.
    fn options(&self) -> Result<Vec<(String, String)>, Error> {
        let mut options = Vec::new();
        for text in &self.set {
            let Some((name, value)) = text.split_once('=') else {
                return Err(Error::Assignment { text: text.clone() });
            };
            options.push((name.trim().to_owned(), value.trim().to_owned()));
        }
        for (name, value) in [
            ("method", &self.method),
            ("stiffness", &self.stiffness),
            ("springs", &self.springs),
            ("mid_loop_count", &self.mid_loop_count),
            ("disabling", &self.disabling),
            ("order", &self.order),
            ("culling", &self.culling),
            ("static_friction", &self.static_friction),
        ] {
            options.extend(value.as_ref().map(|value| (name.to_owned(), value.clone())));
        }
        for (name, value, given) in
            [("friction_enabled", "false", self.no_friction), ("static_friction", "none", self.no_static_friction)]
        {
            options.extend(given.then(|| (name.to_owned(), value.to_owned())));
        }
        Ok(options)
    }
}
