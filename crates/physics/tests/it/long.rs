//! Long runs: memory stays flat, and what is at rest stays where it is. Linux only, as memory is
//! read from `/proc`.
//!
//! `PART=0.1 cargo test --release -p teeter-physics --test it -- long --ignored --test-threads 1`
//! runs a tenth of each.
#![cfg(target_os = "linux")]

use crate::common::*;
use teeter_physics::{Input, Params, World};

/// Part of each run, from the environment.
fn part() -> f64 {
    std::env::var("PART").map_or(1.0, |text| text.parse().expect("PART is a number"))
}

/// Resident memory of the process, bytes.
fn memory() -> f64 {
    let text = std::fs::read_to_string("/proc/self/statm").expect("/proc is mounted");
    let pages: f64 = text.split(' ').nth(1).and_then(|field| field.parse().ok()).expect("the second field is a number");
    pages * 4096.0
}

/// Repeats an action, and asserts that memory after the first tenth and at the end are the same.
fn assert_flat(count: usize, mut action: impl FnMut(usize)) {
    let mut before = 0.0;
    for i in 0..count {
        action(i);
        if i == count / 10 {
            before = memory();
        }
    }
    let growth = memory() / before - 1.0;
    println!("{count} times: memory {:.1} MB, growth {growth:.4}", before / 1e6);
    assert!(growth < 0.01, "memory grew by {growth}");
}

#[test]
#[ignore = "an hour of simulated time"]
fn an_hour_of_rest_needs_no_more_memory_and_drifts_by_less_than_a_nanometre() {
    let mut world = World::new(&teeter_scene::named("tower").unwrap(), awake()).unwrap();
    run(&mut world, 10.0, &Input::default());
    let before = poses(&world);
    assert_flat((216_000.0 * part()) as usize, |_| {
        world.step(&Input::default());
    });
    let drift = displacement(&before, &world);
    println!("drift {drift:e} m");
    assert!(drift < 1e-9, "{drift:e} m");
}

#[test]
#[ignore = "half an hour of simulated time"]
fn half_an_hour_of_collapses_needs_no_more_memory() {
    let scene = teeter_scene::named("tower").unwrap();
    let mut world = World::new(&scene, Params::default()).unwrap();
    let start = world.snapshot();
    // Each collapse takes 5 s, and begins with a ground that tilts.
    assert_flat((108_000.0 * part()) as usize, |frame| {
        if frame % 300 == 0 {
            world.restore(&start).unwrap();
        }
        world.step(&if frame % 300 < 90 { tilted(0.6) } else { Input::default() });
    });
}

#[test]
#[ignore = "ten thousand worlds"]
fn ten_thousand_worlds_leave_no_memory_behind() {
    let scene = teeter_scene::named("tower").unwrap();
    let params = Params { ramp: 0.3, ..Params::default() };
    assert_flat((10_000.0 * part()) as usize, |_| {
        let mut world = World::new(&scene, params).unwrap();
        world.step(&Input::default());
        let snapshot = world.snapshot();
        world.restore(&snapshot).unwrap();
    });
}
