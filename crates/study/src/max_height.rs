//! Height of a tower.

use teeter_physics::World;

/// Height of the highest corner of any block above the floor, m.
///
/// ```
/// use teeter_physics::{Params, World};
///
/// let world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// assert!((teeter_study::max_height(&world) - 0.18).abs() < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn max_height(world: &World) -> f64 {
    let height = |body| {
        let pose = world.pose(body);
        let [x, y, z, w] = pose.orientation.to_array();
        // bottom row of the rotation matrix: the vertical component of each of the block's axes
        let up = [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)];
        let size = world.size(body);
        pose.position.z + 0.5 * (up[0].abs() * size.x + up[1].abs() * size.y + up[2].abs() * size.z)
    };
    world.bodies().map(height).fold(f64::NEG_INFINITY, f64::max)
}
