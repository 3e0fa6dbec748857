//! `teeter run`: whether a scene stands, and the figures that say how well.

mod common;

use common::teeter;
use serde_json::Value;
use teeter_scene::{NAMED, Stability};

fn report(args: &[&str]) -> Value {
    teeter(&[&["run"], args, &["--json"]].concat()).json()
}

#[test]
fn the_report_has_these_fields() {
    let report = report(&["test-5", "--seconds", "3"]);
    let fields: Vec<&str> = report.as_object().unwrap().keys().map(String::as_str).collect();
    let expected = [
        "asleep_at_s",
        "cpu_s",
        "creep_mm",
        "fell",
        "hash",
        "max_displacement_mm",
        "penetration_mm",
        "rms_speed",
        "simulated_s",
        "sink_mm",
        "stands",
    ];
    assert_eq!(fields, expected);
    assert_eq!(report["stands"], true);
    assert_eq!(report["fell"], serde_json::json!([]));
    assert!((report["simulated_s"].as_f64().unwrap() - 3.0).abs() < 1e-9);
    let hash = report["hash"].as_str().unwrap();
    assert!(hash.len() == 16 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{hash}");
    assert!(report["asleep_at_s"].as_f64().unwrap() < 3.0);
}

/// The output of `teeter run` in the README, except for the time, which is that of a machine.
#[test]
fn the_readme_shows_the_output_of_run() {
    let readme = include_str!("../../../README.md");
    let (_, shown) = readme.split_once("$ teeter run tower --no-sleep\n").unwrap();
    let (shown, _) = shown.split_once("```").unwrap();
    let said = teeter(&["run", "tower", "--no-sleep"]).out;
    let timeless =
        |text: &str| text.lines().filter(|line| !line.starts_with("  time")).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(timeless(shown), timeless(&said));
}

/// Every scene of the list whose answer is known, the knife's edge included.
#[test]
fn stability_of_the_list() {
    for entry in NAMED {
        let Some(expect) = entry.expect else { continue };
        let report = report(&[entry.name, "--seconds", "5", "--no-sleep"]);
        assert_eq!(report["stands"], expect == Stability::Stable, "{}: {report}", entry.name);
        assert_eq!(report["asleep_at_s"], Value::Null, "{} slept although it may not", entry.name);
    }
}

#[test]
fn same_run_same_hash() {
    let hash = |args: &[&str]| report(args)["hash"].clone();
    assert_eq!(hash(&["test-4", "--seconds", "1"]), hash(&["test-4", "--seconds", "1"]));
    assert_ne!(hash(&["test-4", "--seconds", "1"]), hash(&["test-4", "--seconds", "1", "--stiffness", "2e6"]));
}

/// The scene's own stiffness holds until the flag names another.
#[test]
fn stiffness_is_the_scenes_unless_the_flag_names_one() {
    let hash = |scene: &[&str], run: &[&str]| {
        let printed = teeter(&[&["scene"], scene].concat()).out;
        common::teeter_with(&[&["run", "-", "--seconds", "1", "--json"], run].concat(), printed.as_bytes()).json()["hash"].clone()
    };
    let default = hash(&["test-4"], &[]);
    let stiff = hash(&["test-4", "--stiffness", "3e6"], &[]);
    assert_ne!(stiff, default);
    assert_eq!(stiff, hash(&["test-4"], &["--stiffness", "3e6"]));
    assert_eq!(default, hash(&["test-4", "--stiffness", "3e6"], &["--stiffness", "1e6"]));
}

#[test]
fn single_and_double_agree() {
    for format in ["single", "double"] {
        let report = report(&["test-6", "--seconds", "3", "--no-sleep", "--precision", format]);
        assert_eq!(report["stands"], true);
        // The springs under six blocks of 0.19 N give by some micrometres, no more.
        let sink = report["sink_mm"].as_f64().unwrap();
        assert!((1e-4..0.02).contains(&sink), "{format}: {sink}");
        assert!(report["creep_mm"].as_f64().unwrap() < 1e-3);
    }
}

/// A block that falls from rest has come down by g t² / 2, which no spring has to do with.
#[test]
fn a_falling_block_is_seen_to_fall() {
    let scene = r#"{"name": "drop", "gravity": 9.81, "friction": 0.4, "blocks":
        [{"id": 42, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.5], "yaw": 0}]}"#;
    let report = common::teeter_with(&["run", "-", "--seconds", "3", "--json"], scene.as_bytes()).json();
    assert_eq!((&report["stands"], &report["fell"]), (&Value::from(false), &serde_json::json!([42])));
    let moved = report["max_displacement_mm"].as_f64().unwrap();
    assert!((moved - 491.0).abs() < 1.0, "{moved}");
    let sink = report["sink_mm"].as_f64().unwrap();
    assert!((sink - 491.0).abs() < 1.0, "{sink}");
}

#[test]
fn the_table_is_for_people() {
    let done = teeter(&["run", "test-4", "--seconds", "3"]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    assert!(done.out.starts_with("test-4: 2 of 3 blocks fell: 1, 2\n"), "{}", done.out);
    assert!(done.out.contains("0.58 N in all"), "{}", done.out);
    assert!(done.out.lines().skip(1).all(|l| l.starts_with("  ")));
}

#[test]
fn blocks_may_have_springs_of_wood() {
    let run =
        |stiffness: &str| report(&["column", "--form", "lattice", "--spring-stiffness", stiffness, "--seconds", "1"]);
    let (wood, soft) = (run("wood"), run("1e5"));
    assert_eq!(wood["hash"], run("3e7")["hash"]);
    assert!(soft["sink_mm"].as_f64().unwrap() > 3.0 * wood["sink_mm"].as_f64().unwrap(), "{soft} {wood}");
    let oak = teeter(&["run", "column", "--form", "lattice", "--spring-stiffness", "oak"]);
    assert!(oak.error_line().contains("expected a number from 1000 to 100000000, or wood"), "{}", oak.error_line());
}
