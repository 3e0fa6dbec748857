//! Release of a block above a tower: placing and dropping.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Hand, Input, Pose, World};

use crate::fall::Footing;
use crate::hand_path::HandPath;
use crate::reference_positions::ReferencePositions;
use crate::rest::RestTimer;
use crate::settle::SETTLE_TIME;
use crate::solid::Solid;

/// Maximum time from the release to rest, s.
const MAX_TIME: f64 = 5.0;
/// Time in which the hand lowers the block, and for which it then holds still, s.
const LOWERING: f64 = 0.5;

/// Outcome of a block released above a tower.
///
/// ```
/// # use teeter_physics::{BodyId, Params, World};
/// # use teeter_scene::{Block, TowerOptions, config};
/// # use teeter_study::drop_block;
/// let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
/// // beside the tower: the block ends on the floor
/// scene.blocks.push(Block { id: 6, pos: [0.0, 0.2, 0.07], ..scene.blocks[0].clone() });
/// let dropped = drop_block(World::new(&scene, Params::default())?, BodyId(6), 0.01);
/// assert!(!dropped.stays && dropped.aside_mm < 1.0 && dropped.rest_s.is_some());
/// assert!(dropped.others_after_mm <= dropped.others_mm && dropped.others_mm < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DroppedBlock {
    /// Largest displacement of any other block at any time, mm.
    pub others_mm: f64,
    /// Largest displacement of any other block at the end, mm.
    pub others_after_mm: f64,
    /// Horizontal distance of the block at the end from where it was released, mm.
    pub aside_mm: f64,
    /// True when the block ends on top, and no other block falls.
    pub stays: bool,
    /// Time from the release to the beginning of rest, s; none without rest within 5 s.
    pub rest_s: Option<f64>,
}

/// Releases `body` at `height` (m) over the highest corner of all other blocks.
///
/// The world is as built, with the body in the air above a tower. A hand holds the body level while
/// the tower settles, and lowers it.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use teeter_physics::{BodyId, Params, World};
/// use teeter_scene::{Block, TowerOptions, config};
/// use teeter_study::drop_block;
///
/// let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
/// scene.blocks.push(Block { id: 6, pos: [0.0, 0.0, 0.07], ..scene.blocks[0].clone() });
/// let dropped = drop_block(World::new(&scene, Params::default())?, BodyId(6), 0.01);
/// assert!(dropped.stays && dropped.others_mm < 1.0);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn drop_block(mut world: World, body: BodyId, height: f64) -> DroppedBlock {
    let center = world.pose(body).position;
    let top = lower(&mut world, body, height);
    let (start, positions) = (world.time(), ReferencePositions::of(&world));
    let footing = Footing::of(&world);
    let (mut others, mut fell): (f64, bool) = (0.0, false);
    let (mut timer, mut rest_s) = (RestTimer::default(), None);
    for _ in 0..world.frames(MAX_TIME) {
        let report = world.step(&Input::default());
        others = others.max(positions.max_displacement_except(&world, body));
        fell |= footing.any_fallen_except(&world, body);
        if timer.advance(world.params().frame, report.max_speed) {
            rest_s = Some(report.time - start - timer.elapsed());
            break;
        }
    }
    let now = world.pose(body).position;
    DroppedBlock {
        others_mm: 1e3 * others,
        others_after_mm: 1e3 * positions.max_displacement_except(&world, body),
        aside_mm: 1e3 * (now - center).truncate().length(),
        stays: !fell && now.z > top,
        rest_s,
    }
}

/// Holds `body` until the tower has settled, and lowers it to `height` (m) over the tower. Returns
/// the height of the highest corner of all other blocks, m.
fn lower(world: &mut World, body: BodyId, height: f64) -> f64 {
    let Pose { position: center, orientation } = world.pose(body);
    let hand = Hand::carry(body, DVec3::ZERO, center, orientation);
    world.run_with(SETTLE_TIME, &Input::hand(hand.clone()));
    let solids = Solid::all(world);
    let others = solids.iter().enumerate().filter(|(i, _)| *i != body.index());
    let top = others.map(|(_, solid)| solid.top()).fold(0.0, f64::max);
    let low = DVec3::new(center.x, center.y, top + height + 0.5 * world.size(body).z);
    for hand in HandPath::new(hand, world.params().frame).line_in(low, LOWERING).pause(LOWERING) {
        world.step(&Input::hand(hand));
    }
    top
}
