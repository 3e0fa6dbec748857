//! Towers of a seed: valid, free of overlap, and the same bits on every target.

use proptest::prelude::*;
use teeter_scene::{Block, BlockPreset, Scene, TowerOptions, overlap, tower};

fn any_tower() -> impl Strategy<Value = TowerOptions> {
    let block = prop_oneof![Just(BlockPreset::Dissertation), Just(BlockPreset::Official)];
    (1u32..=40, any::<u64>(), block, 0.0..1e-3f64, 0.0..=2.0f64).prop_map(|(rows, seed, block, height_sd, friction)| {
        TowerOptions { rows, seed, block, height_sd, friction, ..TowerOptions::default() }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn no_tower_overlaps(options in any_tower()) {
        let scene = tower(&options).unwrap();
        prop_assert_eq!(scene.blocks.len(), 3 * options.rows as usize);
        prop_assert_eq!(scene.validate(), Ok(()));
        // Validation allows 20 µm; towers overlap by rounding only.
        prop_assert_eq!(overlap::first_pair(&scene, 1e-12), None);
    }

    #[test]
    fn heights_and_masses_are_clipped(options in any_tower()) {
        let nominal = options.block.size();
        for b in tower(&options).unwrap().blocks {
            prop_assert_eq!([b.size[0], b.size[1]], [nominal[0], nominal[1]]);
            prop_assert!((b.size[2] - nominal[2]).abs() <= 2.0 * options.height_sd + 1e-15);
            prop_assert!((b.mass - options.block.mass()).abs() <= 2.0 * options.block.mass_sd() + 1e-15);
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bits(options in any_tower()) {
        prop_assert_eq!(tower(&options).unwrap().to_json(), tower(&options).unwrap().to_json());
        let other = TowerOptions { seed: options.seed ^ 1, height_sd: 1e-4, ..options.clone() };
        prop_assert_ne!(tower(&options).unwrap().blocks, tower(&other).unwrap().blocks);
    }

    #[test]
    fn further_rows_leave_those_below_unchanged(options in any_tower()) {
        let scene = tower(&options).unwrap();
        let higher = tower(&TowerOptions { rows: options.rows + 3, ..options }).unwrap();
        prop_assert_eq!(&higher.blocks[..scene.blocks.len()], &scene.blocks[..]);
    }

    #[test]
    fn json_round_trips_to_the_same_bits(options in any_tower()) {
        let scene = tower(&options).unwrap();
        prop_assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
    }

    /// A grid point of one block is inside the other only if the depth is positive, and some point
    /// is inside if the depth exceeds the spacing of the grid.
    #[test]
    fn overlap_agrees_with_a_grid_of_points(x in -0.1..0.1f64, y in -0.1..0.1f64, z in -0.03..0.03f64, yaw in -4.0..4.0f64) {
        let size = [0.081, 0.0268, 0.018];
        let a = Block { yaw: 0.3, ..Block::new(0, size, 0.02, [0.0; 3]) };
        let b = Block { yaw, ..Block::new(1, size, 0.02, [x, y, z]) };
        let depth = overlap::depth(&a, &b);
        prop_assert!((depth - overlap::depth(&b, &a)).abs() < 1e-15);
        let steps = 60;
        let inside = (0..=steps).any(|i| (0..=steps).any(|j| {
            let u = (f64::from(i) / f64::from(steps) - 0.5) * size[0];
            let v = (f64::from(j) / f64::from(steps) - 0.5) * size[1];
            let (s, c) = libm::sincos(b.yaw);
            let (px, py) = (b.pos[0] + c * u - s * v, b.pos[1] + s * u + c * v);
            let (s, c) = libm::sincos(a.yaw);
            let (qx, qy) = (c * px + s * py, -s * px + c * py);
            qx.abs() < size[0] / 2.0 && qy.abs() < size[1] / 2.0
        })) && z.abs() < size[2];
        if inside { prop_assert!(depth > 0.0, "{depth}"); }
        // Adjacent grid points are at most 1.4 mm apart.
        if depth > 2e-3 { prop_assert!(inside, "{depth}"); }
    }
}

/// Bits of some blocks of the default tower, equal on every machine.
#[test]
fn the_default_tower_has_fixed_bits() {
    let scene = tower(&TowerOptions::default()).unwrap();
    let bits: Vec<[u64; 3]> = [0, 1, 53]
        .map(|i| {
            let b: &Block = &scene.blocks[i];
            [b.size[2].to_bits(), b.mass.to_bits(), b.pos[2].to_bits()]
        })
        .to_vec();
    let expected = [
        [4580857746296224448, 4581549930654930007, 4576354146668853952],
        [4580835947700196729, 4581869369777050829, 4576332348072826233],
        [4580836772284790851, 4581341677185138217, 4599367915642869142],
    ];
    assert_eq!(bits, expected);
}

#[test]
fn blocks_have_the_positions_of_the_scene_format() {
    let scene = tower(&TowerOptions { rows: 2, ..TowerOptions::exact() }).unwrap();
    let (a, d) = (&scene.blocks[0], &scene.blocks[3]);
    assert_eq!((a.pos, a.yaw), ([0.0, -0.0271, 0.009], 0.0));
    assert_eq!((d.pos[0], d.pos[1], d.yaw), (-0.0271, 0.0, std::f64::consts::FRAC_PI_2));
    assert!((d.pos[2] - 0.027).abs() < 1e-15);
    assert_eq!(a.mass, 0.0196);
}

#[test]
fn a_row_rests_on_the_tallest_block_below() {
    let scene = tower(&TowerOptions { rows: 10, ..TowerOptions::default() }).unwrap();
    let mut base = 0.0;
    for row in scene.blocks.chunks(3) {
        for b in row {
            assert!((b.pos[2] - b.size[2] / 2.0 - base).abs() < 1e-15);
        }
        base += row.iter().map(|b| b.size[2]).fold(0.0, f64::max);
    }
}

#[test]
fn rows_out_of_range_are_rejected() {
    for rows in [0, 201, u32::MAX] {
        let error = tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap_err().to_string();
        assert_eq!(error, format!("`rows` is {rows}, expected 1 to 200"));
    }
    assert_eq!(tower(&TowerOptions { rows: 200, ..TowerOptions::default() }).unwrap().blocks.len(), 600);
}

#[test]
fn scatter_out_of_range_is_rejected() {
    for height_sd in [-1e-9, 2e-3, f64::NAN] {
        let error = tower(&TowerOptions { height_sd, ..TowerOptions::default() }).unwrap_err().to_string();
        assert!(error.starts_with("`height_sd` is "), "{error}");
    }
    let error = tower(&TowerOptions { mass_sd: Some(0.1), ..TowerOptions::default() }).unwrap_err().to_string();
    assert!(error.starts_with("`mass_sd` is 0.1"), "{error}");
}
