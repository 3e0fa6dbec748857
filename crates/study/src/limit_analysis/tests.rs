use teeter_physics::REFERENCE_AREA;
use teeter_scene::{BlockPreset, NAMED, Scene, Stability, TowerOptions, config, named, tower};

use super::{Breakaway, LimitError, RigidTower};

/// Near the minimum the energies of two steps are equal by rounding: a search that compares them
/// would stop short in one official tower of twelve.
#[test]
fn the_lowest_row_of_a_full_tower_bears_all_above_it_for_any_seed() {
    let official = [4, 8, 29, 39, 52].map(|seed| (BlockPreset::Official, seed));
    for (block, seed) in official.into_iter().chain([(BlockPreset::Dissertation, 54)]) {
        let scene = tower(&TowerOptions { block, seed, ..TowerOptions::default() }).unwrap();
        let rigid = RigidTower::new(&scene).unwrap();
        let weight: f64 = scene.blocks[3..].iter().map(|b| b.mass * scene.gravity).sum();
        let borne: f64 = (0..3).map(|i| rigid.force_above(i)).sum();
        assert!(
            (borne / weight - 1.0).abs() < 1e-5,
            "{block}, seed {seed}: the lowest row bears {borne} of {weight} N"
        );
    }
}

/// A block 1 µm lower than its neighbours is loose on rigid contacts. On springs it bears its share
/// of the load, less 1 µm times the stiffness.
#[test]
fn a_block_lower_by_less_than_contacts_give_bears_on_springs() {
    let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
    let low = 1e-6;
    scene.blocks[1].size[2] -= low;
    scene.blocks[1].pos[2] -= 0.5 * low;
    let rigid = RigidTower::new(&scene).unwrap();
    assert!(rigid.force_above(1) < 1e-6);
    for k in [3e5, 3e6] {
        let scene = Scene { stiffness: k, ..scene.clone() };
        let rigid = RigidTower::new(&scene).unwrap();
        let springs = rigid.on_springs().unwrap();
        let weight = 3.0 * scene.blocks[0].mass * scene.gravity;
        // three springs under the weight of a row, of which the middle one is shorter: 9 patches
        // above in series with the floor, whose patches have three times the area
        let own =
            1.0 / (1.0 / (3.0 * k) + 1.0 / (k * scene.blocks[1].size[0] * scene.blocks[1].size[1] / REFERENCE_AREA));
        let expected = ((weight - 2.0 * own * low) / 3.0).max(0.0);
        let force = springs.force_above(1);
        assert!((force - expected).abs() < 0.01 * weight, "{k:e}: {force} instead of {expected}");
        let all = springs.force_above(0) + force + springs.force_above(2);
        assert!((all / weight - 1.0).abs() < 1e-4);
    }
}

#[test]
fn a_block_of_a_column_carries_along_all_above_it() {
    let scene = named("column").unwrap();
    let weight = scene.blocks[0].mass * scene.gravity;
    let rigid = RigidTower::new(&scene).unwrap();
    for i in 0..10 {
        let expected = scene.friction * weight * (10 - i) as f64;
        let forces = rigid.breakaway(i).unwrap();
        // forces balance to 1e-7 of a block's weight
        assert!((forces.straight_n / expected - 1.0).abs() < 1e-6);
        // the pull is along x, a corner of the friction polygon
        assert!((forces.turning_n / expected - 1.0).abs() < 1e-6, "{i}: {forces:?} instead of {expected}");
        // 7 mu m g at the middle of the fourth block against m g times half a length at the lowest
        let tipping = 10.0 * weight * 0.0405 / (0.018 * (i as f64 + 0.5));
        let tipping = (0..i)
            .map(|j| (10 - j) as f64 * weight * 0.0405 / (0.018 * ((i - j) as f64 + 0.5)))
            .fold(tipping, f64::min);
        assert!((forces.tipping_n.unwrap() / tipping - 1.0).abs() < 1e-6, "{i}: {forces:?} instead of {tipping}");
        assert_eq!(forces.is_exact(), tipping > expected);
    }
    assert!((rigid.top().unwrap() - 0.18).abs() < 1e-9);
}

#[test]
fn forces_and_displacements_of_the_tower_are_duals() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let rigid = RigidTower::new(&scene).unwrap();
    let descent: f64 = scene
        .blocks
        .iter()
        .zip(rigid.displacements().unwrap())
        .map(|(b, displacement)| -b.mass * scene.gravity * displacement.x)
        .sum();
    assert!(descent > 1e-5 && (descent / rigid.work() - 1.0).abs() < 1e-6);
    // the forces of the springs are another optimal solution
    let work: f64 = rigid.points.iter().zip(&rigid.forces).map(|(p, f)| p.gap * f).sum();
    assert!((work / rigid.work() - 1.0).abs() < 1e-5, "{work:e} instead of {:e} J", rigid.work());
}

#[test]
fn the_turning_force_is_at_most_the_straight_force() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let rigid = RigidTower::new(&scene).unwrap();
    for i in (0..54).step_by(5) {
        let Breakaway { turning_n: pull, straight_n: straight, .. } = rigid.breakaway(i).unwrap();
        assert!(pull < straight + 1e-6 && pull > 0.3 * straight, "{i}: {pull} against {straight}");
    }
    // a block of the top row bears nothing
    let own = scene.friction * scene.blocks[53].mass * scene.gravity;
    assert!((rigid.breakaway(53).unwrap().straight_n / own - 1.0).abs() < 1e-9);
    assert!((rigid.turning_force(53).unwrap() / own - 1.0).abs() < 5e-3);
}

#[test]
fn forces_on_each_block_balance_its_weight() {
    let scene = named("midgame").unwrap();
    let rigid = RigidTower::new(&scene).unwrap();
    for (i, block) in scene.blocks.iter().enumerate() {
        let lift = rigid.force_below(i) - rigid.force_above(i);
        assert!((lift / (block.mass * scene.gravity) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_tower_has_no_equilibrium_exactly_where_it_falls() {
    // Limit analysis is of upright blocks.
    let is_upright = |scene: &Scene| scene.blocks.iter().all(|b| b.orientation.is_none());
    for entry in NAMED.iter().filter(|n| n.expect.is_some() && is_upright(&n.scene())) {
        let scene = entry.scene();
        let rests = RigidTower::new(&scene);
        assert_eq!(
            rests.err(),
            (entry.expect == Some(Stability::Unstable)).then_some(LimitError::NoEquilibrium),
            "{}",
            entry.name
        );
    }
}

#[test]
fn two_of_three_blocks_share_the_load_above_them_equally() {
    let scene = config("(1L1)-(010)", &TowerOptions::exact()).unwrap();
    let rigid = RigidTower::new(&scene).unwrap();
    let weight = scene.blocks[0].mass * scene.gravity;
    for (block, above) in [(0, 0.5), (1, 0.0), (2, 0.5)] {
        assert!((rigid.force_above(block) - above * weight).abs() < 1e-9);
    }
    assert!((rigid.straight_force(0) / (scene.friction * weight) - 2.0).abs() < 1e-9);
}
