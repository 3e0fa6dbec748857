//! Extraction of a block from a tower by the hand.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Grip, Hand, Input, World};

use crate::end_grip::EndGrip;
use crate::fall::Footing;
use crate::hand_path::HandPath;
use crate::reference_positions::ReferencePositions;

/// Travel of the hand beyond the length of the block, m.
const EXTRA_TRAVEL: f64 = 5e-3;
/// Lag of a block behind the hand up to which the block has come out, m: the stretch of the hand's
/// spring at its full force.
const MAX_LAG: f64 = 10e-3;
/// Time for which the hand holds the block afterwards, s.
const HOLD: f64 = 1.0;

/// Outcome of an extraction.
///
/// ```
/// # use glam::DVec3;
/// # use teeter_physics::{BodyId, Params};
/// # use teeter_study::{extract, settled};
/// let scene = teeter_scene::named("block").unwrap();
/// let block = settled(&scene, Params::default())?;
/// let extraction = extract(&block, BodyId(0), DVec3::X, 0.05);
/// assert!(extraction.out && !extraction.fell && extraction.others_mm == 0.0);
/// // the hand overcomes friction
/// assert!(extraction.force_n > scene.friction * scene.blocks[0].mass * scene.gravity);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extraction {
    /// True when the block came out.
    pub out: bool,
    /// Largest displacement of any other block at any time, mm.
    pub others_mm: f64,
    /// True when another block fell.
    pub fell: bool,
    /// Largest force of the hand, N.
    pub force_n: f64,
}

/// Takes `body` out of a settled world along `axis` (unit vector) at `speed` (m/s).
///
/// The hand holds the middle of the block's end face, keeps the orientation and has the default
/// force of a careful hand. It pulls along the block's own axis, which leans with the tower.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Params};
/// use teeter_study::{extract, settled};
///
/// let options = teeter_scene::TowerOptions::exact();
/// let scene = teeter_scene::loose("(000)-(0L0)-(000)", &options).unwrap();
/// let extraction = extract(&settled(&scene, Params::default())?, BodyId(4), DVec3::Y, 0.05);
/// assert!(extraction.out && !extraction.fell);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn extract(settled: &World, body: BodyId, axis: DVec3, speed: f64) -> Extraction {
    let mut world = settled.clone();
    let grip = EndGrip::new(settled, body, axis);
    let (axis, center) = (grip.axis, settled.pose(body).position);
    let length = grip.length + EXTRA_TRAVEL;
    let (positions, footing) = (ReferencePositions::of(&world), Footing::of(&world));
    let mut outcome = Extraction { out: false, others_mm: 0.0, fell: false, force_n: 0.0 };
    let mut observe = |world: &World| {
        outcome.others_mm = f64::max(outcome.others_mm, 1e3 * positions.max_displacement_except(world, body));
        outcome.fell |= footing.any_fallen_except(world, body);
    };
    let frame = world.params().frame;
    let mut force = 0.0;
    for hand in HandPath::new(grip.hand(), frame).line_along(axis, length, speed) {
        let report = world.step(&Input::hand(hand));
        force = report.hand.map_or(force, |h| h.force.length().max(force));
        observe(&world);
    }
    let travel = axis.dot(world.pose(body).position - center);
    // a released block would fall on the table and might hit the tower
    let end = Hand { grip: Grip::Carry, target: grip.point + axis * length, ..grip.hand() };
    for hand in HandPath::new(end, frame).pause(HOLD) {
        world.step(&Input::hand(hand));
        observe(&world);
    }
    Extraction { out: travel > length - MAX_LAG, force_n: force, ..outcome }
}
