//! Six static tests of section 6.1.1, and standing towers.

use teeter_dissertation::jenga3d::{Constants, Jenga3D};
use teeter_scene::{Scene, TowerOptions, named, tower};

/// Returns the maximum displacement of a block since half a second of settling, and the maximum
/// drop, mm.
fn moves(scene: &Scene, seconds: f64, constants: Constants) -> (f64, f64) {
    let mut simulator = Jenga3D::new(scene, constants).unwrap();
    let mut start = simulator.centres();
    for frame in 0..(60.0 * seconds) as u32 {
        if frame == 30 && simulator.centres().iter().zip(&start).all(|(now, was)| now.distance(*was) < 2e-3) {
            start = simulator.centres();
        }
        simulator.frame(None);
    }
    let moved = simulator.centres().iter().zip(&start).map(|(now, was)| 1e3 * now.distance(*was)).fold(0.0, f64::max);
    let dropped = simulator.centres().iter().zip(&start).map(|(now, was)| 1e3 * (was.z - now.z)).fold(0.0, f64::max);
    (moved, dropped)
}

fn stands(name: &str) -> bool {
    let (moved, dropped) = moves(&named(name).unwrap(), 3.0, Constants::default());
    moved < 5.0 && dropped < 3.0
}

/// The second is marginal: with blocks of nominal size it is short of balance by 0.15 mm, and
/// falls.
#[test]
fn six_static_tests_stand_or_fall() {
    for (name, expected) in
        [("test-1", true), ("test-2", false), ("test-3", false), ("test-4", false), ("test-5", true), ("test-6", true)]
    {
        assert_eq!(stands(name), expected, "{name}");
    }
}

#[test]
fn six_rows_stand() {
    let (moved, dropped) =
        moves(&tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap(), 3.0, Constants::default());
    assert!(moved < 1.0 && dropped < 0.5, "{moved} {dropped}");
}
