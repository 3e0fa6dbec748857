//! Blocks that hold a block in the tower.

use teeter_physics::{BodyId, World};

/// Vertical component of the normal from which a contact bears weight; others are between sides.
const MIN_VERTICAL: f64 = 0.7;
/// Load below which a block does not press on another, N.
const MIN_LOAD: f64 = 1e-3;

/// Returns the blocks whose load bears on a block, in order of their ids: friction under them holds
/// it.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use teeter_game::holders;
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// assert_eq!(holders(&world, BodyId(3)), [BodyId(4)]);
/// assert_eq!(holders(&world, BodyId(9)), []);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn holders(world: &World, body: BodyId) -> Vec<BodyId> {
    let presses = |normal: f64, force: f64| normal < -MIN_VERTICAL && force > MIN_LOAD;
    let contacts = world.contacts(body).into_iter().filter(|contact| presses(contact.normal.z, contact.force));
    let mut bodies: Vec<BodyId> = contacts.filter_map(|contact| contact.other).collect();
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}
