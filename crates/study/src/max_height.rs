//! Height of a tower.

use glam::{DQuat, DVec3};
use teeter_physics::World;
use teeter_scene::Scene;

/// Height of the highest corner of any block above the floor, m.
///
/// ```
/// use teeter_physics::{Params, World};
///
/// let world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// // contacts give by micrometres
/// assert!((teeter_study::max_height(&world) - 0.18).abs() < 2e-5);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn max_height(world: &World) -> f64 {
    let height = |body| {
        let pose = world.pose(body);
        top(pose.position, pose.orientation, world.size(body))
    };
    world.bodies().map(height).fold(f64::NEG_INFINITY, f64::max)
}

/// Height of the highest corner of any block of a scene above the floor, m: that of the world
/// without load.
///
/// ```
/// let scene = teeter_scene::named("column").unwrap();
/// assert!((teeter_study::scene_height(&scene) - 0.18).abs() < 1e-12);
/// ```
pub fn scene_height(scene: &Scene) -> f64 {
    let blocks = scene.blocks.iter();
    let tops = blocks.map(|b| top(b.pos.into(), DQuat::from_array(b.rotation()), b.size.into()));
    tops.fold(f64::NEG_INFINITY, f64::max)
}

/// Height of the highest corner of a block of full edge lengths `size`, m.
fn top(position: DVec3, orientation: DQuat, size: DVec3) -> f64 {
    let [x, y, z, w] = orientation.to_array();
    // bottom row of the rotation matrix: the vertical component of each of the block's axes
    let up = DVec3::new(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y));
    position.z + 0.5 * up.abs().dot(size)
}
