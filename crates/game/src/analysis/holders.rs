//! Blocks that hold a block in the tower, and the contacts by which it sticks.

use serde::Serialize;
use teeter_physics::{BodyId, ContactReport, World};

/// Vertical component of the normal from which a contact bears weight; others are between sides.
const MIN_VERTICAL: f64 = 0.7;
/// Load below which a block does not press on another, N.
const MIN_LOAD: f64 = 1e-3;

/// Side of a block on which a contact is.
///
/// ```
/// assert_eq!(serde_json::to_string(&teeter_game::Side::Above)?, r#""above""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The other block presses from above.
    Above,
    /// The other block, or the floor, bears this one.
    Below,
    /// The other block is beside it.
    Beside,
}

/// Contact that holds a block by friction.
///
/// ```
/// use teeter_game::{Side, sticking};
/// use teeter_physics::{BodyId, Params};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let world = teeter_study::settled(&scene, Params::default())?;
/// let [below, above] = sticking(&world, BodyId(3))[..] else { panic!("two faces touch") };
/// assert_eq!((below.side, below.other), (Side::Below, Some(BodyId(2))));
/// assert_eq!((above.side, above.other), (Side::Above, Some(BodyId(4))));
/// assert!((above.friction_n / (scene.friction * above.load_n) - 1.0).abs() < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StickingContact {
    /// Other block; none for the floor.
    #[serde(rename = "body")]
    pub other: Option<BodyId>,
    /// Side on which it is.
    pub side: Side,
    /// Normal force, N.
    #[serde(rename = "load_N")]
    pub load_n: f64,
    /// Largest friction, N: coefficient of static friction times normal force.
    #[serde(rename = "friction_N")]
    pub friction_n: f64,
}

/// Returns the contacts that hold a block by friction, the one with the largest friction first.
///
/// # Panics
/// When the world has no such body.
pub fn sticking(world: &World, body: BodyId) -> Vec<StickingContact> {
    let scene = world.scene();
    let friction =
        |body: Option<BodyId>| body.and_then(|body| scene.blocks[body.index()].friction).unwrap_or(scene.friction);
    let contacts = world.contacts(body).into_iter().filter(|contact| contact.force > MIN_LOAD);
    let contact = |contact: ContactReport| StickingContact {
        other: contact.other,
        side: match contact.normal.z {
            z if z < -MIN_VERTICAL => Side::Above,
            z if z > MIN_VERTICAL => Side::Below,
            _ => Side::Beside,
        },
        load_n: contact.force,
        // A pair has the geometric mean of its blocks.
        friction_n: (friction(Some(body)) * friction(contact.other)).sqrt() * contact.force,
    };
    let mut sticking: Vec<StickingContact> = contacts.map(contact).collect();
    sticking.sort_by(|a, b| b.friction_n.total_cmp(&a.friction_n).then(a.other.cmp(&b.other)));
    sticking
}

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
