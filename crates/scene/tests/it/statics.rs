//! Statics of the named scenes that are no towers of the game: each expected answer by hand.

use glam::{DQuat, DVec3};
use teeter_scene::{Block, Scene, Stability, named, overlap};

fn scene(name: &str, expect: Stability) -> Scene {
    let scene = named(name).unwrap();
    assert_eq!(scene.label, Some(expect.to_string()));
    // All are in contact from the start, but for rounding.
    assert!(overlap::pairs(&scene, 1e-12).is_empty(), "{name}");
    scene
}

/// Lower corner of a block in the world, m: `x` and `y` are -1 or 1.
fn lower_corner(b: &Block, x: f64, y: f64) -> DVec3 {
    let local = 0.5 * DVec3::from_array(b.size) * DVec3::new(x, y, -1.0);
    DVec3::from_array(b.pos) + DQuat::from_array(b.rotation()) * local
}

/// Sum of mass times distance along x, kg m.
fn moment(blocks: &[Block]) -> f64 {
    blocks.iter().map(|b| b.mass * b.pos[0]).sum()
}

/// Above each edge, the centre of mass is inside by 0.02 half lengths.
#[test]
fn the_tower_of_lire_has_eight_tenths_of_a_millimetre_to_spare() {
    let scene = scene("lire", Stability::Stable);
    for (i, below) in scene.blocks[..9].iter().enumerate() {
        let above = &scene.blocks[i + 1..];
        let centre = moment(above) / above.iter().map(|b| b.mass).sum::<f64>();
        let edge = below.pos[0] + 0.5 * below.size[0];
        assert!((edge - centre - 0.02 * 0.0405).abs() < 1e-15, "above block {i}: {}", edge - centre);
    }
    let [base, top] = [&scene.blocks[0], &scene.blocks[9]];
    assert!(top.pos[0] - 0.5 * top.size[0] > base.pos[0] + 0.5 * base.size[0], "the top one is beyond the base");
}

/// Each side bears half of the last block at its inner end at worst. Above each edge, the centre of
/// mass with that load is inside by a tenth of half a length.
#[test]
fn the_arch_has_four_millimetres_to_spare_at_each_edge() {
    let scene = scene("arch", Stability::Stable);
    let (last, sides) = scene.blocks.split_last().unwrap();
    assert_eq!((last.pos[0], moment(sides).abs() < 1e-15), (0.0, true));
    let side = &sides[..sides.len() / 2];
    let end = side[side.len() - 1].pos[0] + 0.5 * last.size[0];
    assert!(end < 0.0 && -end < 0.5 * last.size[0], "the last block reaches from side to side");
    for (i, below) in side[..side.len() - 1].iter().enumerate() {
        let above = &side[i + 1..];
        let mass = above.iter().map(|b| b.mass).sum::<f64>() + 0.5 * last.mass;
        let centre = (moment(above) + 0.5 * last.mass * end) / mass;
        let edge = below.pos[0] + 0.5 * below.size[0];
        assert!((edge - centre - 0.1 * 0.0405).abs() < 1e-15, "above block {i}: {}", edge - centre);
    }
}

#[test]
fn the_see_saw_has_no_moment_about_its_ridge() {
    let scene = scene("see-saw", Stability::Stable);
    assert!(scene.blocks[0].fixed);
    assert!(moment(&scene.blocks[1..]).abs() < 1e-15);
    // One block more on either side would tip it.
    let load: f64 = scene.blocks[1..].iter().map(|b| b.mass).sum();
    assert!(scene.blocks[2].mass * 0.06 > load * 0.5 * scene.blocks[0].size[0]);
}

/// The plate has its lower edge on the floor, and the tower stands on it as it does on the level.
#[test]
fn the_slope_is_below_the_angle_of_friction_and_of_toppling() {
    let scene = scene("slope", Stability::Stable);
    let (plate, tower) = scene.blocks.split_last().unwrap();
    assert!(plate.fixed && overlap::lowest_point(plate, 0.0).abs() < 1e-15);
    let normal = DQuat::from_array(plate.rotation()) * DVec3::Z;
    let slope = normal.angle_between(DVec3::Z);
    assert!((slope - 15f64.to_radians()).abs() < 1e-12);
    assert!(libm::tan(slope) < scene.friction);
    // The centre of mass is 54 mm above the plate and 40.5 mm from the edge.
    assert!(libm::tan(slope) < 0.0405 / 0.054);
    let touching = tower.iter().filter(|b| overlap::depth(b, plate).abs() < 1e-12).count();
    assert_eq!((tower.len(), touching), (18, 3));
}

/// The first domino has its centre of mass beyond the edge on which it stands.
#[test]
fn the_first_domino_falls_on_the_second() {
    let scene = scene("dominoes", Stability::Unstable);
    let (first, second) = (&scene.blocks[0], &scene.blocks[1]);
    let edge = lower_corner(first, 1.0, 0.0);
    assert!((edge - DVec3::new(edge.x, 0.0, 0.0)).length() < 1e-15, "the edge is on the floor");
    assert!(first.pos[0] > edge.x + 0.001);
    assert!(overlap::depth(first, second) < -0.001, "the first stands free");
    assert!(second.pos[0] - 0.5 * second.size[0] - edge.x < first.size[2], "its top reaches the second");
    assert_eq!(scene.blocks.len(), 20);
}

/// Every joint is in the middle of the brick above, and all courses have the same ends.
#[test]
fn the_wall_is_in_running_bond() {
    let scene = scene("wall", Stability::Stable);
    let course = |i: usize| -> Vec<&Block> {
        scene.blocks.iter().filter(|b| ((b.pos[2] / 0.065 - 0.5).round() as usize) == i).collect()
    };
    for i in 0..6 {
        let bricks = course(i);
        assert_eq!(bricks.len(), if i % 2 == 0 { 5 } else { 6 });
        let ends = (bricks[0], bricks[bricks.len() - 1]);
        let length = ends.1.pos[0] + 0.5 * ends.1.size[0] - (ends.0.pos[0] - 0.5 * ends.0.size[0]);
        assert!((length - (5.0 * 0.215 + 4.0 * 0.001)).abs() < 1e-12, "{length}");
        for pair in bricks.windows(2) {
            let joint = pair[1].pos[0] - 0.5 * pair[1].size[0] - (pair[0].pos[0] + 0.5 * pair[0].size[0]);
            assert!((joint - 0.001).abs() < 1e-12, "{joint}");
            let middle = 0.5 * (pair[0].pos[0] + 0.5 * pair[0].size[0] + pair[1].pos[0] - 0.5 * pair[1].size[0]);
            if i % 2 == 0 {
                assert!(course(i + 1).iter().any(|above| (above.pos[0] - middle).abs() < 1e-12), "{middle}");
            }
        }
    }
}
