//! Disabling of blocks: the listed rule, and the rule by rigid motion (sections 4.7 and 6.3).

use crate::common::settled;
use glam::DVec3;
use teeter_dissertation::jenga3d::{Constants, Disabling, Hand, HandMode, Jenga3D};
use teeter_scene::{Block, BlockPreset, Scene, TowerOptions, named, tower};

fn rows(rows: u32) -> Scene {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap()
}

fn rigid() -> Constants {
    Constants { disabling: Disabling::Rigid, ..Constants::default() }
}

fn disabled(jenga: &Jenga3D) -> usize {
    jenga.model.blocks.iter().filter(|block| !block.active).count()
}

/// The rule of appendix 2.5 disables most blocks of a resting tower, and leaves some enabled,
/// because they vibrate: 12 of 18 in Figure 6.22. Switched off, it disables none.
#[test]
fn the_listed_rule_disables_most_blocks_and_not_all() {
    let mut six = settled(&rows(6), Constants::default(), 120);
    let counts: Vec<usize> = (0..60)
        .map(|_| {
            six.frame(None);
            disabled(&six)
        })
        .collect();
    let mean = counts.iter().sum::<usize>() as f64 / counts.len() as f64;
    assert!((10.0..17.5).contains(&mean), "{mean}: {counts:?}");
    assert!(counts.iter().any(|n| *n < 18), "{counts:?}");
    let mut off = settled(&rows(6), Constants { disabling: Disabling::Off, ..Constants::default() }, 60);
    for _ in 0..160 {
        off.step(None);
        assert_eq!(disabled(&off), 0);
    }
}

/// A block that the listed rule disables is put back: it ends the step where it began.
#[test]
fn a_disabled_block_ends_its_step_where_it_began() {
    let mut four = settled(&rows(4), Constants::default(), 60);
    let mut seen = 0;
    for _ in 0..400 {
        let before = four.curr.clone();
        four.step(None);
        for block in four.model.blocks.iter().filter(|block| !block.active) {
            seen += 1;
            for p in block.corners() {
                assert_eq!(four.curr[p].position, before[p].position);
            }
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// A threshold of zero disables nothing, not even a block that does not move at all.
#[test]
fn a_threshold_of_zero_disables_nothing() {
    let constants = Constants { gravity: 0.0, row_spacing: 0.5, disable_threshold: 0.0, ..Constants::default() };
    let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
    for _ in 0..20 {
        let before = one.curr[0].position;
        one.step(None);
        assert_eq!((one.curr[0].position, disabled(&one)), (before, 0));
    }
}

/// Returns the speed that a blow gives a disabled block in the very step of the blow, m/s: a block
/// that falls on it at three metres a second.
fn speed_after_a_blow(reactivation_impulse: f64) -> f64 {
    let (size, mass) = (BlockPreset::Dissertation.size(), BlockPreset::Dissertation.mass());
    let mut scene = named("block").unwrap();
    let above = [scene.blocks[0].pos[0], scene.blocks[0].pos[1], scene.blocks[0].pos[2] + size[2] + 0.3];
    // Across the lower one, so that its edges meet those of the other.
    scene.blocks.push(Block { yaw: std::f64::consts::FRAC_PI_2, ..Block::new(1, size, mass, above) });
    let constants = Constants { reactivation_impulse, ..rigid() };
    let mut two = Jenga3D::new(&scene, constants).unwrap();
    two.model.blocks[0].active = false;
    let lower = two.model.blocks[0].corners();
    for state in &mut two.curr[lower.clone()] {
        state.velocity = DVec3::ZERO;
    }
    two.throw(1, DVec3::new(0.0, 0.0, -2.0));
    let speed = |jenga: &Jenga3D| jenga.curr[lower.clone()].iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
    for _ in 0..10_000 {
        if two.step(None).all.collisions > 0 {
            return speed(&two);
        }
        assert_eq!(speed(&two), 0.0);
    }
    panic!("the blocks never met")
}

/// Section 4.7: a disabled block is fixed until the impulse of a collision is above the threshold.
#[test]
fn a_big_impulse_reactivates_a_disabled_block() {
    assert!(speed_after_a_blow(2e-3) > 0.1);
    assert_eq!(speed_after_a_blow(1.0), 0.0);
}

/// A block that moves wakes the blocks that it touches, without a blow.
#[test]
fn a_drawn_block_wakes_its_neighbours() {
    let constants = Constants { reactivation_impulse: 1.0, hand: HandMode::Velocity, ..rigid() };
    let mut four = settled(&rows(4), constants, 90);
    assert_eq!(disabled(&four), 12);
    // The middle block of the third row, along itself.
    let axis = if (four.centres()[8] - four.centres()[6]).x.abs() > 0.01 { DVec3::Y } else { DVec3::X };
    let start = four.centres()[7];
    for frame in 1..20 {
        four.frame(Some(&Hand { block: 7, target: start + 1e-3 * f64::from(frame) * axis }));
    }
    let awake: Vec<usize> = (0..12).filter(|n| four.model.blocks[*n].active).collect();
    assert!(awake.contains(&7) && awake.len() > 1, "{awake:?}");
    // One of the rows that it touches.
    assert!(awake.iter().any(|n| (3..6).contains(n) || (9..12).contains(n)), "{awake:?}");
}

/// A block that turns in place is not at rest; one that vibrates on its springs is.
#[test]
fn a_block_that_turns_in_place_stays_enabled() {
    let floating = |velocity: &dyn Fn(DVec3) -> DVec3| {
        let constants = Constants { gravity: 0.0, row_spacing: 0.5, damping: 0.0, ..rigid() };
        let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
        let centre = one.centres()[0];
        for state in &mut one.curr {
            state.velocity = velocity(state.position - centre);
        }
        for _ in 0..60 {
            one.frame(None);
        }
        one
    };
    // 0.04 m at 0.1 rad/s is 1 mm in the quarter of a second.
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        let turning = floating(&|arm| 0.1 * axis.cross(arm));
        assert!(turning.model.blocks[0].active, "{axis}");
        let centre = turning.centres()[0];
        assert!(centre.truncate().length() < 1e-9, "{centre}");
    }
    // 1 mm/s of breathing: a corner travels far more than the limit, and comes back.
    let breathing = floating(&|arm| 0.02 * arm);
    assert!(!breathing.model.blocks[0].active);
}

/// A thrown block rests again only after the whole time of rest.
#[test]
fn a_thrown_block_starts_its_rest_again() {
    let constants = Constants { gravity: 0.0, row_spacing: 0.5, ..rigid() };
    let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
    let frames = |one: &mut Jenga3D, count: u32| {
        for _ in 0..count {
            one.frame(None);
        }
    };
    // A quarter of a second is 15 frames.
    frames(&mut one, 14);
    one.throw(0, DVec3::ZERO);
    frames(&mut one, 14);
    assert_eq!(disabled(&one), 0);
    frames(&mut one, 2);
    assert_eq!(disabled(&one), 1);
}

/// The distance is the largest that still counts as rest: at zero a block rests that does not move
/// at all.
#[test]
fn a_block_that_does_not_move_rests_within_no_distance() {
    let constants = Constants { gravity: 0.0, rest_distance: 0.0, ..rigid() };
    let mut one = Jenga3D::new(&named("block").unwrap(), constants).unwrap();
    let start = one.curr.clone();
    for _ in 0..20 {
        one.frame(None);
    }
    assert!(one.curr.iter().zip(&start).all(|(now, start)| now.position == start.position));
    assert_eq!(disabled(&one), 1);
}
