//! Start of a world: what bears on the floor carries its weight from the first instant, what is in
//! the air falls, and what cannot stand begins where the scene has it.

use crate::common::*;
use teeter_physics::{BodyId, Input, Params, World};
use teeter_scene::{CardsOptions, Scene, TowerOptions, cards, tower};

/// Largest displacement of a body from where it begins, m, over `seconds`.
fn displacement(scene: &Scene, seconds: f64) -> f64 {
    let mut world = World::new(scene, awake()).unwrap();
    let initial = poses(&world);
    let mut largest = 0.0f64;
    for _ in 0..world.frames(seconds) {
        world.step(&Input::default());
        let moved = |body: BodyId| world.pose(body).position.distance(initial[body.index()].position);
        largest = world.bodies().map(moved).fold(largest, f64::max);
    }
    largest
}

#[test]
fn a_tower_of_forty_rows_does_not_sway_at_the_start() {
    for seed in [1, 2] {
        let scene = tower(&TowerOptions { rows: 40, seed, ..TowerOptions::default() }).unwrap();
        let moved = displacement(&scene, 3.0);
        assert!(moved < 1e-4, "seed {seed}: it moves by {} mm", 1e3 * moved);
    }
}

#[test]
fn a_house_of_seven_storeys_stands_from_the_start() {
    for storeys in [4, 7] {
        let moved = displacement(&cards(storeys, &CardsOptions::default()).unwrap(), 3.0);
        assert!(moved < 1e-5, "{storeys} storeys: it moves by {} mm", 1e3 * moved);
    }
}

#[test]
fn a_block_in_the_air_falls_with_gravity_from_the_first_instant() {
    let (height, mut world) = (0.1, World::new(&blocks(&[[0.0, 0.0, 0.109]]), Params::default()).unwrap());
    let (mut hit, mut speed) = (0.0, 0.0);
    for _ in 0..10 {
        let before = (world.time(), world.twist(BodyId(0)).velocity.z, position(&world, 0).z);
        world.step(&Input::default());
        let (time, fallen) = (world.time(), height + 0.009 - position(&world, 0).z);
        if time < (2.0 * height / G).sqrt() {
            assert!((fallen / (0.5 * G * time * time) - 1.0).abs() < 0.01, "{fallen} m after {time} s");
        } else if hit == 0.0 {
            // from the frame before on, in free fall
            let left = before.2 - 0.009;
            let flight = ((before.1 * before.1 + 2.0 * G * left).sqrt() + before.1) / G;
            (hit, speed) = (before.0 + flight, G * flight - before.1);
        }
    }
    assert!((hit - 0.1428).abs() < 1e-3 && (speed - 1.4007).abs() < 0.01, "hits after {hit} s at {speed} m/s");
}

#[test]
fn a_block_that_cannot_stand_begins_in_the_pose_of_the_scene() {
    let scene = blocks(&[[0.0, 0.0, 0.009], [0.045, 0.0, 0.027]]);
    let world = World::new(&scene, Params::default()).unwrap();
    for (block, body) in scene.blocks.iter().zip(world.bodies()) {
        assert_eq!(world.pose(body).position.to_array(), block.pos);
    }
}
