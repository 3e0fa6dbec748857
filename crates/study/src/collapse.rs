//! Collapse: blocks torn out of a tower, and the pile that is left.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Drive, Input, World};

use crate::rest::PILE_SPEED;
use crate::solid::{Solid, max_penetration, max_penetration_between};

/// Distance over which blocks are torn, m.
const TRAVEL: f64 = 0.12;
/// Penetration beyond which blocks overlap, m.
const MAX_OVERLAP: f64 = 1e-3;
/// Penetration between two frames beyond which a block went through another, m: a third of the
/// thickness of the thinnest block.
const MAX_TUNNEL: f64 = 5e-3;
/// Displacement beyond which a block counts as moved, m: more than the thickness of a block.
const MIN_MOVED: f64 = 0.02;

/// Record of a collapse.
///
/// ```
/// # use glam::DVec3;
/// # use teeter_physics::{BodyId, Params};
/// # use teeter_study::{PILE_SPEED, collapse, settled};
/// let scene = teeter_scene::named("column").unwrap();
/// let world = settled(&scene, Params { frame: 1.0 / 240.0, ..Params::default() })?;
/// // the top block alone is torn off
/// let record = collapse(&world, &[BodyId(9)], DVec3::X, 0.5);
/// assert!(record.moved == 1 && record.deepest_mm < 0.1 && record.lasting_s == 0.0);
/// assert!(record.speed_at_end < PILE_SPEED && record.quiet_s.is_some());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Collapse {
    /// Largest penetration of two blocks, or of one and the floor, at the end of any frame, mm.
    pub deepest_mm: f64,
    /// Longest time for which a penetration was more than 1 mm, s.
    pub lasting_s: f64,
    /// True when a block went through another between two frames.
    pub through: bool,
    /// True when a number was not finite, or a block ran away and was frozen.
    pub lost: bool,
    /// Speed of the fastest block at the end, m/s.
    pub speed_at_end: f64,
    /// Time from the release from which nothing moves faster than [`PILE_SPEED`], s; none where
    /// something does at the end.
    pub quiet_s: Option<f64>,
    /// Number of blocks that moved by more than 20 mm.
    pub moved: usize,
}

/// Tears `bodies` out of a settled world by 12 cm with a `velocity` (m/s), releases them, and
/// simulates for `seconds`.
///
/// Blocks are compared at the ends of frames and on the straight lines between them, so frames
/// should be short: 1/240 s.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Params};
/// use teeter_study::{collapse, settled};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let world = settled(&scene, Params { frame: 1.0 / 240.0, ..Params::default() })?;
/// let pile = collapse(&world, &[BodyId(1)], DVec3::X, 0.5);
/// assert!(pile.moved > 0 && !pile.through && !pile.lost);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn collapse(settled: &World, bodies: &[BodyId], velocity: DVec3, seconds: f64) -> Collapse {
    let mut world = settled.clone();
    let frame = world.params().frame;
    let tearing = (TRAVEL / velocity.length() / frame).ceil() as usize;
    let tear = Input::drives(bodies.iter().map(|&body| Drive::new(body, velocity)).collect());
    let free = Input::default();
    let mut record = Collapse::default();
    let start = Solid::all(&world);
    let (mut before, mut lasting) = (start.clone(), 0.0);
    for i in 0..tearing + world.frames(seconds) {
        let report = world.step(if i < tearing { &tear } else { &free });
        let now = Solid::all(&world);
        record.lost |= !report.quarantined.is_empty() || world.poses().iter().any(|x| !x.is_finite());
        let penetration = max_penetration(&now);
        record.deepest_mm = record.deepest_mm.max(1e3 * penetration);
        lasting = if penetration > MAX_OVERLAP { lasting + frame } else { 0.0 };
        record.lasting_s = record.lasting_s.max(lasting);
        record.through |= max_penetration_between(&before, &now) > MAX_TUNNEL;
        before = now;
        record.speed_at_end = report.max_speed;
        let time = (i + 1).saturating_sub(tearing) as f64 * frame;
        record.quiet_s = if report.max_speed < PILE_SPEED { record.quiet_s.or(Some(time)) } else { None };
    }
    record.moved = start.iter().zip(&before).filter(|(a, b)| a.center.distance(b.center) > MIN_MOVED).count();
    record
}
