//! By how much the tower above turns when a block is drawn a little way.

use glam::{DQuat, DVec3};
use teeter_physics::{Grip, Hand, Input, World};

use crate::settle::frames;

/// Draws `body` out of a settled world along `axis` (unit vector, level) by `way` (m) at `speed` (m/s), with a hand that holds its centre, leaves it free to turn
/// and is strong enough. The mean turn of `above` about the vertical over the way that the block went, rad/m.
pub fn twist(settled: &World, body: u32, axis: DVec3, above: &[u32], way: f64, speed: f64) -> f64 {
    let mut world = settled.clone();
    let pose = |world: &World, i: u32| {
        let p = &world.poses()[7 * i as usize..];
        (DVec3::from_slice(p), DQuat::from_slice(&p[3..]))
    };
    let start = pose(&world, body).0;
    let count = frames(&world, way / speed).max(1);
    for i in 1..=count {
        let hand = Hand {
            body,
            anchor: DVec3::ZERO,
            target: start + axis * (way * i as f64 / count as f64),
            orientation: None,
            grip: Grip::Slide,
            axis: DVec3::ZERO,
            max_force: 20.0,
            max_torque: 0.0,
        };
        world.step(&Input { hand: Some(hand), ..Input::default() });
    }
    let turned = |&i: &u32| {
        let turn = pose(&world, i).1 * pose(settled, i).1.inverse();
        2.0 * libm::atan2(turn.z, turn.w)
    };
    let mean = above.iter().map(turned).sum::<f64>() / above.len() as f64;
    mean / axis.dot(pose(&world, body).0 - start)
}
