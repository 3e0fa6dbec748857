//! What the engine says of a scene.

use serde::Serialize;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::places::Places;
use crate::tilt;

/// How long a tower is watched, s.
const WATCHED: f64 = 5.0;

/// A prediction for one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Prediction {
    /// Whether a tower falls.
    Config {
        /// The scene's name.
        name: String,
        /// Whether any block fell within 5 s.
        fell: bool,
    },
    /// At what angle a tilted tower collapses.
    Tilt {
        /// The scene's name.
        name: String,
        /// Degrees; null where it does not fall at any angle tried.
        tilt_deg: Option<f64>,
    },
}

/// Answers the question that the scene asks: its angle of collapse where it has `tilt_az`, whether it falls otherwise.
pub fn predict(scene: &Scene, params: Params) -> Result<Prediction, BuildError> {
    let name = scene.name.clone();
    match scene.tilt_az {
        Some(az) => Ok(Prediction::Tilt { name, tilt_deg: tilt::collapse(scene, az, params)? }),
        None => Ok(Prediction::Config { name, fell: falls(scene, params)? }),
    }
}

fn falls(scene: &Scene, params: Params) -> Result<bool, BuildError> {
    let mut world = World::new(scene, params)?;
    let start = Places::of(&world);
    let input = Input::default();
    while world.time() < WATCHED - params.frame / 2.0 {
        let report = world.step(&input);
        if !report.quarantined.is_empty() || start.any_fallen(&world) {
            return Ok(true);
        }
    }
    Ok(false)
}
