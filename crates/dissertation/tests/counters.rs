//! Table 5.2, and that culling only saves work.

use teeter_dissertation::jenga3d::counters::{StepCounts, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{Scene, TowerOptions, named, tower};

fn full(rows: u32) -> Scene {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap()
}

/// Counts of one step of a tower at rest, both calls of `CollideBlocks` in full.
fn count(rows: u32) -> StepCounts {
    let constants = Constants { skip_unchanged: false, disabling: Disabling::Off, ..Constants::default() };
    let mut tower = Jenga3D::new(&full(rows), constants).unwrap();
    for _ in 0..30 {
        tower.frame(None);
    }
    tower.step(None)
}

#[test]
fn without_culling_it_is_the_formula() {
    // Section 4.4.3 for the 52 blocks that it counts.
    assert_eq!(tests(52), 445_536);
    // The columns of Table 5.2 are headed blocks, but hold rows of three, and both calls of `CollideBlocks` in a step.
    for (rows, printed) in [(6, 102_816), (9, 235_872), (18, 961_632)] {
        assert_eq!(2 * tests(3 * rows), printed);
    }
    for rows in [6, 9] {
        assert_eq!(count(rows).first.potential, 2 * tests(3 * u64::from(rows)));
    }
}

#[test]
fn boxes_of_blocks_leave_neighbouring_rows() {
    // Printed: nine pairs for each two neighbouring rows. Boxes of a tower that has settled are those, and what has moved together in a row.
    for (rows, printed) in [(6u32, 30_240), (9, 48_384), (18, 102_816)] {
        assert_eq!(u64::from(rows - 1) * 9 * 2 * 336, printed);
    }
    let counts = count(6).first;
    assert!((20_000..60_000).contains(&counts.after_blocks), "{counts:?}");
    // Each test leaves less, and the last leave of the order of what the table has: 174 and 40.
    assert!(counts.after_boxes < counts.after_blocks / 3, "{counts:?}");
    assert!((17..1740).contains(&counts.after_planes), "{counts:?}");
    assert!((4..400).contains(&counts.collisions), "{counts:?}");
}

/// Culling changes no bit of the result.
#[test]
fn culling_only_saves_work() {
    let run = |culling: Culling, skip_unchanged: bool| {
        let constants = Constants { culling, skip_unchanged, ..Constants::default() };
        let mut scene = Jenga3D::new(&named("test-6").unwrap(), constants).unwrap();
        let mut collisions = 0;
        for _ in 0..600 {
            collisions += scene.step(None).all.collisions;
        }
        (scene.curr, collisions)
    };
    let usual = run(Culling::Planes, true);
    assert!(usual.1 > 100);
    for (culling, skip) in
        [(Culling::None, false), (Culling::Blocks, false), (Culling::Boxes, false), (Culling::Planes, false), (Culling::None, true)]
    {
        assert!(run(culling, skip) == usual, "{culling:?} {skip}");
    }
}
