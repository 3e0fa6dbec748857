//! Parts of a block, and the behaviour of its springs.

use glam::DVec3;
use teeter_dissertation::jenga3d::face::normal;
use teeter_dissertation::jenga3d::forces::{Sources, compute_forces};
use teeter_dissertation::jenga3d::hand::{drag_in_depth, drag_in_plane};
use teeter_dissertation::jenga3d::pick::{Ray, pick};
use teeter_dissertation::jenga3d::{Constants, Disabling, Hand, HandMode, Jenga3D, block::*};
use teeter_scene::{TowerOptions, named, tower};

fn still() -> Constants {
    Constants { gravity: 0.0, disabling: Disabling::Off, ..Constants::default() }
}

#[test]
fn a_block_has_its_parts() {
    let one = Jenga3D::new(&named("block").unwrap(), Constants::default()).unwrap();
    assert_eq!((one.model.particles.len(), one.model.springs.len(), one.model.faces.len()), (8, 28, 12));
    assert_eq!(one.model.springs.iter().filter(|s| s.edge).count(), 12);
    let mut pairs: Vec<[u32; 2]> = one.model.springs.iter().map(|s| [s.p1.min(s.p2), s.p1.max(s.p2)]).collect();
    pairs.sort();
    pairs.dedup();
    assert_eq!(pairs.len(), 28);
    // The edges are as long as the sides of the block.
    let mut lengths: Vec<f64> = one.model.springs[..EDGES].iter().map(|s| (1e6 * s.rest_length).round()).collect();
    lengths.dedup();
    assert_eq!(lengths, [81000.0, 26800.0, 18000.0]);
}

#[test]
fn faces_are_clockwise_and_cover_the_block() {
    let one = Jenga3D::new(&named("block").unwrap(), Constants::default()).unwrap();
    let centre = one.model.blocks[0].centre(&one.curr);
    let mut area = 0.0;
    let edges: Vec<[u32; 2]> = one.model.springs[..EDGES].iter().map(|s| [s.p1, s.p2]).collect();
    for face in &one.model.faces {
        let [a, b, c] = face.corners().map(|p| one.curr[p as usize].position);
        let out = normal(a, b, c);
        assert!(out.dot((a + b + c) / 3.0 - centre) > 0.0);
        area += 0.5 * out.length();
        // Corners clockwise from outside have an inward right-handed normal.
        assert!((b - a).cross(c - a).dot(out) < 0.0);
        let edge = |p: u32, q: u32| edges.contains(&[p, q]) || edges.contains(&[q, p]);
        assert!(edge(face.p1, face.p2) && edge(face.p2, face.p3) && !edge(face.p3, face.p1));
    }
    let [x, y, z] = [0.081, 0.0268, 0.018];
    assert!((area - 2.0 * (x * y + y * z + z * x)).abs() < 1e-12);
}

/// A displaced corner returns, and the centre of mass stays.
#[test]
fn a_block_regains_its_shape() {
    let mut one = Jenga3D::new(&named("block").unwrap(), still()).unwrap();
    one.curr[7].position += 1e-3 * DVec3::ONE;
    let centre = one.model.blocks[0].centre(&one.curr);
    for _ in 0..60 {
        one.frame(None);
    }
    assert!(one.model.energy(&one.curr) < 1e-9, "{} J", one.model.energy(&one.curr));
    assert!(one.model.blocks[0].centre(&one.curr).distance(centre) < 1e-9);
}

/// Spring forces have no resultant and no moment, for any shape.
#[test]
fn springs_are_equal_and_opposite() {
    let mut one = Jenga3D::new(&named("block").unwrap(), still()).unwrap();
    for (n, state) in one.curr.iter_mut().enumerate() {
        let k = n as f64;
        state.position += 1e-3 * DVec3::new(libm::sin(k), libm::sin(2.0 * k), libm::sin(3.0 * k));
        state.velocity = DVec3::new(libm::cos(k), libm::cos(2.0 * k), libm::cos(3.0 * k));
    }
    let sources = Sources { user: None, contacts: &[], time: one.constants.force_step() };
    compute_forces(&one.model, &one.constants, &sources, &mut one.curr);
    let largest = one.curr.iter().map(|s| s.force.length()).fold(0.0, f64::max);
    let force: DVec3 = one.curr.iter().map(|s| s.force).sum();
    let torque: DVec3 = one.curr.iter().map(|s| s.position.cross(s.force)).sum();
    assert!(largest > 1.0);
    assert!(force.length() < 1e-12 * largest && torque.length() < 1e-12 * largest, "{force} {torque}");
}

/// Returns the maximum relative gain of energy while two blocks collide corner first in free space,
/// and asserts that momentum is conserved.
fn gain(restitution: f64, damping: f64, mid_loop_count: u32) -> f64 {
    let constants =
        Constants { restitution, damping, mid_loop_count, friction_enabled: false, row_spacing: 0.01, ..still() };
    let mut two = Jenga3D::new(&named("test-4").unwrap(), constants).unwrap();
    // The third block is removed from the collision.
    let third = two.model.blocks[2].corners();
    for (n, state) in two.curr.iter_mut().enumerate() {
        let k = n as f64;
        let thrown = if n < 8 { DVec3::new(0.0, 0.1, 1.0) } else { DVec3::new(0.05, 0.0, -0.5) };
        state.velocity = if third.contains(&n) {
            10.0 * DVec3::X
        } else {
            thrown + 0.05 * DVec3::new(libm::sin(k), libm::cos(k), 0.0)
        };
        state.position.z += 1.0;
    }
    let masses: Vec<f64> = two.model.particles.iter().map(|p| p.mass).collect();
    let momentum = |s: &Jenga3D| s.curr.iter().zip(&masses).map(|(p, m)| *m * p.velocity).sum::<DVec3>();
    // Euler's method conserves the energy plus half a step of power; the energy alone oscillates.
    let energy = |s: &Jenga3D| {
        let mut states = s.curr.clone();
        let sources = Sources { user: None, contacts: &[], time: s.constants.force_step() };
        compute_forces(&s.model, &s.constants, &sources, &mut states);
        let power: f64 = states.iter().map(|s| s.velocity.dot(s.force)).sum();
        s.model.energy(&s.curr) + 0.5 * s.constants.force_step() * power
    };
    let (start, first, mut max, mut hits) = (momentum(&two), energy(&two), 0.0, 0);
    for _ in 0..10 * mid_loop_count / 2 {
        hits += two.step(None).all.collisions;
        assert!(momentum(&two).distance(start) < 1e-12, "{restitution}");
        max = energy(&two).max(max);
    }
    assert!(hits > 0);
    max / first - 1.0
}

/// An impulse adds no energy to its particles, as `collision.rs` shows. Its position correction may
/// load the springs: by a thousandth of the energy with the default step, and less with shorter
/// ones.
#[test]
fn colliding_blocks_gain_hardly_any_energy() {
    for (restitution, damping) in [(1.0, 0.0), (0.5, 0.0), (0.0, 2.0)] {
        let (default, fine) = (gain(restitution, damping, 160), gain(restitution, damping, 3200));
        println!("{restitution} {damping}: {default} {fine}");
        assert!(default < 2e-3 && fine < 1e-4, "{restitution}: gains {default} and {fine}");
    }
}

/// A block in the air falls by g t²/2.
#[test]
fn blocks_fall_freely() {
    let mut one =
        Jenga3D::new(&named("block").unwrap(), Constants { row_spacing: 0.1, ..Constants::default() }).unwrap();
    let start = one.centres()[0].z;
    for _ in 0..6 {
        one.frame(None);
    }
    let t = 0.1;
    let fallen = start - one.centres()[0].z;
    // Euler's method leads by half a step.
    assert!((fallen - 0.5 * 9.81 * t * t).abs() < 9.81 * t * one.constants.force_step(), "{fallen}");
}

/// Force and velocity as methods of the hand (section 5.6).
#[test]
fn the_hybrid_hand_neither_overshoots_nor_yields() {
    let carry = |hand: HandMode| {
        let constants = Constants { hand, row_spacing: 0.1, ..Constants::default() };
        let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
        let target = one.centres()[0] + DVec3::new(0.05, 0.0, 0.05);
        let mut overshoot = 0.0f64;
        for _ in 0..60 {
            one.frame(Some(&Hand { block: 0, target }));
            overshoot = overshoot.max((one.centres()[0] - target).x);
        }
        (overshoot, one.centres()[0].distance(target))
    };
    // A force makes the block overshoot in the air; a velocity does not.
    assert!(carry(HandMode::Force).0 > 0.02);
    for hand in [HandMode::Velocity, HandMode::Hybrid] {
        let (past, off) = carry(hand);
        assert!(past < 1e-3 && off < 2e-3, "{hand:?}: {past} {off}");
    }
    let push_tower = |hand: HandMode| {
        let constants = Constants { hand, ..Constants::default() };
        let mut six =
            Jenga3D::new(&tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap(), constants).unwrap();
        for _ in 0..15 {
            six.frame(None);
        }
        let target = six.centres()[1] + 5e-3 * DVec3::X;
        let before = six.centres()[1].x;
        for _ in 0..15 {
            six.frame(Some(&Hand { block: 1, target }));
        }
        six.centres()[1].x - before
    };
    // 40 N/m over 5 mm is 0.2 N, which moves no loaded block of the bottom row; a written velocity
    // does. Against the tower the hybrid is a force.
    let [force, velocity, hybrid] = [HandMode::Force, HandMode::Velocity, HandMode::Hybrid].map(push_tower);
    assert!(velocity > 4.5e-3, "{velocity}");
    assert!(force < 1e-3 && hybrid < 1e-3, "{force} {hybrid}");
}

/// Drag alone slows a sliding block (section 5.7.2), and without drag and friction nothing does.
#[test]
fn drag_slows_a_sliding_block_without_friction() {
    let slide = |drag: f64| {
        let constants = Constants { drag, friction: 0.0, disabling: Disabling::Off, ..Constants::default() };
        let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
        for _ in 0..30 {
            one.frame(None);
        }
        for state in &mut one.curr {
            state.velocity.x += 0.4;
        }
        for _ in 0..30 {
            one.frame(None);
        }
        one.model.blocks[0].velocity(&one.curr).x / 0.4
    };
    let (free, slow, slower) = (slide(0.0), slide(0.05), slide(0.1));
    assert!((free - 1.0).abs() < 1e-6, "{free}");
    // A drag of k slows as exp(-k t / m): twice the drag squares the ratio.
    assert!(slow < 0.8 && (slower / (slow * slow) - 1.0).abs() < 0.1, "{slow} {slower}");
}

/// The ray takes the first block that it meets (section 4.8.1), from either side.
#[test]
fn a_ray_picks_the_nearest_block() {
    let three =
        Jenga3D::new(&tower(&TowerOptions { rows: 1, ..TowerOptions::default() }).unwrap(), Constants::default());
    let three = three.unwrap();
    let centres = three.centres();
    let across = (centres[2] - centres[0]).normalize();
    for (from, expected) in [(-1.0, 0), (1.0, 2)] {
        let ray = Ray { origin: centres[1] + 0.5 * from * across, direction: -2.0 * from * across };
        let (block, distance) = pick(&three.model, &three.curr, &ray).expect("blocks on the ray");
        assert_eq!(block, expected);
        let face = 0.5 - centres[0].distance(centres[1]) - 0.0134;
        assert!((2.0 * distance - face).abs() < 1e-3, "{distance}");
    }
    let beside = Ray { origin: centres[1] + 0.5 * across + 0.1 * DVec3::Z, direction: -across };
    assert_eq!(pick(&three.model, &three.curr, &beside), None);
    let behind = Ray { origin: centres[1] + 0.5 * across, direction: across };
    assert_eq!(pick(&three.model, &three.curr, &behind), None);
}

/// The left button moves a block to where the ray of the pointer meets the plane through its centre
/// that faces the viewer, the right one along the line of sight (section 4.8).
#[test]
fn drags_end_in_the_plane_of_the_screen_and_in_depth() {
    let ray = Ray { origin: DVec3::new(1.0, 2.0, 5.0), direction: DVec3::new(0.5, 0.25, -2.0) };
    let centre = DVec3::new(7.0, -3.0, 1.0);
    assert_eq!(drag_in_plane(&ray, DVec3::Z, centre), Some(DVec3::new(2.0, 2.5, 1.0)));
    let towards_viewer = DVec3::new(0.6, 0.0, 0.8);
    let target = drag_in_plane(&ray, towards_viewer, centre).expect("the ray is not parallel to the plane");
    assert!((target - centre).dot(towards_viewer).abs() < 1e-12, "{target}");
    assert!((target - ray.origin).cross(ray.direction).length() < 1e-12, "{target}");
    let parallel = Ray { direction: DVec3::X, ..ray };
    assert_eq!(drag_in_plane(&parallel, DVec3::Z, centre), None);

    let pulled = drag_in_depth(towards_viewer, centre, 0.5);
    assert!(pulled.distance(DVec3::new(7.3, -3.0, 1.4)) < 1e-12, "{pulled}");
    assert!(drag_in_depth(towards_viewer, pulled, -0.5).distance(centre) < 1e-12);
}
