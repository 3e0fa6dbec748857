//! Scenes of the greatest size run in limited memory.
#![cfg(target_os = "linux")]

use std::process::Command;

use teeter_scene::{Block, Scene, named};

/// Address space of the program, kB.
const LIMIT: u32 = 1_000_000;

/// Rods of 10 m side by side on the floor, at an angle to the axes, `pitch` (m) apart.
fn rods(count: u32, pitch: f64) -> Scene {
    let mut scene = named("block").expect("the list has it");
    let rod = |i: u32| {
        let along = pitch * f64::from(i) * std::f64::consts::FRAC_1_SQRT_2;
        let block = Block::new(i, [10.0, 0.01, 0.01], 0.6, [-along, along, 0.005]);
        Block { yaw: std::f64::consts::FRAC_PI_4, ..block }
    };
    scene.blocks = (0..count).map(rod).collect();
    scene
}

/// Each rod has the bounds of 470 others before it: nearly as many pairs as are accepted.
#[test]
#[ignore = "takes a minute"]
fn twenty_thousand_rods_of_ten_metres_run_within_a_gigabyte() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rods.json");
    std::fs::write(&path, rods(20_000, 0.0213).to_json()).unwrap();
    let program = env!("CARGO_BIN_EXE_teeter");
    let limited = format!("ulimit -v {LIMIT}; exec {program} run {} --seconds 0.05 --json", path.display());
    let done = Command::new("sh").args(["-c", &limited]).output().unwrap();
    let error = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{error}");
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!((&report["stands"], error.as_ref()), (&true.into(), ""), "{report}");
}
