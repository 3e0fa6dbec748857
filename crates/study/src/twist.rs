//! By how much the tower above turns when a block is drawn a little way.

use glam::DVec3;
use teeter_physics::{BodyId, Grip, Hand, Input, World};

use crate::settle::frames;

/// Draws `body` out of a settled world along `axis` (unit vector, level) by `way` (m) at `speed` (m/s), with a hand that holds its centre, leaves it free to turn
/// and is strong enough. The mean turn of `above` about the vertical over the way that the block went, rad/m.
pub fn twist(settled: &World, body: BodyId, axis: DVec3, above: &[BodyId], way: f64, speed: f64) -> f64 {
    let mut world = settled.clone();
    let start = world.pose(body).position;
    let count = frames(&world, way / speed).max(1);
    for i in 1..=count {
        let hand = Hand {
            body,
            anchor: DVec3::ZERO,
            target: start + axis * (way * i as f64 / count as f64),
            orientation: None,
            grip: Grip::Slide,
            max_force: 20.0,
            max_torque: 0.0,
        };
        world.step(&Input::hand(hand));
    }
    let turned = |&i: &BodyId| {
        let turn = world.pose(i).orientation * settled.pose(i).orientation.inverse();
        2.0 * libm::atan2(turn.z, turn.w)
    };
    let mean = above.iter().map(turned).sum::<f64>() / above.len() as f64;
    mean / axis.dot(world.pose(body).position - start)
}
