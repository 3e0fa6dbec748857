//! Table 5.2, and culling that only saves work.

use teeter_dissertation::jenga3d::counters::{Counters, tests};
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Jenga3D};
use teeter_scene::{Scene, TowerOptions, named, tower};

fn full(rows: u32) -> Scene {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap()
}

/// Returns the counts of one step of a tower at rest as means over a frame, with both calls of
/// `CollideBlocks` in full: before any test, and after each.
fn count(rows: u32, listed_boxes: bool) -> [u64; 5] {
    let constants =
        Constants { listed_boxes, skip_unchanged: false, disabling: Disabling::Off, ..Constants::default() };
    let mut tower = Jenga3D::new(&full(rows), constants).unwrap();
    for _ in 0..30 {
        tower.frame(None);
    }
    let steps = u64::from(tower.constants.mid_loop_count);
    let mut sum = Counters::default();
    for _ in 0..steps {
        sum += tower.step(None).first;
    }
    [sum.potential, sum.after_blocks, sum.after_boxes, sum.after_planes, sum.collisions].map(|sum| sum / steps)
}

#[test]
fn counts_without_culling_follow_the_formula() {
    // Section 4.4.3 counts 52 blocks.
    assert_eq!(tests(52), 445_536);
    // The columns of Table 5.2 say blocks but count rows of three, and both calls of
    // `CollideBlocks`.
    for (rows, printed) in [(6, 102_816), (9, 235_872), (18, 961_632)] {
        assert_eq!(2 * tests(3 * rows), printed);
    }
    for rows in [6, 9] {
        assert_eq!(count(rows, false)[0], 2 * tests(3 * u64::from(rows)));
    }
}

#[test]
fn boxes_of_blocks_leave_adjacent_rows() {
    // Printed: nine pairs for each two adjacent rows. A settled tower adds blocks in contact within
    // a row.
    for (rows, printed) in [(6u32, 30_240), (9, 48_384), (18, 102_816)] {
        assert_eq!(u64::from(rows - 1) * 9 * 2 * 336, printed);
    }
    let [_, after_blocks, after_boxes, ..] = count(6, false);
    assert!((20_000..60_000).contains(&after_blocks), "{after_blocks}");
    assert!(after_boxes < after_blocks / 3, "{after_boxes}");
}

/// With boxes compared as Figure 5.5 lists it, the remaining tests are a third of the printed ones
/// or more, and not above. Compared correctly, the boxes leave a sixth of that.
#[test]
fn listed_boxes_leave_about_the_printed_tests() {
    for (rows, printed) in [(6, [8_274, 174, 40]), (9, [13_480, 213, 67])] {
        let (listed, corrected) = (count(rows, true), count(rows, false));
        for (ours, printed) in listed[2..].iter().zip(printed) {
            assert!(*ours > printed / 3 && *ours < printed, "{rows} rows: {ours} for {printed}");
        }
        // "About 4-5 times more than the actual amount of collisions" (5.4.1).
        assert!((3..6).contains(&(listed[3] / listed[4])), "{listed:?}");
        assert!(listed[2] > 5 * corrected[2], "{listed:?} {corrected:?}");
        // Equal up to corners that miss a face by less than the tolerance.
        assert!(listed[4].abs_diff(corrected[4]) <= 1, "{listed:?} {corrected:?}");
    }
}

/// Culling changes no bit of the result.
#[test]
fn culling_only_saves_work() {
    let run = |culling: Culling, skip_unchanged: bool, listed_boxes: bool| {
        let constants = Constants { culling, skip_unchanged, listed_boxes, ..Constants::default() };
        let mut scene = Jenga3D::new(&named("test-6").unwrap(), constants).unwrap();
        let mut collisions = 0;
        for _ in 0..600 {
            collisions += scene.step(None).all.collisions;
        }
        (scene.curr, collisions)
    };
    let default = run(Culling::Planes, true, false);
    assert!(default.1 > 100);
    for (culling, skip, listed) in [
        (Culling::None, false, false),
        (Culling::Blocks, false, false),
        (Culling::Boxes, false, false),
        (Culling::Planes, false, false),
        (Culling::None, true, false),
        (Culling::Planes, true, true),
    ] {
        assert!(run(culling, skip, listed) == default, "{culling:?} {skip} {listed}");
    }
}
