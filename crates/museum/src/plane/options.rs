//! Options of a scene in the plane.

use serde::Deserialize;
use teeter_dissertation::flat::Method as RigidMethod;
use teeter_dissertation::flat::scene::{Rectangle, section, stack};
use teeter_scene::TowerOptions;
use teeter_wasm_support::Error;

/// Maximum number of blocks in a scene: the work grows with the square of their number.
pub const MAX_BLOCKS: usize = 16;

/// Method of the prototype.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    Springs,
    Constraint,
    Penalty,
    MicroCollisions,
}

impl Method {
    /// Contact method of rigid bodies; `None` for springs.
    pub fn rigid(self) -> Option<RigidMethod> {
        match self {
            Method::Springs => None,
            Method::Constraint => Some(RigidMethod::Constraint),
            Method::Penalty => Some(RigidMethod::Penalty),
            Method::MicroCollisions => Some(RigidMethod::MicroCollisions),
        }
    }
}

/// Arrangement of the blocks at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Setting {
    /// Stack of blocks in contact.
    Stack,
    /// Stack of blocks with gaps, so that they fall.
    Falling,
    /// Section of a tower of six rows whose blocks differ in height.
    Tower,
}

/// Options of a scene.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Options {
    pub method: Method,
    pub setting: Setting,
    /// Number of blocks of a stack.
    pub count: u32,
    /// Gap between falling blocks, m.
    #[serde(default)]
    pub gap: f64,
    /// Stiffness of the springs or of the penalty method, N/m. Defaults to that of the method.
    #[serde(default)]
    pub stiffness: Option<f64>,
}

impl Options {
    /// Parses and checks options.
    ///
    /// # Errors
    /// Names the field that is missing, unknown or out of its range.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let options: Self = serde_json::from_str(text).map_err(|e| Error::json("options", e))?;
        if !(1..=MAX_BLOCKS as u32).contains(&options.count) {
            return Err(Error::rejected(format!("`count` is {}, expected 1 to {MAX_BLOCKS}", options.count)));
        }
        if !(0.0..=0.1).contains(&options.gap) {
            return Err(Error::rejected(format!("`gap` is {}, expected 0 to 0.1 m", options.gap)));
        }
        match options.stiffness {
            // The time steps are short enough for the default stiffness of 2e4 N/m.
            Some(stiffness) if !(50.0..=2e4).contains(&stiffness) => {
                Err(Error::rejected(format!("`stiffness` is {stiffness}, expected 50 to 2e4 N/m")))
            }
            _ => Ok(options),
        }
    }

    /// Builds the blocks.
    ///
    /// # Errors
    /// When the tower cannot be built.
    pub fn blocks(&self) -> Result<Vec<Rectangle>, Error> {
        Ok(match self.setting {
            Setting::Stack => stack(self.count, 0.0),
            Setting::Falling => stack(self.count, self.gap),
            Setting::Tower => {
                let tower = TowerOptions { rows: 6, ..TowerOptions::default() };
                section(&teeter_scene::tower(&tower).map_err(Error::rejected)?)
            }
        })
    }
}
