//! Breakaway forces against Coulomb's law where it has one solution: columns, loose blocks, blocks
//! that bear alone. Catches a ramp whose inertia counts as friction, and a measurement on a tower
//! that still settles.

use glam::DVec3;
use teeter_physics::{BodyId, Params, Precision};
use teeter_scene::{Form, Scene, Springs, TowerOptions, config, loose, named, tower};
use teeter_study::{breakaway_force, force_map, long_axis, settled, xray};

fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}

#[test]
fn a_column_is_pulled_apart_at_coulombs_force() {
    for precision in [Precision::Single, Precision::Double] {
        let scene = named("column").unwrap();
        let weight = scene.blocks[0].mass * scene.gravity;
        for block in force_map(&scene, Params { precision, ..params() }, || ()).unwrap() {
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
        let force = breakaway_force(&world, BodyId(body), DVec3::X).unwrap();
        assert!((force / expected - 1.0).abs() < 0.01, "block {body}: {force} instead of {expected} N");
    }
}

/// The middle block of each row bears all: Coulomb's law gives the force of every block.
#[test]
fn friction_is_that_of_the_weight_for_loose_blocks_and_of_all_above_for_lone_bearers() {
    let scene = loose("(L0L)-(L0L)-(L0L)-(L0L)-(L0L)-(L0L)", &TowerOptions::exact()).unwrap();
    let scene = Scene { stiffness: 3e6, ..scene };
    let weight = scene.blocks[0].mass * scene.gravity;
    for block in force_map(&scene, params(), || ()).unwrap() {
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
fn each_row_of_the_xray_bears_the_weight_above_it() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let loads = xray(&settled(&scene, params()).unwrap(), scene.friction);
    for row in 0..18 {
        let above: f64 = scene.blocks[3 * row + 3..].iter().map(|b| b.mass * scene.gravity).sum();
        let borne: f64 = loads[3 * row..3 * row + 3].iter().map(|l| l.above_n).sum();
        assert!((borne - above).abs() < 1e-3 * (above + 1.0), "row {row} bears {borne} of {above} N");
    }
    assert!(loads[51..].iter().all(|l| l.is_loose()));
}

/// Springs within the blocks shift loads between them, stiff ones less. As stiff as the contacts
/// they agree with rigid blocks up to the forces that friction stored while the tower settled.
#[test]
fn the_force_map_of_lattice_blocks_converges_to_that_of_rigid_ones() {
    let scene = tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap();
    let map = |scene: &Scene| -> Vec<f64> {
        let world = settled(scene, params()).unwrap();
        (0..scene.blocks.len())
            .map(|i| breakaway_force(&world, BodyId(i as u32), long_axis(&scene.blocks[i]).extend(0.0)).unwrap())
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

/// The lowest block of a heavy column needs more than 10 N.
#[test]
fn a_block_that_does_not_move_has_no_force() {
    let mut scene = config("(010)-(010)", &TowerOptions::exact()).unwrap();
    scene.blocks[1].mass = 3.0;
    let blocks = force_map(&scene, params(), || ()).unwrap();
    assert_eq!((blocks[0].forward_n, blocks[0].backward_n), (None, None));
}
