//! Taking a block out of a tower by the hand.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Grip, Hand, Input, Pose, World};

use crate::places::Places;
use crate::settle::frames;

/// How far past its own length a block is taken, m.
const BEYOND: f64 = 5e-3;
/// A block that lags behind the hand by more than this when the hand is done has not come out, m: the spring of a hand that pulls with all its force.
const LAG: f64 = 10e-3;
/// How long the tower is watched afterwards, s.
const WATCHED: f64 = 1.0;

/// How it went.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extraction {
    /// Whether the block came out.
    pub out: bool,
    /// Furthest that any other block was from its place at any time, mm.
    pub others_mm: f64,
    /// Whether another block fell.
    pub fell: bool,
    /// Largest force of the hand, N.
    pub force_n: f64,
}

/// Takes `body` out of a settled world along `axis` (unit vector) at `speed` (m/s), as a hand does it: it holds the end of the block and draws it along its own
/// length, which leans with the tower, keeps it as it lies, and has the force of a careful hand. Drawn level instead, a block is lifted against what lies above it.
pub fn extract(settled: &World, body: BodyId, axis: DVec3, speed: f64) -> Extraction {
    let mut world = settled.clone();
    let Pose { position: center, orientation: turn } = settled.pose(body);
    let size = settled.size(body);
    // the face whose normal is nearest to the axis
    let end = turn.inverse() * axis;
    let end = DVec3::from(std::array::from_fn::<f64, 3, _>(|k| {
        if end[k].abs() == end.abs().max_element() { end[k].signum() } else { 0.0 }
    }));
    let axis = turn * end;
    let anchor = end * (0.5 * size.dot(end.abs()));
    let from = center + turn * anchor;
    let length = size.dot(end.abs()) + BEYOND;
    let places = Places::of(&world);
    let mut seen = Extraction { out: false, others_mm: 0.0, fell: false, force_n: 0.0 };
    let mut look = |world: &World| {
        seen.others_mm = f64::max(seen.others_mm, 1e3 * places.furthest_but(world, body));
        seen.fell |= places.any_fallen_but(world, body);
    };
    let hand = |way: f64| Hand::slide(body, anchor, from + axis * way, turn);
    let (pulled, mut force) = (frames(&world, length / speed).max(1), 0.0);
    for i in 1..=pulled {
        let way = length * i as f64 / pulled as f64;
        let report = world.step(&Input::hand(hand(way)));
        force = report.hand.map_or(force, |h| h.force.length().max(force));
        look(&world);
    }
    let went = axis.dot(world.pose(body).position - center);
    for _ in 0..frames(&world, WATCHED) {
        // still in the hand, or it would fall on the table and might hit the tower
        world.step(&Input::hand(Hand { grip: Grip::Carry, ..hand(length) }));
        look(&world);
    }
    Extraction { out: went > length - LAG, force_n: force, ..seen }
}
