//! Release of a block close above another: it lands there. Without detection in time it would fall
//! into the other block within a frame and be thrown out at 5 m/s.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{BodyId, Hand, Input, World};

#[test]
fn a_block_released_close_above_another_lands_on_it() {
    for params in both() {
        for gap in [1e-5, 5e-5, 2e-4, 1e-3] {
            let mut world = World::new(&blocks(&[[0.0, 0.0, 0.009], [0.0, 0.0, 0.057]]), params).unwrap();
            let hand = |target: DVec3| Input::hand(Hand::carry(BodyId(1), DVec3::ZERO, target, glam::DQuat::IDENTITY));
            let (from, to) = (position(&world, 1), DVec3::new(0.0, 0.0, 0.027 + gap));
            run(&mut world, 1.0, &hand(from));
            for i in 1..=30 {
                world.step(&hand(from.lerp(to, f64::from(i) / 30.0)));
            }
            run(&mut world, 0.5, &hand(to));
            let (mut deepest, mut highest): (f64, f64) = (0.0, 0.0);
            for _ in 0..60 {
                deepest = deepest.max(world.step(&Input::default()).penetration);
                highest = highest.max(position(&world, 1).z - 0.027);
            }
            assert!(deepest < 5e-5, "{gap} m above: {deepest} m inside");
            assert!(highest <= gap, "{gap} m above: thrown {highest} m high");
        }
    }
}
