//! Prediction for a labelled scene: fall, or angle of collapse.

use serde::Serialize;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::collapse_angle::collapse_angle;
use crate::fall::Footing;

/// Simulated time of an upright tower, s.
const DURATION: f64 = 5.0;

/// Prediction for one scene.
///
/// ```
/// # use teeter_physics::Params;
/// # use teeter_scene::{Scene, named};
/// # use teeter_study::{Prediction, predict};
/// let fall = predict(&named("test-4").unwrap(), Params::default())?;
/// assert_eq!(fall, Prediction::Config { name: "test-4".into(), fell: true });
///
/// let scene = Scene { tilt_az: Some(0.0), ..named("block").unwrap() };
/// let tilt = predict(&scene, Params { sleep: false, ..Params::default() })?;
/// let Prediction::Tilt { tilt_deg: Some(angle), .. } = tilt else { panic!("no angle") };
/// // the block slides at the angle of friction
/// assert!((angle - scene.friction.atan().to_degrees()).abs() < 0.1);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Prediction {
    /// Prediction for an upright tower.
    Config {
        /// Name of the scene.
        name: String,
        /// True when any block fell within 5 s, see [`Footing`].
        fell: bool,
    },
    /// Prediction for a tilted tower.
    Tilt {
        /// Name of the scene.
        name: String,
        /// Angle of collapse, degrees; none where the tower stands at every angle tried.
        tilt_deg: Option<f64>,
    },
}

/// Predicts the angle of collapse of a scene with `tilt_az`, and the fall of any other.
///
/// # Errors
/// When the world cannot be built.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::{Prediction, predict};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let prediction = predict(&scene, Params::default())?;
/// assert_eq!(prediction, Prediction::Config { name: "column".into(), fell: false });
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn predict(scene: &Scene, params: Params) -> Result<Prediction, BuildError> {
    let name = scene.name.clone();
    match scene.tilt_az {
        Some(azimuth) => Ok(Prediction::Tilt { name, tilt_deg: collapse_angle(scene, azimuth, params)? }),
        None => Ok(Prediction::Config { name, fell: falls(scene, params)? }),
    }
}

/// Returns true if a block of the upright tower falls.
fn falls(scene: &Scene, params: Params) -> Result<bool, BuildError> {
    let mut world = World::new(scene, params)?;
    let footing = Footing::of_scene(scene);
    let input = Input::default();
    while world.time() < DURATION - params.frame / 2.0 {
        let report = world.step(&input);
        if !report.quarantined.is_empty() || footing.any_fallen(&world) {
            return Ok(true);
        }
    }
    Ok(false)
}
