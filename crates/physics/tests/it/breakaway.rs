//! Breakaway force of blocks of a settled tower, in single precision compared with double.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{AppliedForce, BodyId, Input, Params, Precision, World};
use teeter_scene::{TowerOptions, tower};

/// Force along the block's long axis at which it has moved by 0.5 mm, N; the force grows by 0.25
/// N/s.
fn breakaway_force(world: &mut World, body: usize) -> f64 {
    let axis = orientation(world, body) * DVec3::X;
    let start = position(world, body);
    let mut force = 0.0;
    while (position(world, body) - start).dot(axis) < 5e-4 {
        force += 0.25 * world.params().frame;
        assert!(force < 8.0, "block {body} does not start");
        let forces = vec![AppliedForce::at_center(BodyId(body as u32), axis * force)];
        world.step(&Input { forces, ..Input::default() });
    }
    force
}

#[test]
fn single_precision_has_the_breakaway_forces_of_double() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let [single, double] = [Precision::Single, Precision::Double]
        .map(|precision| World::new(&scene, Params { sleep: false, precision, ..Params::default() }).unwrap());
    let mut settled = double.clone();
    run(&mut settled, 5.0, &Input::default());
    let state = settled.snapshot();
    let mut loose = 0;
    for body in (0..settled.len()).step_by(5) {
        let [one, other] = [&single, &double].map(|world| {
            let mut world = world.clone();
            world.restore(&state).unwrap();
            breakaway_force(&mut world, body)
        });
        loose += usize::from(other < 0.15);
        // One frame is 0.004 N.
        assert!((one - other).abs() < 0.01, "block {body}: {one} N and {other} N");
    }
    assert!((1..8).contains(&loose), "{loose} of the blocks are loose");
}
