//! Records as files: small, the same after they are read, and refused by name where they are not.

use crate::common::{block, displace, settled, tower};
use glam::DVec3;
use teeter_game::{
    Candidate, Command, HandNoise, MoveEnd, PlayerHand, PlayerNames, Record, RecordError, Recorder, Rules, Table,
    TakeAndPlace, verify,
};
use teeter_physics::envelope::checksum;
use teeter_physics::{Params, World};
use teeter_scene::{Random, Scene};

/// Bytes before the compressed content: kind, version, length and checksum.
const HEADER: usize = 13 + 1 + 4 + 8;

/// A record of one move by a scripted player.
fn one_move(rows: u32) -> Record {
    let scene = tower(rows, 3);
    let body = block(&settled(&scene), true);
    let mut recorder = Recorder::new(&scene, Params::default(), Rules::of(Table::Official, 2)).unwrap();
    (0..60).for_each(|_| drop(recorder.step(&Command::Idle).unwrap()));
    let toward = recorder.game().blocks().orientation(body) * glam::DVec3::X;
    let mut script = TakeAndPlace::new(body, toward, 0.1, None);
    while let Some(command) = script.next(recorder.game()) {
        recorder.step(&command.rounded()).unwrap();
    }
    (0..70).for_each(|_| drop(recorder.step(&Command::Idle).unwrap()));
    assert_eq!(recorder.game().turn().unwrap().number, 2, "the block was placed");
    recorder.finish()
}

#[test]
fn a_move_takes_less_than_two_kilobytes_and_replays_the_same_from_its_file() {
    let record = one_move(18);
    let bytes = record.encode();
    assert!(bytes.len() <= 2000, "{} bytes for {} frames", bytes.len(), record.frames());
    let read = Record::decode(&bytes).unwrap();
    assert_eq!(read, record);
    assert_eq!(read.encode(), bytes);
    let result = verify(&read).unwrap();
    assert!(result.same && result.divergence.is_none());
    assert_eq!(read.commands(0).count(), read.frames() as usize);
}

/// The tower of a game after some moves of a person's hand, and the commands of the next move.
fn played_on(rows: u32, moves: u64) -> (Scene, Vec<Command>) {
    let mut game = settled(&tower(rows, 3));
    for seed in 0.. {
        let start = game.world().to_scene();
        let bodies: Vec<_> = (0..3 * rows - 6).map(teeter_physics::BodyId).collect();
        let plan = Candidate::best(game.world(), &bodies, 1)[0].plan();
        let mut hand = PlayerHand::new(&game, plan, HandNoise::default(), seed);
        let mut commands = Vec::new();
        while let Some(command) = hand.next(&game) {
            commands.push(command);
            game.step(&command);
        }
        assert_eq!(hand.end(), Some(MoveEnd::Placed), "move {seed}");
        if seed == moves {
            return (start, commands);
        }
        (0..60).for_each(|_| drop(game.step(&Command::Idle)));
    }
    unreachable!("there is always a next move")
}

/// The scene in numbers rounded as the page rounds them for a record of one move.
fn rounded(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let to = |x: f64, parts: f64| (x * parts).round() / parts + 0.0;
    for block in &mut scene.blocks {
        let [x, y, z] = block.pos;
        block.pos = [to(x, 1e5), to(y, 1e5), (z * 1e6).ceil() / 1e6];
        (block.size, block.mass) = (block.size.map(|edge| to(edge, 1e6)), to(block.mass, 1e5));
        block.orientation = block.orientation.map(|orientation| orientation.map(|x| to(x, 1e5)));
        (block.velocity, block.spin) = ([0.0; 3], [0.0; 3]);
    }
    scene
}

/// Commands of which some displacements are summed into one, as the page sums them.
fn thinned(commands: &[Command], stride: usize) -> Vec<Command> {
    let mut waiting = DVec3::ZERO;
    let thin = |(frame, command): (usize, &Command)| match command {
        Command::Move { displacement, .. } => {
            waiting += displacement;
            let is_due = frame % stride == stride - 1;
            let given = if is_due { (waiting * 1e4).round() / 1e4 } else { DVec3::ZERO };
            waiting -= given;
            if is_due { displace(given + DVec3::ZERO) } else { Command::Idle }
        }
        other => other.rounded(),
    };
    commands.iter().enumerate().map(thin).collect()
}

/// Record of one move from the middle of a game, wherever its coarse commands bring the block.
fn cut(rows: u32, moves: u64) -> Record {
    let (scene, commands) = played_on(rows, moves);
    let mut recorder = Recorder::new(&rounded(&scene), Params::default(), Rules::of(Table::Official, 1)).unwrap();
    let idle = [Command::Idle; 60];
    for command in idle[..12].iter().chain(&thinned(&commands, 6)).chain(&idle) {
        recorder.step(command).unwrap();
    }
    recorder.finish()
}

#[test]
fn a_move_from_the_middle_of_a_game_takes_less_than_two_kilobytes_and_replays_the_same() {
    let record = cut(18, 3);
    let bytes = record.encode();
    assert!(bytes.len() <= 2000, "{} bytes for {} frames", bytes.len(), record.frames());
    let read = Record::decode(&bytes).unwrap();
    assert_eq!(read, record);
    assert!(verify(&read).unwrap().same);
}

#[test]
fn keyframes_show_the_game_without_an_engine() {
    let record = one_move(6);
    let mut world = World::new(&record.scene, Params::default()).unwrap();
    world.step(&teeter_physics::Input::default());
    let frames: Vec<_> = record.keyframes().collect();
    assert_eq!(frames.len(), record.frames().div_ceil(60) as usize);
    for (body, (position, orientation)) in world.bodies().zip(&frames[0]) {
        assert!(world.pose(body).position.distance(*position) < 1e-4);
        assert!(world.pose(body).orientation.dot(*orientation).abs() > 1.0 - 1e-6);
    }
    let top = |frame: &[(glam::DVec3, glam::DQuat)]| frame.iter().map(|(p, _)| p.z).fold(0.0, f64::max);
    assert!(top(&frames[frames.len() - 1]) > top(&frames[0]) + 0.017, "a block lies on top");
}

#[test]
fn each_fault_of_a_file_has_its_name() {
    let bytes = one_move(6).encode();
    let decode = |bytes: &[u8]| Record::decode(bytes).unwrap_err();
    for end in 1..bytes.len() {
        let error = decode(&bytes[..end]);
        assert!(matches!(error, RecordError::Truncated { found, .. } if found == end as u64), "{end}: {error}");
    }
    for foreign in [&b""[..], b"{}", b"teeter", b"teeter-game\x00\x05", &bytes[1..]] {
        let error = decode(foreign);
        let is_named = matches!(error, RecordError::Foreign) || foreign == b"teeter";
        assert!(is_named, "{error}");
    }
    for at in HEADER..bytes.len() {
        let mut altered = bytes.clone();
        altered[at] ^= 0x10;
        assert_eq!(decode(&altered), RecordError::Altered, "byte {at}");
    }
    let mut other = bytes.clone();
    other[13] = 9;
    assert_eq!(decode(&other), RecordError::Version { found: 9, expected: 2 });
    assert!(matches!(decode(&[&bytes[..], &[0]].concat()), RecordError::TooLong { .. }));
    for error in [decode(&bytes[..40]), decode(b"{}"), decode(&other)] {
        let line = error.to_string();
        assert!(!line.contains('\n') && !line.is_empty());
    }
}

/// Changes bytes at random.
fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        match random.below(4) {
            0 => bytes[at] = random.bits() as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes.insert(at, random.bits() as u8),
            _ => drop(bytes.drain(at..(at + random.below(9)).min(bytes.len()))),
        }
        if bytes.is_empty() {
            bytes.push(0);
        }
    }
}

#[test]
fn ten_thousand_mutated_files_are_refused_or_read_and_never_crash() {
    let mut record = one_move(4);
    record.players = PlayerNames::new(["Ada", "Åsa"]);
    let bytes = record.encode();
    let content = miniz_oxide::inflate::decompress_to_vec(&bytes[HEADER..]).unwrap();
    let mut random = Random::new(1);
    let mut read = 0;
    for round in 0..10_000 {
        let forged = match round % 4 {
            // As it stands: found by the length or the checksum.
            0 => {
                let mut forged = bytes.clone();
                mutate(&mut forged, &mut random);
                forged
            }
            // With a checksum that is right: the compression or the content is damaged.
            1 => {
                let mut compressed = bytes[HEADER..].to_vec();
                mutate(&mut compressed, &mut random);
                sealed(&compressed)
            }
            _ => {
                let mut forged = content.clone();
                mutate(&mut forged, &mut random);
                sealed(&miniz_oxide::deflate::compress_to_vec(&forged, 1))
            }
        };
        if let Ok(record) = Record::decode(&forged) {
            read += 1;
            // A few of those that are accepted are played.
            if read % 60 == 0 {
                let _ = verify(&record);
            }
        }
    }
    assert!(read > 100, "{read} forged records were accepted");
}

fn sealed(compressed: &[u8]) -> Vec<u8> {
    let len = (compressed.len() as u32).to_le_bytes();
    [b"teeter-record\x02", &len[..], &checksum(compressed).to_le_bytes(), compressed].concat()
}

/// A file of version 1, with its scene as JSON: 20 frames of a tower of three rows.
const OF_VERSION_1: &[u8] = include_bytes!("version-1.record");

#[test]
fn a_record_of_version_1_opens_and_is_written_in_the_version_of_today() {
    let record = Record::decode(OF_VERSION_1).unwrap();
    assert_eq!((record.frames(), record.scene.blocks.len(), record.scene.name.as_str()), (20, 9, "old"));
    assert!(record.players.as_slice().is_empty());
    let written = record.encode();
    assert_eq!((OF_VERSION_1[13], written[13]), (1, 2));
    assert_eq!(Record::decode(&written).unwrap(), record);
    assert!(written.len() < OF_VERSION_1.len(), "{} bytes", written.len());
    if record.engine == teeter_game::engine_id() {
        assert!(verify(&record).unwrap().same);
    }
}

#[test]
fn the_names_of_the_players_travel_with_a_record() {
    let mut record = one_move(4);
    record.players = PlayerNames::new(["Ada", "千歳\u{7}"]);
    let read = Record::decode(&record.encode()).unwrap();
    assert_eq!(read, record);
    assert_eq!(read.players.as_slice(), ["Ada", "千歳"]);
}

#[test]
fn a_record_without_a_frame_is_one() {
    let record = Recorder::new(&tower(3, 1), Params::default(), Rules::default()).unwrap().finish();
    let read = Record::decode(&record.encode()).unwrap();
    assert_eq!((read.frames(), verify(&read).unwrap().same), (0, true));
}

#[test]
fn a_record_that_no_game_begins_from_is_an_error_of_one_line() {
    let mut record = one_move(4);
    record.params.frame = 7.0;
    let error = verify(&record).unwrap_err().to_string();
    assert!(error.starts_with("no game begins like this: parameter `frame` is 7"), "{error}");
    let rules = Rules { players: 99, ..Rules::of(Table::Official, 2) };
    assert!(Recorder::new(&tower(3, 1), Params::default(), rules).is_err());
}
