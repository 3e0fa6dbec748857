//! The force that starts a block sliding, against Coulomb's law where it leaves one answer: columns, loose blocks, blocks that carry alone.
//! It catches a ramp whose own inertia is counted as friction, and a tower measured while it still settles.

use glam::DVec3;
use teeter_physics::{BodyId, Params, Precision};
use teeter_scene::{Form, Scene, Springs, TowerOptions, config, loose, named, tower};
use teeter_study::{forces, long_axis, settled, starting_force, xray};

fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}

#[test]
fn a_column_is_pulled_apart_at_coulombs_force() {
    for precision in [Precision::Single, Precision::Double] {
        let scene = named("column").unwrap();
        let weight = scene.blocks[0].mass * scene.gravity;
        for block in forces(&scene, Params { precision, ..params() }, || ()).unwrap() {
            let expected = scene.friction * weight * f64::from(10 - block.id);
            for force in block.both() {
                let force = force.unwrap();
                assert!((force / expected - 1.0).abs() < 5e-3, "block {}: {force} instead of {expected} N", block.id);
            }
        }
    }
}

#[test]
fn static_friction_starts_a_block_where_kinetic_friction_is_less() {
    let column = Scene { friction: 0.5, kinetic_friction: Some(0.3), ..named("column").unwrap() };
    let world = settled(&column, params()).unwrap();
    for body in [0, 4, 9] {
        let expected = 0.5 * 0.0196 * 9.81 * f64::from(10 - body);
        let force = starting_force(&world, BodyId(body), DVec3::X).unwrap();
        assert!((force / expected - 1.0).abs() < 0.01, "block {body}: {force} instead of {expected} N");
    }
}

/// Rows whose middle block carries all: Coulomb's law gives the force of every block.
#[test]
fn loose_blocks_hold_their_own_weight_and_lone_bearers_all_above_them() {
    let scene = loose("(L0L)-(L0L)-(L0L)-(L0L)-(L0L)-(L0L)", &TowerOptions::exact()).unwrap();
    let scene = Scene { stiffness: 3e6, ..scene };
    let weight = scene.blocks[0].mass * scene.gravity;
    for block in forces(&scene, params(), || ()).unwrap() {
        let (row, column) = (block.id / 3, block.id % 3);
        let above = if column == 1 { 3.0 * f64::from(5 - row) * weight } else { 0.0 };
        let expected = scene.friction * (weight + above);
        let exact = block.exact.unwrap();
        assert!((exact.straight_n / expected - 1.0).abs() < 1e-6, "block {}: {exact:?}", block.id);
        for force in block.both() {
            let force = force.unwrap();
            assert!((force / expected - 1.0).abs() < 0.02, "block {}: {force} instead of {expected} N", block.id);
        }
        assert_eq!(block.load.is_loose(), above == 0.0);
        assert!((block.load.above_n - above).abs() < 1e-3, "block {}: {:?}", block.id, block.load);
    }
}

#[test]
fn the_xray_of_a_tower_adds_up() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let loads = xray(&settled(&scene, params()).unwrap(), scene.friction);
    for row in 0..18 {
        let above: f64 = scene.blocks[3 * row + 3..].iter().map(|b| b.mass * scene.gravity).sum();
        let borne: f64 = loads[3 * row..3 * row + 3].iter().map(|l| l.above_n).sum();
        assert!((borne - above).abs() < 1e-3 * (above + 1.0), "row {row} bears {borne} of {above} N");
    }
    assert!(loads[51..].iter().all(|l| l.is_loose()));
}

/// Springs within the blocks shift loads between them, the stiffer they are the less: as stiff as the contacts they agree with rigid blocks to
/// within what a tower remembers of how it settled.
#[test]
fn the_force_map_of_blocks_of_springs_comes_to_that_of_rigid_ones() {
    let scene = tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap();
    let map = |scene: &Scene| -> Vec<f64> {
        let world = settled(scene, params()).unwrap();
        (0..scene.blocks.len())
            .map(|i| starting_force(&world, BodyId(i as u32), long_axis(&scene.blocks[i]).extend(0.0)).unwrap())
            .collect()
    };
    let rigid = map(&scene);
    let [soft, equal] = [1e4, 1e6].map(|stiffness| {
        let springs = Springs { stiffness: Some(stiffness), ..Springs::default() };
        let map = map(&Scene { form: Form::Lattice, springs, ..scene.clone() });
        map.iter().zip(&rigid).map(|(a, b)| (a - b).abs()).sum::<f64>() / rigid.iter().sum::<f64>()
    });
    assert!(equal < 0.01 && soft > 2.0 * equal, "mean errors over the mean force: {soft} and {equal}");
}

/// More than 10 N is asked of the lowest of a heavy column.
#[test]
fn what_does_not_move_has_no_force() {
    let mut scene = config("(010)-(010)", &TowerOptions::exact()).unwrap();
    scene.blocks[1].mass = 3.0;
    let blocks = forces(&scene, params(), || ()).unwrap();
    assert_eq!((blocks[0].forward_n, blocks[0].backward_n), (None, None));
}
