//! Future work of section 6.3: static friction, disabling by rigid motion, orders of pairs.

use glam::DVec3;
use teeter_dissertation::jenga3d::{Constants, Disabling, Hand, HandMode, Jenga3D, Order};
use teeter_scene::{Scene, TowerOptions, named, tower};

fn six_rows() -> Scene {
    tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap()
}

fn settled(scene: &Scene, constants: Constants, frames: u32) -> Jenga3D {
    let mut simulator = Jenga3D::new(scene, constants).unwrap();
    for _ in 0..frames {
        simulator.frame(None);
    }
    simulator
}

fn without_disabling() -> Constants {
    Constants { disabling: Disabling::Off, ..Constants::default() }
}

/// A sliding block stops after v² / (2 mu g), by friction forces or impulses.
#[test]
fn a_sliding_block_stops_at_its_distance() {
    for static_friction in [None, Some(0.4)] {
        let constants = Constants { static_friction, drag: 0.0, ..without_disabling() };
        let mut one = settled(&named("block").unwrap(), constants, 30);
        let speed = 0.4;
        for state in &mut one.curr {
            state.velocity.x += speed;
        }
        let start = one.centres()[0].x;
        for _ in 0..30 {
            one.frame(None);
        }
        let (slid, expected) = (one.centres()[0].x - start, speed * speed / (2.0 * 0.4 * 9.81));
        assert!((slid / expected - 1.0).abs() < 0.05, "{static_friction:?}: {slid} m, expected {expected}");
    }
}

/// Static friction holds a block against a steady push below mu N, where kinetic friction lets it
/// creep. Above the limit the block slides with both.
#[test]
fn a_push_below_the_limit_moves_nothing() {
    let pushed = |static_friction, share: f64| {
        // The target is so far away that the force is nearly constant.
        let force = share * 0.4 * 0.0196 * 9.81;
        let constants = Constants {
            static_friction,
            drag: 0.0,
            hand: HandMode::Force,
            hand_stiffness: force / 100.0,
            ..without_disabling()
        };
        let mut one = settled(&named("block").unwrap(), constants, 30);
        let start = one.centres()[0].x;
        let hand = Hand { block: 0, target: one.centres()[0] + 100.0 * DVec3::X };
        for _ in 0..60 {
            one.frame(Some(&hand));
        }
        one.centres()[0].x - start
    };
    let (creeps, holds) = (pushed(None, 0.5), pushed(Some(0.4), 0.5));
    println!("at half the limit {creeps} m by dynamic friction, {holds} m by static");
    assert!(holds < 1e-4, "{holds}");
    assert!(holds < 0.5 * creeps, "{holds} {creeps}");
    for static_friction in [None, Some(0.4)] {
        let slid = pushed(static_friction, 1.5);
        assert!(slid > 0.1, "{static_friction:?}: {slid}");
    }
}

/// A resting tower is disabled, a pulled block wakes its neighbours, and a falling tower is not
/// disabled before it has fallen.
#[test]
fn rigid_motion_disables_resting_blocks_only() {
    let constants = Constants { disabling: Disabling::Rigid, ..Constants::default() };
    let mut six = settled(&six_rows(), constants.clone(), 120);
    assert!(six.model.blocks.iter().all(|b| !b.active));
    // No pair is tested and nothing moves.
    let before = six.centres();
    assert_eq!(six.step(None).all.potential, 0);
    assert_eq!(six.centres(), before);
    // The middle block of the top row is pulled out along its long axis.
    let hand = Hand { block: 16, target: six.centres()[16] + 0.06 * DVec3::Y };
    for _ in 0..30 {
        six.frame(Some(&hand));
    }
    assert!(six.centres()[16].distance(before[16]) > 0.03);
    assert!(six.model.blocks.iter().any(|b| b.active));
    let low = (0..9).map(|b| six.centres()[b].distance(before[b])).fold(0.0, f64::max);
    assert!(low < 1e-3, "{low}");

    for name in ["test-3", "test-4"] {
        let fallen = settled(&named(name).unwrap(), constants.clone(), 120);
        let start = Jenga3D::new(&named(name).unwrap(), constants.clone()).unwrap().centres();
        assert!(fallen.centres().iter().zip(&start).any(|(now, was)| was.z - now.z > 3e-3), "{name}");
    }
}

/// The rule of appendix 2.5 leaves some blocks of a resting tower enabled, because they vibrate
/// (Figure 6.22).
#[test]
fn the_listed_rule_leaves_some_enabled() {
    let mut six = settled(&six_rows(), Constants::default(), 120);
    let mut min = usize::MAX;
    for _ in 0..60 {
        six.frame(None);
        min = min.min(six.model.blocks.iter().filter(|b| !b.active).count());
    }
    assert!(min < 18, "{min}");
}

/// All orders resolve all collisions in a few rounds.
#[test]
fn every_order_of_pairs_resolves_all_collisions() {
    for order in [Order::Naive, Order::BottomUp, Order::TopDown] {
        let mut six = settled(&six_rows(), Constants { order, ..without_disabling() }, 30);
        let report = six.frame(None);
        let mean = report.sweeps as f64 / f64::from(six.constants.mid_loop_count);
        println!("{order:?}: {mean:.2} rounds a step, at most {}", report.max_sweeps);
        assert_eq!(report.unresolved, 0);
        assert!(mean < 3.0, "{order:?}: {mean}");
    }
}
