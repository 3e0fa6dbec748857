//! Edges: seams, and blocks that lean on each other.

mod common;

use common::*;
use glam::DVec3;
use teeter_physics::{BodyId, Input, Params, World};
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
        for stiffness in [1e4, 1e5, 1e6, 1e7] {
            for edge_radius in [0.0, 1e-4, 3e-4] {
                for speed in [1.2, 0.7] {
                    let mut world =
                        World::new(&Scene { form, stiffness, edge_radius, ..seam(speed) }, awake()).unwrap();
                    run(&mut world, 1.0, &Input::default());
                    let (distance, right) = (position(&world, 2).x + 0.05, speed * speed / (2.0 * 0.3 * G));
                    println!(
                        "{form} {stiffness:e} {edge_radius} {speed}: {:.3} {:.2} %",
                        distance * 1e3,
                        (distance / right - 1.0) * 100.0
                    );
                }
            }
        }
    }
}

/// Two blocks that lean against each other at `angle` (rad) off the vertical.
fn frame(angle: f64, edge_radius: f64) -> Scene {
    let size = [SIZE[2], SIZE[1], SIZE[0]];
    // The rounded edges recede from the sharp ones, at the floor and at the top.
    let (sin, cos) = (angle.sin(), angle.cos());
    let core = [0.5 * size[0] - edge_radius, 0.5 * size[2] - edge_radius];
    let (x, z) = (core[0] * cos + core[1] * sin + edge_radius, core[1] * cos + core[0] * sin + edge_radius);
    let block = |id: u32, side: f64| Block {
        orientation: Some([0.0, -side * (0.5 * angle).sin(), 0.0, (0.5 * angle).cos()]),
        ..Block::new(id, size, MASS, [side * x, 0.0, z])
    };
    Scene { edge_radius, blocks: vec![block(0, -1.0), block(1, 1.0)], ..one() }
}

fn energy(world: &World) -> f64 {
    world
        .bodies()
        .map(|body| {
            let (twist, pose) = (world.twist(body), world.pose(body));
            let spin = pose.orientation.conjugate() * twist.spin;
            let l = world.size(body);
            let inertia = DVec3::new(l.y * l.y + l.z * l.z, l.z * l.z + l.x * l.x, l.x * l.x + l.y * l.y) / 12.0;
            world.mass(body)
                * (G * pose.position.z + 0.5 * twist.velocity.length_squared() + 0.5 * spin.dot(inertia * spin))
        })
        .sum()
}

#[test]
fn blocks_that_lean_together_stand_from_the_friction_that_statics_asks_for() {
    for form in [Form::Rigid, Form::Lattice] {
        for stiffness in [1e6, 1e7] {
            for radius in [0.0, 3e-4] {
                for degrees in [14.0f64, 22.5, 30.0, 40.0] {
                    let angle = degrees.to_radians();
                    let right = (angle.tan() - 18.0 / 81.0) / 2.0;
                    for offset in [0.01, -0.01] {
                        let friction = right + offset;
                        if friction < 0.0 {
                            continue;
                        }
                        let scene = Scene { form, stiffness, friction, ..frame(angle, radius) };
                        let mut world = World::new(&scene, awake()).unwrap();
                        let start = energy(&world);
                        let at = position(&world, 0);
                        let mut gain = 0.0f64;
                        let mut last = 0.0;
                        for f in 0..120 {
                            world.step(&Input::default());
                            let e = energy(&world) / start - 1.0;
                            if e > last + 1e-5 && e > 0.0 {
                                println!("  frame {f}: {last:.2e} to {e:.2e}");
                            }
                            last = e;
                            gain = gain.max(e);
                        }
                        println!(
                            "{form} {stiffness:e} r {radius} {degrees} mu {friction:.3} ({offset}): moved {:.6} mm from scene {:.6}, energy {:+.1e}",
                            (position(&world, 0) - at).length() * 1e3,
                            (position(&world, 0) - DVec3::from(scene.blocks[0].pos)).length() * 1e3,
                            gain
                        );
                    }
                }
            }
        }
    }
    let _ = (BodyId(0), Params::default());
}

#[test]
fn probe() {
    let scene = Scene { stiffness: 1e6, friction: 0.188, ..frame(30f64.to_radians(), 3e-4) };
    let mut world = World::new(&scene, awake()).unwrap();
    for f in 0..6 {
        for b in world.bodies() {
            println!("{f} body {b} {:?} {:?}", world.pose(b).position * 1e3, world.twist(b).velocity);
            for c in world.contacts(b) {
                println!("    {:?} n {:?} f {:.5}", c.other, c.normal, c.force);
            }
        }
        let r = world.step(&Input::default());
        println!("{r:?}");
    }
}
