//! Towers brought to rest.

use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

/// How long a tower settles before anything is measured on it, s: gravity grows for 0.3 s, and a second later nothing moves by a nanometre.
pub const SETTLE: f64 = 2.0;

/// A world of `scene` that has settled for [`SETTLE`].
///
/// # Errors
/// When the world cannot be built.
pub fn settled(scene: &Scene, params: Params) -> Result<World, BuildError> {
    let mut world = World::new(scene, params)?;
    run(&mut world, SETTLE, &Input::default());
    Ok(world)
}

/// Steps for `seconds` with the same input.
pub fn run(world: &mut World, seconds: f64, input: &Input) {
    for _ in 0..frames(world, seconds) {
        world.step(input);
    }
}

/// The number of frames that `seconds` are.
pub fn frames(world: &World, seconds: f64) -> usize {
    (seconds / world.params().frame).round() as usize
}
