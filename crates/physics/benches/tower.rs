//! What a frame of 1/60 s costs. Every figure is printed with the hash of the state it ended in: a change of speed that changes the
//! hash is another computation.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use teeter_physics::{Drive, Input, Params, Precision, World};
use teeter_scene::{Scene, TowerOptions, tower};

/// A settled tower of 18 rows.
fn settled(stiffness: f64, params: Params) -> World {
    let scene = Scene { stiffness, ..tower(&TowerOptions::default()).unwrap() };
    let mut world = World::new(&scene, params).unwrap();
    (0..120).for_each(|_| drop(world.step(&Input::default())));
    world
}

fn awake(precision: Precision) -> Params {
    Params { precision, sleep: false, ..Params::default() }
}

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("full tower");
    group.sample_size(20);
    for (name, stiffness, params) in [
        ("awake, k = 3e5, f32", 3e5, awake(Precision::Single)),
        ("awake, k = 1e6, f32", 1e6, awake(Precision::Single)),
        ("awake, k = 3e6, f32", 3e6, awake(Precision::Single)),
        ("awake, k = 1e6, f64", 1e6, awake(Precision::Double)),
        ("asleep", 1e6, Params::default()),
    ] {
        let mut world = settled(stiffness, params);
        while params.sleep && !(0..world.len() as u32).all(|i| world.asleep(i)) {
            world.step(&Input::default());
        }
        let state = world.snapshot();
        world.step(&Input::default());
        println!("{name}: after one frame {:016x}", world.hash());
        group.bench_function(name, |b| {
            world.restore(&state).unwrap();
            b.iter(|| world.step(&Input::default()));
        });
    }

    // a second of a full collapse, from the moment that two rows are swept away
    let mut world = settled(1e6, awake(Precision::Single));
    let sweep = |body| Drive { body, velocity: DVec3::new(2.0, 0.5, 0.0), max_force: 100.0 };
    let drives: Vec<Drive> = (6..12).map(sweep).collect();
    (0..12).for_each(|_| drop(world.step(&Input { drives: drives.clone(), ..Input::default() })));
    let state = world.snapshot();
    let second = |world: &mut World| (0..60).for_each(|_| drop(world.step(&Input::default())));
    second(&mut world);
    println!("collapse: after a second {:016x}", world.hash());
    group.bench_function("collapse, one second", |b| {
        b.iter(|| {
            world.restore(&state).unwrap();
            second(&mut world);
        });
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
