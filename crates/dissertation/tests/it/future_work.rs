//! Future work of section 6.3: static friction, disabling by rigid motion, orders of pairs, fewer
//! springs.

use crate::common::settled;
use glam::DVec3;
use teeter_dissertation::jenga3d::contact::FLOOR;
use teeter_dissertation::jenga3d::{Constants, Disabling, Hand, HandMode, Jenga3D, Order, SpringSet};
use teeter_scene::{Scene, TowerOptions, named, tower};

fn six_rows() -> Scene {
    tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap()
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

/// Pairs come in the order that is asked for: within a round the lower block of a contact comes
/// down a column from the top, or climbs it from the bottom.
#[test]
fn pairs_are_tested_in_their_order() {
    let turns = |order: Order| {
        let mut ten = settled(&named("column").unwrap(), Constants { order, ..without_disabling() }, 20);
        let (mut up, mut down) = (0, 0);
        for _ in 0..200 {
            ten.step(None);
            let pairs: Vec<u32> =
                ten.contacts.iter().filter(|c| c.blocks[1] != FLOOR).map(|c| c.blocks[0].min(c.blocks[1])).collect();
            for pair in pairs.windows(2) {
                up += u32::from(pair[1] > pair[0]);
                down += u32::from(pair[1] < pair[0]);
            }
        }
        (up, down)
    };
    for (order, climbs) in [(Order::Naive, true), (Order::BottomUp, true), (Order::TopDown, false)] {
        let (up, down) = turns(order);
        let (with, against) = if climbs { (up, down) } else { (down, up) };
        assert!(with > 200 && with > 3 * against, "{order:?}: {up} up, {down} down");
    }
}

/// Fewer springs hold the shape of a block and cost fewer forces; its stiffness falls with them.
#[test]
fn a_block_of_fewer_springs_keeps_its_shape() {
    let sag = |springs: SpringSet| {
        let constants = Constants { springs, ..without_disabling() };
        let mut column = settled(&named("column").unwrap(), constants, 90);
        let edges = column.model.springs.clone().into_iter().filter(|spring| spring.edge);
        let bent = edges.map(|s| (s.length(&column.curr) / s.rest_length - 1.0).abs()).fold(0.0, f64::max);
        assert!(bent < 5e-3, "{springs:?}: {bent}");
        let low: f64 = (0..60)
            .map(|_| {
                column.frame(None);
                column.top()
            })
            .sum();
        0.18 - low / 60.0
    };
    let [all, sides, faces] = SpringSet::ALL.map(sag);
    println!("{all} {sides} {faces}");
    assert!(all < sides && sides < faces && faces < 2e-3, "{all} {sides} {faces}");
}
