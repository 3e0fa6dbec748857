//! States with pinned bits. Caches, lanes and other economies change no bit of the method: these
//! hashes and counts were taken before any of them.

use glam::DVec3;
use teeter_dissertation::jenga3d::counters::Counters;
use teeter_dissertation::jenga3d::{Constants, Culling, Disabling, Hand, Jenga3D, Method, Order};
use teeter_scene::{Scene, TowerOptions, named, tower};

/// Run of a scene.
struct Run {
    name: &'static str,
    scene: Scene,
    constants: Constants,
    frames: u32,
    /// Block that is thrown at 2 m/s along x and y at the start.
    thrown: Option<usize>,
    /// Block that a hand draws along y by 2 mm a frame.
    drawn: Option<u32>,
}

/// Hash of the state at the end of each run, and the tests that boxes of blocks, boxes of parts and
/// planes left, and the collisions.
const EXPECTED: [(u64, [u64; 4]); 15] = [
    (0x41e1_5e68_ec37_1861, [100_688_112, 2_453_067, 100_891, 64_213]),
    (0x5f41_2df8_71c0_f257, [170_092_608, 4_996_966, 170_562, 106_351]),
    (0xc33b_aa99_7dbc_97f1, [120_971_088, 3_352_919, 122_447, 80_367]),
    (0x8e3f_6196_2926_9e56, [93_100_896, 1_742_115, 78_474, 56_919]),
    (0x5510_6573_2b03_3b30, [139_648_656, 3_238_076, 135_676, 96_893]),
    (0x01af_af33_0e58_de24, [3_914_736, 57_512, 5_876, 5_871]),
    (0x9391_ec47_eb11_6e59, [13_602_624, 298_842, 12_315, 9_529]),
    (0x9658_d311_863e_32f6, [14_617_344, 292_306, 13_323, 9_791]),
    (0xf9be_68b5_8cf3_df94, [3_102_960, 2_764_703, 2_764_703, 2_946]),
    (0x85ad_37b7_172b_37b5, [1_398_096, 1_285_781, 1_285_781, 2_786]),
    (0x4f0f_38af_d6c7_3df3, [6_776_112, 141_431, 141_431, 2_345]),
    (0x986e_5d24_bac7_a2e2, [16_406_208, 2_162_265, 25_159, 14_837]),
    (0x5758_9051_42cb_00f2, [8_608_656, 137_567, 15_743, 13_558]),
    (0xfcf6_008d_4f18_3670, [7_992_432, 101_076, 14_010, 13_359]),
    (0xabce_1070_2092_70e1, [8_050_224, 332_213, 51_736, 24_445]),
];

fn rows(rows: u32) -> Scene {
    tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap()
}

fn run(run: &Run) -> (u64, [u64; 4]) {
    let mut jenga = Jenga3D::new(&run.scene, run.constants.clone()).unwrap();
    if let Some(block) = run.thrown {
        jenga.throw(block, DVec3::new(2.0, 2.0, 0.0));
    }
    let start = run.drawn.map(|block| jenga.centres()[block as usize]);
    let mut sum = Counters::default();
    for frame in 0..run.frames {
        let target = start.map(|start| start + 2e-3 * f64::from(frame) * DVec3::Y);
        let hand = run.drawn.zip(target).map(|(block, target)| Hand { block, target });
        sum += jenga.frame(hand.as_ref()).tests;
    }
    (jenga.hash(), [sum.after_blocks, sum.after_boxes, sum.after_planes, sum.collisions])
}

fn runs() -> Vec<Run> {
    let default = Constants::default;
    let future = || Constants { static_friction: Some(0.4), disabling: Disabling::Rigid, ..default() };
    let off = || Constants { disabling: Disabling::Off, ..default() };
    let of = |name, scene, constants, frames| Run { name, scene, constants, frames, thrown: None, drawn: None };
    let scene = |name| named(name).unwrap();
    vec![
        of("six rows", rows(6), default(), 20),
        Run { thrown: Some(4), ..of("six rows hit", rows(6), default(), 30) },
        Run { thrown: Some(1), ..of("five rows hit, with 6.3", rows(5), future(), 40) },
        Run { drawn: Some(7), ..of("four rows drawn", rows(4), default(), 30) },
        Run { drawn: Some(4), ..of("four rows drawn, with 6.3", rows(4), future(), 60) },
        of("test-4 falls", scene("test-4"), off(), 30),
        Run { thrown: Some(1), ..of("bottom-up", rows(3), Constants { order: Order::BottomUp, ..off() }, 8) },
        Run { thrown: Some(1), ..of("top-down", rows(3), Constants { order: Order::TopDown, ..default() }, 8) },
        of("no culling", scene("test-5"), Constants { culling: Culling::None, ..default() }, 5),
        of("boxes of blocks", scene("test-5"), Constants { culling: Culling::Blocks, ..off() }, 5),
        Run {
            thrown: Some(3),
            ..of(
                "boxes of parts, none skipped",
                rows(2),
                Constants { culling: Culling::Boxes, skip_unchanged: false, ..off() },
                8,
            )
        },
        Run { thrown: Some(4), ..of("boxes as listed", rows(3), Constants { listed_boxes: true, ..default() }, 12) },
        of("rk4", scene("test-6"), Constants { method: Method::Rk4, ..default() }, 12),
        of(
            "midpoint",
            scene("test-6"),
            Constants { method: Method::Midpoint, friction_enabled: false, ..default() },
            12,
        ),
        of("euler", scene("column"), Constants { method: Method::Euler, restitution: 0.5, ..off() }, 12),
    ]
}

#[test]
fn states_and_counts_keep_their_bits() {
    let runs = runs();
    assert_eq!(runs.len(), EXPECTED.len());
    for (of, expected) in runs.iter().zip(EXPECTED) {
        let found = run(of);
        assert_eq!(found, expected, "{}: {:016x}", of.name, found.0);
    }
}
