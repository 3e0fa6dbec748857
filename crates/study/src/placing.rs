//! Placing a block on a tower, or dropping it there.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Hand, Input, Pose, World};

use crate::places::Places;
use crate::settle::{SETTLE, frames, run};
use crate::solid::Solid;

/// What is done to a tower by a block that is let go above it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Placing {
    /// Furthest that any other block was from its place at any time, mm.
    pub others_mm: f64,
    /// The same when all is at rest.
    pub others_after_mm: f64,
    /// How far aside of where it was let go the block ends, mm.
    pub aside_mm: f64,
    /// Whether the block ends on top, and no other falls.
    pub stays: bool,
    /// From letting go until nothing moves faster than [`STILL`] for a quarter of a second, s; none where that does not come in [`LONGEST`].
    pub rest_s: Option<f64>,
}

/// Speed below which a tower is at rest, m/s.
pub const STILL: f64 = 1e-4;
/// How long rest is waited for, s.
pub const LONGEST: f64 = 5.0;
/// How long the hand takes to come down, and then holds still, s.
const LOWERING: f64 = 0.5;

/// Lets go of `body` at `height` (m) over the highest corner of all others. The world is as built, with the body in the air above a tower; a hand holds it level while the
/// tower settles, and brings it down.
pub fn let_go(mut world: World, body: BodyId, height: f64) -> Placing {
    let Pose { position: center, orientation: turn } = world.pose(body);
    let hand = |target: DVec3| Input::hand(Hand::carry(body, DVec3::ZERO, target, turn));
    let hold = |world: &mut World, target: DVec3, seconds: f64| run(world, seconds, &hand(target));
    hold(&mut world, center, SETTLE);
    let top = Solid::all(&world)
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != body.index())
        .map(|(_, s)| s.top())
        .fold(0.0, f64::max);
    let low = DVec3::new(center.x, center.y, top + height + 0.5 * world.size(body).z);
    let steps = frames(&world, LOWERING);
    for i in 1..=steps {
        world.step(&hand(center.lerp(low, i as f64 / steps as f64)));
    }
    hold(&mut world, low, LOWERING);
    let (start, places) = (world.time(), Places::of(&world));
    let (mut others, mut still, mut rest_s): (f64, f64, Option<f64>) = (0.0, 0.0, None);
    let mut fell = false;
    for _ in 0..frames(&world, LONGEST) {
        let report = world.step(&Input::default());
        others = others.max(places.furthest_but(&world, body));
        fell |= places.any_fallen_but(&world, body);
        still = if report.max_speed < STILL { still + world.params().frame } else { 0.0 };
        if still >= 0.25 {
            rest_s = Some(report.time - start - still);
            break;
        }
    }
    let now = world.pose(body).position;
    Placing {
        others_mm: 1e3 * others,
        others_after_mm: 1e3 * places.furthest_but(&world, body),
        aside_mm: 1e3 * (now - center).truncate().length(),
        stays: !fell && now.z > top,
        rest_s,
    }
}
