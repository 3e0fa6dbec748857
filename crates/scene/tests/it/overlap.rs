//! Overlap of blocks in any orientation: invariance, samples, closed forms, and sweeps.

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use teeter_scene::{Block, MAX_OVERLAP, Scene, named, overlap};

const SIZE: [f64; 3] = [0.081, 0.0268, 0.018];

fn rotation() -> impl Strategy<Value = DQuat> {
    prop::array::uniform4(-1.0..1.0f64)
        .prop_map(DQuat::from_array)
        .prop_filter("a direction", |q| q.length_squared() > 0.01)
        .prop_map(DQuat::normalize)
}

fn offset() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-0.06..0.06f64).prop_map(DVec3::from_array)
}

/// Block of the default size with its centre 1 m above the floor and an offset from there.
fn block(id: u32, offset: DVec3, q: DQuat) -> Block {
    let pos = (offset + DVec3::Z).to_array();
    Block { orientation: Some(q.to_array()), ..Block::new(id, SIZE, 0.02, pos) }
}

/// Point of a block's own frame in the world.
fn to_world(b: &Block, local: DVec3) -> DVec3 {
    DVec3::from_array(b.pos) + DQuat::from_array(b.rotation()) * local
}

/// True for a point inside a block by more than `margin`, m.
fn contains(b: &Block, point: DVec3, margin: f64) -> bool {
    let local = DQuat::from_array(b.rotation()).inverse() * (point - DVec3::from_array(b.pos));
    (0.5 * DVec3::from_array(b.size) - margin - local.abs()).min_element() > 0.0
}

/// True if a point of a grid in one block is inside the other.
fn share_a_grid_point(a: &Block, b: &Block, steps: i32) -> bool {
    let at = |i: i32, size: f64| (f64::from(i) / f64::from(steps) - 0.5) * size;
    (0..=steps).any(|i| {
        (0..=steps).any(|j| {
            (0..=steps).any(|k| {
                let local = DVec3::new(at(i, a.size[0]), at(j, a.size[1]), at(k, a.size[2]));
                contains(b, to_world(a, local), 0.0)
            })
        })
    })
}

fn scene_of(blocks: Vec<Block>) -> Scene {
    Scene { blocks, ..named("block").unwrap() }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 300, ..ProptestConfig::default() })]

    /// The depth of upright blocks, which is computed in plan, and that of the same blocks turned
    /// as one.
    #[test]
    fn a_common_rotation_leaves_the_depth(offset in offset(), yaw in -3.0..3.0f64, q in rotation()) {
        let a = Block::new(0, SIZE, 0.02, [0.0; 3]);
        let b = Block { yaw, ..Block::new(1, SIZE, 0.02, offset.to_array()) };
        let in_plan = overlap::depth(&a, &b);
        let own = DQuat::from_array(b.rotation());
        let turned = overlap::depth(&block(0, DVec3::ZERO, q), &block(1, q * offset, q * own));
        if in_plan > 0.0 {
            prop_assert!((turned - in_plan).abs() < 1e-12, "{turned} {in_plan}");
        } else {
            // Apart, the depth in plan is no distance, and at least minus it.
            prop_assert!(turned <= in_plan + 1e-12, "{turned} {in_plan}");
        }
    }

    #[test]
    fn depth_is_symmetric(offset in offset(), q in rotation(), r in rotation(), radius in 0.0..0.005f64) {
        let (a, b) = (block(0, DVec3::ZERO, q), block(1, offset, r));
        let (there, back) = (overlap::rounded_depth(&a, &b, radius), overlap::rounded_depth(&b, &a, radius));
        prop_assert!((there - back).abs() < 1e-12, "{there} {back}");
    }

    /// A grid point of one block is inside the other only if the depth is positive, and some point
    /// is inside if the depth exceeds the spacing of the grid.
    #[test]
    fn depth_agrees_with_a_grid_of_points(offset in offset(), q in rotation(), r in rotation()) {
        let (a, b) = (block(0, DVec3::ZERO, q), block(1, offset, r));
        let depth = overlap::depth(&a, &b);
        let is_shared = share_a_grid_point(&a, &b, 24) || share_a_grid_point(&b, &a, 24);
        if is_shared {
            prop_assert!(depth > 0.0, "{depth}");
        }
        // Grid points are within 1.8 mm of each point of the block.
        if depth > 4e-3 {
            prop_assert!(is_shared, "{depth}");
        }
    }

    /// Moving the second block along the direction by the depth separates the two; half of that
    /// does not.
    #[test]
    fn the_direction_is_that_of_the_depth(offset in offset(), q in rotation(), r in rotation(), radius in 0.0..0.005f64) {
        let mut scene = scene_of(vec![block(0, DVec3::ZERO, q), block(1, offset, r)]);
        scene.edge_radius = radius;
        let Some(found) = overlap::pairs(&scene, 1e-4).pop() else { return Ok(()) };
        let direction = DVec3::from_array(found.direction);
        prop_assert!((direction.length() - 1.0).abs() < 1e-12);
        let moved = |by: f64| block(1, offset + direction * by, r);
        let after = overlap::rounded_depth(&scene.blocks[0], &moved(found.depth), radius);
        prop_assert!(after.abs() < 1e-12, "{after}");
        let before = overlap::rounded_depth(&scene.blocks[0], &moved(0.5 * found.depth), radius);
        prop_assert!(before > 0.4 * found.depth, "{before} of {}", found.depth);
    }

    /// The gap between rounded blocks that are apart is the distance of their cores less twice the
    /// radius, and the distance of the cores is at most that of any two of their points.
    #[test]
    fn a_gap_is_at_most_the_distance_of_any_two_points(offset in offset(), q in rotation(), r in rotation()) {
        let (a, b) = (block(0, DVec3::ZERO, q), block(1, offset, r));
        let gap = -overlap::depth(&a, &b);
        prop_assume!(gap > 0.0);
        let steps = 6;
        let grid = |b: &Block| -> Vec<DVec3> {
            let at = |i: i32, size: f64| (f64::from(i) / f64::from(steps) - 0.5) * size;
            (0..(steps + 1) * (steps + 1) * (steps + 1)).map(|n| {
                let (i, j, k) = (n % (steps + 1), n / (steps + 1) % (steps + 1), n / (steps + 1) / (steps + 1));
                to_world(b, DVec3::new(at(i, b.size[0]), at(j, b.size[1]), at(k, b.size[2])))
            }).collect()
        };
        let others = grid(&b);
        let nearest = grid(&a).iter().flat_map(|p| others.iter().map(|o| p.distance(*o))).fold(f64::INFINITY, f64::min);
        // Grid points are within 7.4 mm of each point of the block.
        prop_assert!(gap <= nearest + 1e-12 && nearest < gap + 0.015, "{gap} {nearest}");
        let radius = 0.002;
        let (mut wide_a, mut wide_b) = (a.clone(), b.clone());
        for side in wide_a.size.iter_mut().chain(wide_b.size.iter_mut()) {
            *side += 2.0 * radius;
        }
        let rounded = overlap::rounded_depth(&wide_a, &wide_b, radius);
        prop_assert!((rounded - (2.0 * radius - gap)).abs() < 1e-12, "{rounded} {gap}");
    }

    #[test]
    fn the_lowest_point_is_that_of_the_corners(offset in offset(), q in rotation()) {
        let b = block(0, offset, q);
        let corner = |i: usize| {
            let sign = |bit: usize| if i & bit == 0 { -0.5 } else { 0.5 };
            to_world(&b, DVec3::from_array(b.size) * DVec3::new(sign(1), sign(2), sign(4)))
        };
        let lowest = (0..8).map(|i| corner(i).z).fold(f64::INFINITY, f64::min);
        prop_assert!((overlap::lowest_point(&b, 0.0) - lowest).abs() < 1e-12);
    }

    /// The sweep finds the pairs that a test of all of them finds.
    #[test]
    fn a_sweep_finds_every_pair(
        poses in prop::collection::vec((prop::array::uniform3(-0.2..0.2f64), rotation(), any::<bool>()), 2..30),
        radius in prop_oneof![Just(0.0), Just(0.003)],
    ) {
        let blocks = poses.iter().enumerate().map(|(i, (at, q, fixed))| {
            Block { fixed: *fixed, ..block(i as u32, DVec3::from_array(*at), *q) }
        });
        let scene = Scene { edge_radius: radius, ..scene_of(blocks.collect()) };
        let mut all = Vec::new();
        for (i, a) in scene.blocks.iter().enumerate() {
            for (j, b) in scene.blocks.iter().enumerate().skip(i + 1) {
                if !(a.fixed && b.fixed) && overlap::rounded_depth(a, b, radius) > 1e-4 {
                    all.push((i, j));
                }
            }
        }
        let found = overlap::pairs(&scene, 1e-4);
        prop_assert_eq!(found.iter().map(|f| (f.first, f.second)).collect::<Vec<_>>(), all);
        prop_assert_eq!(overlap::first_pair(&scene, 1e-4), found.first().copied());
    }
}

/// Two cubes on their edges, whose edges cross at a right angle: only the common normal of the
/// edges separates them.
#[test]
fn crossing_edges_overlap_by_their_own_depth() {
    let half = std::f64::consts::FRAC_PI_8;
    let (s, c) = libm::sincos(half);
    let edge = 0.05 * 2f64.sqrt();
    let a = Block { orientation: Some([s, 0.0, 0.0, c]), ..Block::new(0, [0.1; 3], 1.0, [0.0, 0.0, edge]) };
    let above = 3.0 * edge - 1e-3;
    let b = Block { orientation: Some([0.0, s, 0.0, c]), ..Block::new(1, [0.1; 3], 1.0, [0.0, 0.0, above]) };
    assert!((overlap::depth(&a, &b) - 1e-3).abs() < 1e-15);
    let pair = overlap::pairs(&scene_of(vec![a, b]), 1e-6)[0];
    assert!((DVec3::from_array(pair.direction) - DVec3::Z).length() < 1e-12);
}

/// Edges that lean against each other touch in a level line: neither has a face along it.
#[test]
fn rounded_edges_that_face_each_other_touch_at_twice_the_radius() {
    let (radius, half) = (0.002, 0.3);
    let (s, c) = libm::sincos(half);
    let lean = |id, sign: f64, x| Block {
        orientation: Some([0.0, sign * s, 0.0, c]),
        ..Block::new(id, [0.02, 0.1, 0.1], 1.0, [x, 0.0, 0.2])
    };
    // Half the width of a leaning block: its core along x, and the radius.
    let (sin, cos) = libm::sincos(2.0 * half);
    let reach = (0.01 - radius) * cos + (0.05 - radius) * sin + radius;
    for gap in [-1e-4, 0.0, 1e-4] {
        let depth =
            overlap::rounded_depth(&lean(0, 1.0, -reach - gap / 2.0), &lean(1, -1.0, reach + gap / 2.0), radius);
        assert!((depth + gap).abs() < 1e-15, "{depth} {gap}");
    }
}

#[test]
fn overlaps_of_rounding_are_accepted_and_deeper_ones_are_named() {
    let mut scene = named("column").unwrap();
    for (depth, is_valid) in [(0.0, true), (0.9 * MAX_OVERLAP, true), (1.1 * MAX_OVERLAP, false)] {
        scene.blocks[9].pos[2] = 0.171 - depth;
        assert_eq!(scene.validate().is_ok(), is_valid, "{depth}");
    }
    let error = scene.validate().unwrap_err().to_string();
    assert_eq!(error, "blocks 8 and 9: `pos` makes them overlap by 0.022 mm, expected at most 0.02 mm");
    let error = overlap::pairs(&scene, 1e-6);
    assert_eq!(error.len(), 1);
}

#[test]
fn fixed_blocks_may_overlap_each_other_and_the_floor() {
    let fixed = |id, z| Block { fixed: true, ..Block::new(id, SIZE, 0.02, [0.0, 0.0, z]) };
    let mut scene = scene_of(vec![fixed(0, 0.0), fixed(1, 0.005)]);
    assert_eq!(scene.validate(), Ok(()));
    assert_eq!(overlap::pairs(&scene, 1e-6), []);
    scene.blocks[1].fixed = false;
    let error = scene.validate().unwrap_err().to_string();
    assert_eq!(
        error,
        "block 1: `pos` is 5.000 mm above the floor at its centre, expected at least half its height, 9.000 mm"
    );
    scene.blocks[1].pos[2] = 0.0175;
    let error = scene.validate().unwrap_err().to_string();
    assert_eq!(error, "blocks 0 and 1: `pos` makes them overlap by 0.500 mm, expected at most 0.02 mm");
}

#[test]
fn a_tilted_block_has_its_lowest_corner_on_the_floor() {
    let (s, c) = libm::sincos(std::f64::consts::FRAC_PI_8);
    let mut scene =
        scene_of(vec![Block { orientation: Some([s, 0.0, 0.0, c]), ..Block::new(4, [0.1; 3], 1.0, [0.0; 3]) }]);
    scene.blocks[0].pos[2] = 0.05 * 2f64.sqrt();
    assert_eq!(scene.validate(), Ok(()));
    scene.blocks[0].pos[2] -= 1e-3;
    assert_eq!(
        scene.validate().unwrap_err().to_string(),
        "block 4: `pos` is 69.711 mm above the floor at its centre, expected at least the height of its centre above its lowest corner, 70.711 mm"
    );
    // Rounded edges leave room below.
    scene.edge_radius = 0.01;
    assert_eq!(scene.validate(), Ok(()));
}

/// As many blocks as a scene may have, one upon the other at the same position.
#[test]
fn the_number_of_pairs_is_limited() {
    let block = named("block").unwrap().blocks.remove(0);
    let blocks = (0..2000).map(|id| Block { id, ..block.clone() }).collect();
    assert_eq!(overlap::pairs(&scene_of(blocks), 1e-6).len(), overlap::MAX_PAIRS);
}

/// Side by side at an angle, so that all bounds overlap: two hundred million pairs, of which the
/// sweep visits those beside each other.
#[test]
fn twenty_thousand_rods_at_an_angle_are_tested_along_a_diagonal() {
    let mut scene = named("block").unwrap();
    let rod = |i: u32| {
        let d = 0.0006 * f64::from(i);
        let yaw = std::f64::consts::FRAC_PI_4;
        Block { yaw, ..Block::new(i, [10.0, 0.0005, 0.0005], 0.1, [-d * 0.5f64.sqrt(), d * 0.5f64.sqrt(), 0.00025]) }
    };
    scene.blocks = (0..20_000).map(rod).collect();
    assert_eq!(scene.validate(), Ok(()));
    // One that is moved onto its neighbour is found.
    scene.blocks[7000].pos = scene.blocks[7001].pos;
    let found = overlap::first_pair(&scene, 1e-6).unwrap();
    assert_eq!((found.first, found.second), (7000, 7001));
}
