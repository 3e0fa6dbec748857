//! Towers brought to rest.

use teeter_physics::{BuildError, Params, World};
use teeter_scene::Scene;

/// Time that a tower settles before a measurement, s. Gravity grows for 0.3 s, and a second later
/// nothing moves by a nanometre.
pub const SETTLE_TIME: f64 = 2.0;

/// Builds the world of `scene` and lets it settle for [`SETTLE_TIME`].
///
/// # Errors
/// When the world cannot be built.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::{SETTLE_TIME, settled};
///
/// let world = settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// assert!((world.time() - SETTLE_TIME).abs() < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn settled(scene: &Scene, params: Params) -> Result<World, BuildError> {
    let mut world = World::new(scene, params)?;
    world.run_for(SETTLE_TIME);
    Ok(world)
}
