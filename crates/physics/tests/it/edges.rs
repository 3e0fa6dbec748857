//! Edges: seams, and blocks that lean on each other.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{Input, World};
use teeter_scene::{Block, Form, Scene};

/// Two planks that lie flush, and a block on the first that slides towards the second at `speed`
/// (m/s).
fn seam(speed: f64) -> Scene {
    let plank = |id, x| Block::new(id, [0.2, 0.3, 0.02], 5.0, [x, 0.0, 0.01]);
    let block = Block { velocity: [speed, 0.0, 0.0], ..Block::new(2, SIZE, MASS, [-0.05, 0.0, 0.029]) };
    Scene { friction: 0.3, blocks: vec![plank(0, 0.0), plank(1, 0.2), block], ..one() }
}

#[test]
fn a_block_slides_over_a_flush_seam_as_if_there_were_none() {
    for form in [Form::Rigid, Form::Lattice] {
        for (stiffness, edge_radius) in [1e4, 1e5, 1e6, 1e7].into_iter().flat_map(|k| [(k, 0.0), (k, 1e-4)]) {
            for speed in [1.2, 0.7] {
                let scene = Scene { form, stiffness, edge_radius, ..seam(speed) };
                let mut world = World::new(&scene, awake()).unwrap();
                run(&mut world, 1.0, &Input::default());
                let (distance, right) = (position(&world, 2).x + 0.05, speed * speed / (2.0 * 0.3 * G));
                let error = distance / right - 1.0;
                assert!(error.abs() < 5e-3, "{form} {stiffness:e} N/m, radius {edge_radius}: {distance} m");
            }
        }
    }
}

/// Two blocks that lean against each other at `angle` (rad) off the vertical.
fn frame(angle: f64, edge_radius: f64) -> Scene {
    let size = [SIZE[2], SIZE[1], SIZE[0]];
    let (sin, cos) = libm::sincos(angle);
    // Rounded edges recede from the sharp ones, at the floor and at the top.
    let core = [0.5 * size[0] - edge_radius, 0.5 * size[2] - edge_radius];
    let (x, z) = (core[0] * cos + core[1] * sin + edge_radius, core[1] * cos + core[0] * sin + edge_radius);
    let block = |id: u32, side: f64| Block {
        orientation: Some([0.0, -side * libm::sin(0.5 * angle), 0.0, libm::cos(0.5 * angle)]),
        ..Block::new(id, size, MASS, [side * x, 0.0, z])
    };
    Scene { edge_radius, blocks: vec![block(0, -1.0), block(1, 1.0)], ..one() }
}

/// Kinetic energy and that in gravity, J.
fn energy(world: &World) -> f64 {
    let of = |body| {
        let (twist, pose, mass) = (world.twist(body), world.pose(body), world.mass(body));
        let spin = pose.orientation.conjugate() * twist.spin;
        let l = world.size(body) * world.size(body);
        let inertia = mass / 12.0 * DVec3::new(l.y + l.z, l.z + l.x, l.x + l.y);
        mass * (G * pose.position.z + 0.5 * twist.velocity.length_squared()) + 0.5 * spin.dot(inertia * spin)
    };
    world.bodies().map(of).sum()
}

/// The horizontal force at the top is m g (tan(angle) - width / length) / 2 by the moments about
/// the foot, since the normal there is level; the floor must bear it by friction.
#[test]
fn blocks_that_lean_together_stand_from_the_friction_that_statics_asks_for() {
    for form in [Form::Rigid, Form::Lattice] {
        for (stiffness, radius) in [(1e6, 0.0), (1e6, 3e-4), (1e7, 0.0), (1e7, 3e-4)] {
            for degrees in [14.0f64, 22.5, 30.0, 40.0] {
                let angle = degrees.to_radians();
                let least = 0.5 * (libm::tan(angle) - SIZE[2] / SIZE[0]);
                let what = format!("{form} {stiffness:e} N/m, radius {radius}, {degrees} degrees");
                let stands = |friction: f64| {
                    let scene = Scene { form, stiffness, friction, ..frame(angle, radius) };
                    let mut world = World::new(&scene, awake()).unwrap();
                    let (start, at) = (energy(&world), position(&world, 0));
                    for _ in 0..120 {
                        world.step(&Input::default());
                        let gain = energy(&world) / start - 1.0;
                        assert!(gain < 1e-6, "{what}, friction {friction}: the energy grows by {gain:e}");
                    }
                    (position(&world, 0) - at).length() < 1e-6
                };
                assert!(stands(least + 0.01), "{what}: falls");
                assert!(least < 0.01 || !stands(least - 0.01), "{what}: stands without the friction it needs");
            }
        }
    }
}
