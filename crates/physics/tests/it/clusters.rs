//! Clusters: towers that cannot touch are stepped independently, with the same result.

use crate::common::*;
use glam::DVec3;
use teeter_physics::{BodyId, BuildError, Drive, Input, Params, Twist, World};
use teeter_scene::{Block, Scene, TowerOptions, tower};

/// A tower alone, and together with another one `apart` (m) from it along x.
fn two(apart: f64) -> (Scene, Scene) {
    let alone = tower(&TowerOptions { rows: 6, seed: 3, ..TowerOptions::default() }).unwrap();
    let other = tower(&TowerOptions { rows: 5, seed: 8, ..TowerOptions::default() }).unwrap();
    let mut both = alone.clone();
    let beside = |b: &Block| Block { id: b.id + 100, pos: [b.pos[0] + apart, b.pos[1], b.pos[2]], ..b.clone() };
    both.blocks.extend(other.blocks.iter().map(beside));
    (alone, both)
}

/// Input that sweeps a row out of the first tower at 1.5 m/s.
fn sweep(frame: u32) -> Input {
    let drive = |body| Drive { body: BodyId(body), velocity: DVec3::new(0.0, 1.5, 0.0), max_force: 50.0 };
    Input {
        drives: if (30..40).contains(&frame) { (3..6).map(drive).collect() } else { Vec::new() },
        ..Input::default()
    }
}

#[test]
fn a_tower_far_from_another_moves_as_if_it_were_alone_bit_for_bit() {
    let (alone, both) = two(3.0);
    for params in both_formats() {
        let (mut one, mut two) = (World::new(&alone, params).unwrap(), World::new(&both, params).unwrap());
        for frame in 0..150 {
            one.step(&sweep(frame));
            two.step(&sweep(frame));
            assert_eq!(one.poses(), &two.poses()[..one.poses().len()], "frame {frame}");
        }
        let highest = (0..one.len()).map(|i| position(&one, i).z).fold(0.0, f64::max);
        assert!(highest < 0.1, "the tower did not fall");
    }
}

fn both_formats() -> [Params; 2] {
    both().map(|params| Params { sleep: true, ..params })
}

#[test]
fn a_fast_block_from_outside_hits_the_tower_and_penetrates_nothing() {
    let (mut scene, _) = two(1.0);
    scene.blocks.push(Block { yaw: 1.0, ..Block::new(99, SIZE, MASS, [0.6, 0.0, 0.05]) });
    for speed in [0.5, 3.0, 12.0] {
        let mut world = World::new(&scene, Params::default()).unwrap();
        run(&mut world, 0.4, &Input { gravity: Some(DVec3::ZERO), ..Input::default() });
        let shot = world.len() - 1;
        world.set_twist(BodyId(shot as u32), Twist::linear(DVec3::new(-speed, 0.0, 0.0)));
        let before = poses(&world);
        let mut deepest: f64 = 0.0;
        for _ in 0..120 {
            deepest = deepest.max(world.step(&Input { gravity: Some(DVec3::ZERO), ..Input::default() }).penetration);
        }
        let moved = (0..shot).map(|i| (position(&world, i) - before[i].position).length()).fold(0.0, f64::max);
        assert!(moved > 0.01, "at {speed} m/s nothing was hit");
        assert!(deepest < 2e-3, "at {speed} m/s it was inside by {} mm", deepest * 1e3);
        assert!(position(&world, shot).x > -0.1 || moved > 0.1, "at {speed} m/s it came out behind the tower");
    }
}

#[test]
fn a_block_rotated_into_another_cluster_is_detected_there() {
    let mut world = World::new(&blocks(&[[0.0, 0.0, 0.009], [0.0, 0.05, 0.009]]), awake()).unwrap();
    run(&mut world, 0.5, &Input::default());
    // Its end now overlaps the other block.
    world.set_orientation(BodyId(1), glam::DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2));
    assert!(world.penetration() > 1e-3);
    run(&mut world, 0.5, &Input::default());
    // They part no faster than a depth that is free of force fades, by 0.45 mm: else they would be
    // thrown apart.
    let distance = position(&world, 0).distance(position(&world, 1));
    assert!((0.0502..0.05045).contains(&distance), "{distance}");
}

#[test]
fn a_field_in_collapse_restores_bit_for_bit() {
    let (_, both) = two(0.25);
    let mut world = World::new(&both, Params::default()).unwrap();
    for frame in 0..60 {
        world.step(&sweep(frame));
        if frame % 7 == 3 {
            let mut other = World::new(&both, Params::default()).unwrap();
            other.restore(&world.snapshot()).unwrap();
            assert_eq!(other.hash(), world.hash());
            let mut same = world.clone();
            for later in frame + 1..frame + 12 {
                assert_eq!(same.step(&sweep(later)), other.step(&sweep(later)));
            }
            assert_eq!(same.hash(), other.hash());
        }
    }
}

#[test]
fn a_sleeping_tower_beside_a_falling_one_sleeps_on() {
    let (alone, both) = two(3.0);
    let mut world = World::new(&both, Params::default()).unwrap();
    run(&mut world, 3.0, &Input::default());
    let first = alone.blocks.len() as u32;
    assert!((0..world.len() as u32).all(|i| world.is_asleep(BodyId(i))));
    for frame in 30..60 {
        world.step(&sweep(frame));
        assert!((first..world.len() as u32).all(|i| world.is_asleep(BodyId(i))));
    }
    assert!(!world.is_asleep(BodyId(3)));
}

/// Long blocks side by side at an angle: the bounds of all of them overlap, which no memory holds.
#[test]
fn more_neighbours_than_memory_holds_are_refused() {
    let rods = |count: u32| {
        let mut scene = one();
        let rod = |i: u32| {
            let d = 0.0006 * f64::from(i);
            let pos = [-d * 0.5f64.sqrt(), d * 0.5f64.sqrt(), 0.00025];
            Block { yaw: std::f64::consts::FRAC_PI_4, ..Block::new(i, [10.0, 0.0005, 0.0005], 0.1, pos) }
        };
        scene.blocks = (0..count).map(rod).collect();
        scene
    };
    let error = World::new(&rods(20_000), Params::default()).unwrap_err();
    assert_eq!(error, BuildError::Crowded { limit: 10_000_000 });
    assert!(World::new(&rods(20), Params::default()).is_ok());
}
