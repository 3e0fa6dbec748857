//! Target: a record of a game, whole or sealed again.

use glam::DVec3;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use teeter_game::{Command, GripMode, Record, Recorder, Replay, Rules, Table};
use teeter_physics::envelope::checksum;
use teeter_physics::{BodyId, Params};

/// Kind and version of a file, and its bytes before the content: these, length and checksum.
const KIND: &[u8] = b"teeter-record\x02";
const HEADER: usize = KIND.len() + 4 + 8;
/// Largest content of a seed, bytes.
const MAX_CONTENT: usize = 1_000_000;
/// Number of frames that are replayed, and of blocks up to which they are.
const FRAMES: usize = 3;
const BLOCKS: usize = 20;

/// Reads bytes as a record: whole after a first byte that is even, else compressed and sealed as
/// the content of one. What is accepted is the same after it is written and read, and an error is
/// one printable line.
pub fn run(bytes: &[u8]) {
    let Some((&first, bytes)) = bytes.split_first() else { return };
    let decoded = if first & 1 == 0 { Record::decode(bytes) } else { Record::decode(&sealed(bytes)) };
    let record = match decoded {
        Ok(record) => record,
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains('\n') && line.len() < 2000, "{line:?}");
            return;
        }
    };
    let written = record.encode();
    let again = Record::decode(&written).expect("what was written can be read");
    // The bytes stand for the record: a number that is none differs from itself.
    assert_eq!(again.encode(), written);
    if record.scene.blocks.len() > BLOCKS {
        return;
    }
    if let Ok(mut replay) = Replay::new(&record) {
        (0..FRAMES).for_each(|_| drop(replay.step()));
        assert!(replay.game().blocks().positions().iter().all(|position| position.is_finite()));
    }
}

/// Seals content as a file.
fn sealed(content: &[u8]) -> Vec<u8> {
    let compressed = compress_to_vec(content, 1);
    let len = (compressed.len() as u32).to_le_bytes();
    [KIND, &len, &checksum(&compressed).to_le_bytes(), &compressed].concat()
}

/// Records of a small tower by two tables of rules, whole and as contents.
pub fn seeds() -> Vec<Vec<u8>> {
    let of = |table: Table| {
        let scene = teeter_scene::config("(111)-(111)-(111)", &teeter_scene::TowerOptions::default());
        let scene = scene.expect("the notation is valid");
        let recorder = Recorder::new(&scene, Params::default(), Rules::of(table, 2));
        let mut recorder = recorder.expect("the rules are valid").with_states(40);
        let grasp = Command::Grasp { body: BodyId(4), anchor: DVec3::ZERO, normal: DVec3::X, grip: GripMode::Auto };
        let step = Command::Move { displacement: DVec3::new(0.001, 0.0, 0.0), slot: None, toward_viewer: None };
        for command in [grasp, step, step, step, Command::Poke, Command::Release, Command::Resign, Command::Idle] {
            for _ in 0..6 {
                recorder.step(&command).expect("the record is not full");
            }
        }
        let bytes = recorder.finish().encode();
        let content = decompress_to_vec_with_limit(&bytes[HEADER..], MAX_CONTENT).expect("it was compressed");
        [[&[0], &bytes[..]].concat(), [&[1], &content[..]].concat()]
    };
    [of(Table::Free), of(Table::ThrowAndGo)].concat()
}
