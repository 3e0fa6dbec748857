//! `teeter run`: whether a scene stands, and the figures that say how well.

use crate::common::{teeter, teeter_with};
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
        "energy",
        "fell",
        "hash",
        "max_displacement_mm",
        "penetration_mm",
        "rms_speed",
        "simulated_s",
        "sink_mm",
        "stands",
        "warnings",
    ];
    assert_eq!(fields, expected);
    assert_eq!((&report["stands"], &report["warnings"]), (&Value::from(true), &serde_json::json!([])));
    assert_eq!(report["fell"], serde_json::json!([]));
    assert!((report["simulated_s"].as_f64().unwrap() - 3.0).abs() < 1e-9);
    let hash = report["hash"].as_str().unwrap();
    assert!(hash.len() == 16 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{hash}");
    assert!(report["asleep_at_s"].as_f64().unwrap() < 3.0);
}

#[test]
fn a_fall_loses_its_energy_and_gains_none() {
    let mut scene = teeter_scene::named("block").unwrap();
    scene.blocks[0].pos[2] += 0.1;
    let report = teeter_with(&["run", "-", "--seconds", "2", "--json"], scene.to_json().as_bytes()).json();
    let energy = |name: &str| report["energy"][name].as_f64().unwrap();
    let height = scene.blocks[0].mass * scene.gravity * 0.1;
    assert!((energy("lost") / height - 1.0).abs() < 1e-3, "{report}");
    assert!(energy("put_in") == 0.0 && (0.0..1e-3 * height).contains(&energy("worst_gain")), "{report}");
    assert_eq!(report["warnings"], serde_json::json!([]));
}

/// The output of `teeter run` in the README, except for the time, which is that of a machine.
#[test]
fn the_readme_shows_the_output_of_run() {
    let readme = include_str!("../../../../README.md");
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
        teeter_with(&[&["run", "-", "--seconds", "1", "--json"], run].concat(), printed.as_bytes()).json()["hash"]
            .clone()
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
    let report = teeter_with(&["run", "-", "--seconds", "3", "--json"], scene.as_bytes()).json();
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

/// A block on the floor, sliding at 0.5 m/s.
const SLIDING: &str = r#"{"name": "sliding", "friction": 0.3, "restitution": 0.5, "blocks": [{"id": 5,
    "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009], "velocity": [0.5, 0, 0]}]}"#;

/// Runs a scene for a time (s) and returns the scene at the end.
fn end_of(scene: &[u8], seconds: &str) -> teeter_scene::Scene {
    let done = teeter_with(&["run", "-", "--seconds", seconds, "--ramp", "0", "--out", "-"], scene);
    assert_eq!(done.code, 0, "{}", done.err);
    teeter_scene::Scene::from_json(&done.out).unwrap()
}

/// Distance of the blocks of two scenes, m: the largest of all.
fn distance(a: &teeter_scene::Scene, b: &teeter_scene::Scene) -> f64 {
    let pairs = a.blocks.iter().zip(&b.blocks);
    let distance = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt();
    pairs.map(|(a, b)| distance(a.pos, b.pos)).fold(0.0, f64::max)
}

/// The end state lacks the strain of the contacts along their planes, which a sliding block builds
/// up again within nanometres.
#[test]
fn a_run_goes_on_from_the_scene_it_wrote() {
    for seconds in [0.1, 1.0] {
        let half = end_of(SLIDING.as_bytes(), &seconds.to_string());
        let again = end_of(half.to_json().as_bytes(), &seconds.to_string());
        let whole = end_of(SLIDING.as_bytes(), &(2.0 * seconds).to_string());
        assert!(distance(&again, &whole) < 1e-7, "{seconds}: {again:?} {whole:?}");
    }
    let half = end_of(SLIDING.as_bytes(), "0.1");
    let speed = half.blocks[0].velocity[0];
    assert!((speed - (0.5 - 0.3 * 9.81 * 0.1)).abs() < 2e-3, "{speed}");
}

#[test]
fn a_tower_at_rest_stays_where_it_was_written() {
    let column = teeter(&["scene", "column"]).out;
    let settled = end_of(column.as_bytes(), "2");
    assert!(settled.blocks.iter().all(|block| block.velocity == [0.0; 3]));
    let later = end_of(settled.to_json().as_bytes(), "1");
    assert!(distance(&settled, &later) < 1e-6, "{}", distance(&settled, &later));
}

#[test]
fn the_end_state_is_a_file_that_appears_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("end.json");
    let done = teeter(&["run", "test-5", "--seconds", "1", "--out", path.to_str().unwrap()]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    assert!(done.out.starts_with("test-5: stands\n"), "{}", done.out);
    let end = teeter_scene::Scene::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
    assert_eq!(end.blocks.len(), 4);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let missing = folder.path().join("none/end.json");
    let error = teeter(&["run", "tower", "--out", missing.to_str().unwrap()]).error_line().to_owned();
    assert!(error.ends_with("none/end.json: cannot be written: there is no such folder"), "{error}");
}

/// Without a ramp a block in the air falls freely from the first frame.
#[test]
fn the_ramp_of_gravity_can_be_set() {
    let drop = SLIDING.replace("[0, 0, 0.009]", "[0, 0, 0.5]").replace("[0.5, 0, 0]", "[0, 0, 0]");
    let speed = |ramp: &str| {
        let args = ["run", "-", "--seconds", "0.2", "--json", "--ramp", ramp];
        teeter_with(&args, drop.as_bytes()).json()["rms_speed"].as_f64().unwrap()
    };
    assert!((speed("0") - 9.81 * 0.2).abs() < 1e-6, "{}", speed("0"));
    // gravity grows with time: g t² / (2 ramp)
    assert!((speed("0.4") - 9.81 * 0.2 * 0.2 / 0.8).abs() < 0.02, "{}", speed("0.4"));
    assert!(teeter(&["run", "block", "--ramp", "61"]).error_line().contains("expected a number from 0 to 60"));
}

/// Nothing is changed in silence: each warning is a line on standard error and an entry of the
/// report.
#[test]
fn warnings_name_what_a_world_changes() {
    let bouncy = SLIDING.replace("\"restitution\": 0.5", "\"restitution\": 0.99");
    let inputs = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(inputs.path(), "{\"time\": 3}\n{\"time\": 2}").unwrap();
    let args = ["run", "-", "--seconds", "1", "--json", "--inputs", inputs.path().to_str().unwrap()];
    let report = teeter_with(&args, bouncy.as_bytes()).json();
    let expected = [
        "`restitution` is 0.99, contacts have 0.96: they can have 0 to 0.96",
        "2 changes of the inputs begin after the end of the run, the first at 2 s",
    ];
    assert_eq!(report["warnings"], serde_json::json!(expected));
    let mut sunk = teeter_scene::named("test-5").unwrap();
    // two blocks into the one below
    sunk.blocks[2..].iter_mut().for_each(|block| block.pos[2] -= 1e-5);
    let report = teeter_with(&["run", "-", "--seconds", "1", "--json"], sunk.to_json().as_bytes()).json();
    assert_eq!(report["warnings"], serde_json::json!(["2 pairs of blocks overlap, by up to 0.0100 mm"]));
}

/// Blocks deep inside each other, as a drawing has them, are refused or pushed apart.
#[test]
fn overlapping_blocks_are_pushed_apart_on_demand() {
    let mut scene = teeter_scene::named("test-5").unwrap();
    scene.blocks[2..].iter_mut().for_each(|block| block.pos[2] -= 3.4e-4);
    let text = scene.to_json();
    let refused = teeter_with(&["run", "-"], text.as_bytes());
    let expected = "standard input: blocks 1 and 2: `pos` makes them overlap by 0.340 mm";
    assert!(refused.error_line().starts_with(expected), "{}", refused.err);
    assert!(refused.error_line().ends_with("; `teeter run --settle` pushes blocks apart"), "{}", refused.err);
    let args = ["run", "-", "--settle", "--seconds", "1", "--json"];
    let report = teeter_with(&args, text.as_bytes()).json();
    assert_eq!(report["warnings"], serde_json::json!(["pushed 2 blocks apart, by up to 0.34 mm"]));
    assert_eq!(report["stands"], true);
    assert!(report["max_displacement_mm"].as_f64().unwrap() < 0.01, "{report}");
    let report = teeter_with(&args, teeter(&["scene", "test-5"]).out.as_bytes()).json();
    assert_eq!(report["warnings"], serde_json::json!([]));
}

/// Contacts under load are overlaps. Where they are deeper than a scene may have, the end state is
/// written all the same and can be read on demand.
#[test]
fn an_end_state_with_deep_contacts_comes_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("soft.json");
    let path = path.to_str().unwrap();
    let report = report(&["column", "--stiffness", "1e4", "--seconds", "2", "--ramp", "0", "--out", path]);
    let warning = report["warnings"][0].as_str().unwrap();
    assert!(warning.starts_with("the state at the end is not a valid scene: block 0: `pos` is 8.936 mm"), "{warning}");
    assert!(warning.ends_with("; `teeter run --settle` reads it and pushes blocks apart"), "{warning}");
    teeter(&["run", path]).error_line();
    assert_eq!(self::report(&[path, "--settle", "--seconds", "1"])["stands"], true);
}

/// A body of 400 kg falls by 15 m onto a cube of 8 kg: its contacts give by more than half an edge.
#[test]
fn an_impact_that_presses_a_block_halfway_into_another_is_a_warning() {
    let scene = |stiffness: f64| {
        let light = r#"{"id": 3, "size": [0.089, 0.089, 0.089], "mass": 8, "pos": [0, 0, 0.0445]}"#;
        let heavy = r#"{"id": 7, "size": [0.4, 0.4, 0.4], "mass": 400, "pos": [0.01, 0.02, 15.289]}"#;
        format!(r#"{{"name": "impact", "friction": 0.4, "stiffness": {stiffness}, "blocks": [{light}, {heavy}]}}"#)
    };
    let warnings = |stiffness| {
        let done = teeter_with(&["run", "-", "--seconds", "2", "--json"], scene(stiffness).as_bytes());
        done.json()["warnings"].clone()
    };
    let soft = warnings(3e5);
    let text = soft[0].as_str().unwrap();
    assert!(text.contains("block 3 was ") && text.contains(" mm deep in the floor"), "{text}");
    assert_eq!(warnings(1e7), serde_json::json!([]));
}
