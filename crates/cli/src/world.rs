//! Building of worlds.

use teeter_physics::{Params, World};
use teeter_report::waiting;
use teeter_scene::Scene;

use crate::error::Error;

/// Builds a world, with a line on standard error where that takes long.
pub fn build(scene: &Scene, params: Params) -> Result<World, Error> {
    let built = waiting("building the world and letting it settle", || World::new(scene, params));
    built.map_err(|source| Error::Build { name: scene.name.clone(), source })
}
