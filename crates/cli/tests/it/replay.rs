//! `teeter record` and `teeter replay`: a game becomes a file, and the file the same game.

use std::fs;
use std::path::Path;

use crate::common::{teeter, teeter_with};
use serde_json::Value;
use teeter_game::Record;

/// Commands that lift the middle block off a tower and put it down on top again.
fn commands() -> String {
    let grasp = r#"{"command": "grasp", "body": 52, "anchor": [0, 0, 0], "normal": [0, 0, 1], "grip": "auto"}"#;
    let up = "{\"command\": \"move\", \"displacement\": [0, 0, 0.002]}\n".repeat(30);
    format!("{}{grasp}\n{up}{{\"command\": \"place\"}}\n{}", "\n".repeat(20), "\n".repeat(150))
}

/// Records a game in a folder and returns its report and the path of its file.
fn record(dir: &Path, args: &[&str]) -> (Value, String) {
    let out = dir.join("game.record").display().to_string();
    let common = ["record", "tower", "--commands", "-", "--out", &out, "--json"];
    let report = teeter_with(&[&common[..], args].concat(), commands().as_bytes()).json();
    (report, out)
}

#[test]
fn a_recorded_game_replays_the_same() {
    let dir = tempfile::tempdir().unwrap();
    let (report, file) = record(dir.path(), &["--rules", "dissertation", "--players", "3", "--names", "Ada, Åsa\u{7}"]);
    assert_eq!(report["frames"], 202);
    assert_eq!(report["bytes"], fs::metadata(&file).unwrap().len());
    let names: Vec<&str> = report["events"].as_array().unwrap().iter().map(|e| e["event"].as_str().unwrap()).collect();
    let expected = ["turn_started", "grasped", "nudged", "removed", "placed", "settled", "turn_started"];
    assert_eq!(names, expected);

    let verified = teeter(&["replay", &file, "--verify", "--json"]).json();
    assert_eq!((&verified["same"], &verified["hash"]), (&true.into(), &report["hash"]));
    assert!(verified["diverged_at_s"].is_null() && verified["block"].is_null());
    let film = dir.path().join("game.gif").display().to_string();
    let drawn = teeter(&["render", &file, "--out", &film, "--size", "40x30", "--fps", "5", "--json"]).json();
    // 202 frames are 3.37 s
    assert_eq!((&drawn["pictures"], &drawn["to_s"]), (&17.into(), &3.2.into()), "{drawn}");
    assert!(fs::read(&film).unwrap().starts_with(b"GIF89a") && drawn["warnings"].as_array().unwrap().is_empty());
    let refused = teeter(&["render", &file, "--out", &film, "--stiffness", "2e6"]);
    assert!(refused.code == 2 && refused.error_line().contains("is a record"), "{}", refused.err);
    let played = teeter(&["replay", &file, "--json"]).json();
    assert_eq!((&played["events"], &played["hash"]), (&report["events"], &report["hash"]));
    assert_eq!((&played["rules"]["players"], &played["scene"]), (&3.into(), &"tower".into()));
    assert_eq!(played["players"], serde_json::json!(["Ada", "Åsa"]));

    let done = teeter_with(&["replay", "-", "--verify"], &fs::read(&file).unwrap());
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    assert!(done.out.starts_with("the same: 202 frames, 3.37 s, hash "), "{}", done.out);
    let lines = teeter(&["replay", &file]).out;
    assert!(lines.lines().any(|line| line.ends_with("grasped      block 52")), "{lines}");
}

#[test]
fn a_replay_that_diverges_ends_with_1_and_names_the_time_and_the_block() {
    let dir = tempfile::tempdir().unwrap();
    let (_, file) = record(dir.path(), &["--rules", "free"]);
    let mut altered = Record::decode(&fs::read(&file).unwrap()).unwrap();
    // More than a hand lifts.
    altered.scene.blocks[52].mass = 1.0;
    fs::write(&file, altered.encode()).unwrap();
    let done = teeter(&["replay", &file, "--verify", "--json"]);
    assert_eq!((done.code, done.err.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!(report["same"], false);
    let (time, frame) = (report["diverged_at_s"].as_f64().unwrap(), report["frame"].as_f64().unwrap());
    assert!((time - frame / 60.0).abs() < 1e-9 && time < 0.2, "{report}");
    assert_eq!(report["block"]["id"], 52, "{report}");
    assert!(report["block"]["displacement_mm"].as_f64().unwrap() > 20.0, "{report}");
    let done = teeter(&["replay", &file, "--verify"]);
    assert_eq!(done.code, 1);
    assert!(done.out.starts_with("diverges in frame ") && done.out.contains(": block 52 is "), "{}", done.out);
}

#[test]
fn a_record_of_another_engine_warns() {
    let dir = tempfile::tempdir().unwrap();
    let (_, file) = record(dir.path(), &["--rules", "solo"]);
    let mut other = Record::decode(&fs::read(&file).unwrap()).unwrap();
    other.engine = "0.0.1+0123456789abcdef".into();
    fs::write(&file, other.encode()).unwrap();
    let report = teeter(&["replay", &file, "--verify", "--json"]).json();
    let warning = report["warnings"][0].as_str().unwrap();
    assert!(warning.starts_with("the record is of engine 0.0.1+0123456789abcdef, and this is "), "{warning}");
}

#[test]
fn files_that_are_no_record_are_refused_by_the_name_of_their_fault() {
    let dir = tempfile::tempdir().unwrap();
    let (_, file) = record(dir.path(), &["--states-every", "60"]);
    let bytes = fs::read(&file).unwrap();
    let mut altered = bytes.clone();
    altered[bytes.len() / 2] ^= 1;
    let mut version = bytes.clone();
    version[13] = 3;
    let cases = [
        (&b"{}"[..], "this is no record of a game"),
        (&bytes[..bytes.len() / 2], "the record is truncated: "),
        (&altered, "the record is altered: "),
        (&version, "a record of version 3, and this program reads versions up to 2"),
    ];
    for (bytes, message) in cases {
        let done = teeter_with(&["replay", "-", "--verify", "--json"], bytes);
        let expected = format!("standard input: {message}");
        assert!(done.error_line().starts_with(&expected), "{}", done.err);
    }
    assert!(teeter(&["replay", "nowhere"]).error_line().contains("there is no such file"));
}

#[test]
fn commands_and_rules_that_are_none_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("game.record").display().to_string();
    let run = |args: &[&str], commands: &str| {
        let common = ["record", "tower", "--commands", "-", "--out", &out];
        teeter_with(&[&common[..], args].concat(), commands.as_bytes()).error_line().to_owned()
    };
    assert!(run(&[], "\n{\"command\": \"jump\"}\n").starts_with("standard input, line 2: unknown variant `jump`"));
    assert!(run(&["--players", "9"], "\n").starts_with("`players` is 9, expected 1 to 8"));
    assert!(run(&["--rules", "chess"], "\n").contains("expected one of free, official, strict"));
    assert!(!Path::new(&out).exists());
    let done = teeter(&["record", "-", "--commands", "-", "--out", &out]);
    assert!(done.error_line().starts_with("standard input cannot be both the scene and the commands"));
}
