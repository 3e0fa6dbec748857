//! `teeter run --inputs`: forces, drives, hands and gravity over time, on blocks named by their
//! ids.

use std::path::PathBuf;

use crate::common::{Done, teeter, teeter_with};
use teeter_scene::Scene;

/// Two blocks side by side on a floor of friction 0.4, with ids that are not their indices.
const TWO: &str = r#"{"name": "two", "friction": 0.4, "restitution": 0.5, "blocks": [
    {"id": 70, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009]},
    {"id": 9, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0.5, 0.009]}]}"#;

/// Weight of a block, N.
const WEIGHT: f64 = 0.0196 * 9.81;

/// Runs `scene` with lines of inputs.
fn run(scene: &str, inputs: &str, args: &[&str]) -> Done {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("inputs.jsonl");
    std::fs::write(&path, inputs).unwrap();
    let fixed = ["run", "-", "--ramp", "0", "--inputs", path.to_str().unwrap()];
    teeter_with(&[&fixed, args].concat(), scene.as_bytes())
}

/// The blocks after some seconds.
fn end(scene: &str, inputs: &str, seconds: &str) -> Scene {
    let done = run(scene, inputs, &["--seconds", seconds, "--out", "-"]);
    assert_eq!(done.code, 0, "{}", done.err);
    Scene::from_json(&done.out).unwrap()
}

/// Error line for lines of inputs, after the name of the file.
fn error(inputs: &str) -> String {
    let done = run(TWO, inputs, &[]);
    done.error_line().split_once("inputs.jsonl").unwrap().1.to_owned()
}

/// A column of two blocks, of which a hand takes the upper one and lays it beside the lower one.
#[test]
fn a_block_that_the_hand_lays_down_has_not_fallen() {
    let column = TWO.replace("[0, 0.5, 0.009]", "[0, 0, 0.027]");
    let carried = |velocity: &str, time: f64| {
        format!(r#"{{"time": {time}, "hand": {{"block": 9, "grip": "carry", "velocity": {velocity}}}}}"#)
    };
    let lift = [("[0, 0, 0.02]", 0.2), ("[0, 0.1, 0]", 0.7), ("[0, 0, -0.02]", 1.2), ("[0, 0, 0]", 2.6)];
    let lines: Vec<String> = lift.iter().map(|&(velocity, time)| carried(velocity, time)).collect();
    let inputs = lines.join("\n") + "\n" + r#"{"time": 2.8, "hand": null}"#;
    let report = |inputs: &str| -> serde_json::Value {
        let done = run(&column, inputs, &["--seconds", "4", "--json"]);
        serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err))
    };
    let laid = report(&inputs);
    assert_eq!((&laid["stands"], &laid["fell"]), (&true.into(), &serde_json::json!([])), "{laid}");
    assert!(laid["sink_mm"].as_f64().unwrap() > 17.0, "the block is down: {laid}");
    // one that is pushed off by a force has fallen
    let pushed = report(r#"{"time": 0, "forces": [{"block": 9, "force": [0, 0.3, 0]}]}"#);
    assert_eq!(pushed["fell"], serde_json::json!([9]), "{pushed}");
}

/// A force of twice the friction accelerates the block by friction / mass.
#[test]
fn a_force_acts_on_the_block_of_that_id_from_its_time() {
    let inputs = format!(r#"{{"time": 1, "forces": [{{"block": 9, "force": [{}, 0, 0]}}]}}"#, 2.0 * 0.4 * WEIGHT);
    let scene = end(TWO, &inputs, "2");
    let exact = 0.5 * 0.4 * 9.81;
    let [still, pushed] = [0, 1].map(|i: usize| scene.blocks[i].pos[0]);
    // the force grows within a frame, which delays it by half of one
    assert!((pushed / exact - 1.0).abs() < 0.03, "{pushed} {exact}");
    assert!(still.abs() < 1e-6, "{still}");
}

#[test]
fn forces_end_with_an_empty_list() {
    let force = 0.2 * WEIGHT;
    let on = format!(r#"{{"time": 0, "forces": [{{"block": 70, "force": [{force}, 0, 0]}}], "gravity": [0, 0, 0]}}"#);
    let scene = end(TWO, &format!("{on}\n\n{}\n", r#"{"time": 0.5, "forces": []}"#), "1");
    // weightless, so that nothing but the force acts, which takes a frame to grow
    let speed = 0.2 * 9.81 * (0.5 - 0.5 / 60.0);
    assert!((scene.blocks[0].velocity[0] / speed - 1.0).abs() < 1e-3, "{:?}", scene.blocks[0]);
}

#[test]
fn a_drive_moves_a_block_at_its_velocity() {
    let inputs = r#"{"time": 0, "drives": [{"block": 9, "velocity": [0.1, 0, 0]}]}"#;
    let scene = end(TWO, inputs, "1");
    assert!((scene.blocks[1].pos[0] - 0.1).abs() < 2e-3, "{:?}", scene.blocks[1]);
}

#[test]
fn a_hand_draws_and_carries_a_block() {
    let inputs = concat!(
        r#"{"time": 0.5, "hand": {"block": 9, "grip": "slide", "anchor": [0.0405, 0, 0], "velocity": [0.1, 0, 0]}}"#,
        "\n",
        r#"{"time": 1.5, "hand": {"block": 9, "grip": "carry", "velocity": [0, 0, 0.1]}}"#,
        "\n",
        r#"{"time": 2.5, "hand": {"block": 9, "grip": "carry"}}"#,
    );
    let block = |seconds| end(TWO, inputs, seconds).blocks[1].clone();
    let drawn = block("1.5");
    assert!((drawn.pos[0] - 0.1).abs() < 2e-3 && (drawn.pos[1] - 0.5).abs() < 1e-4, "{drawn:?}");
    let carried = block("3.5");
    assert!((carried.pos[2] - 0.109).abs() < 2e-3, "{carried:?}");
    assert!(carried.velocity.iter().all(|v| v.abs() < 1e-3), "{carried:?}");
}

#[test]
fn a_push_goes_along_its_axis() {
    let inputs = r#"{"time": 0, "hand": {"block": 70, "grip": "push", "axis": [2, 0, 0], "anchor": [-0.0405, 0, 0], "velocity": [0.05, 0, 0]}}"#;
    let scene = end(TWO, inputs, "1");
    assert!((scene.blocks[0].pos[0] - 0.05).abs() < 3e-3, "{:?}", scene.blocks[0]);
}

/// Gravity that leans by more than the angle of friction lets both blocks slide.
#[test]
fn gravity_leans_and_returns() {
    let inputs = concat!(r#"{"time": 0, "gravity": [4.905, 0, -9.81]}"#, "\n", r#"{"time": 0.5, "gravity": null}"#);
    let scene = end(TWO, inputs, "2");
    // 0.1 g over half a second, and then friction of 0.4 g stops the blocks
    let speed = 0.1 * 9.81 * 0.5;
    let exact = 0.5 * speed * 0.5 + speed * speed / (2.0 * 0.4 * 9.81);
    for block in scene.blocks {
        assert!((block.pos[0] / exact - 1.0).abs() < 0.02, "{block:?} {exact}");
    }
}

#[test]
fn errors_name_the_line_and_the_field() {
    for (inputs, expected) in [
        ("", ": no inputs, expected one JSON object a line"),
        ("\n\n{\"time\": 0", ", line 3: this is not JSON: EOF while parsing an object (column 10)"),
        (
            "[1]",
            ", line 1: this is [1], expected an object with the fields of a change: time, gravity, hand, forces, drives",
        ),
        ("{}", ", line 1: a change lacks `time`, expected the time from which the change holds, s"),
        (r#"{"time": -1}"#, ", line 1: `time` is -1, expected a number from 0 to 86400 s"),
        (r#"{"time": "1 s"}"#, ", line 1: `time` is \"1 s\", expected a number from 0 to 86400 s"),
        (r#"{"time": 0, "drive": []}"#, ", line 1: `drive` is not a field of a change: did you mean `drives`?"),
        (r#"{"time": 0, "gravty": null}"#, ", line 1: `gravty` is not a field of a change: did you mean `gravity`?"),
        (
            r#"{"time": 0, "wind": 3}"#,
            ", line 1: `wind` is not a field of a change, which are time, gravity, hand, forces, drives",
        ),
        (r#"{"time": 0, "gravity": -9.81}"#, ", line 1: `gravity` is -9.81, expected a list of three numbers, m/s²"),
        (
            r#"{"time": 0, "gravity": [0, 0, -981]}"#,
            ", line 1: `gravity` is [0,0,-981], expected a vector of at most 100 m/s²",
        ),
        (r#"{"time": 0, "forces": {"block": 9}}"#, ", line 1: `forces` is an object, expected a list"),
    ] {
        assert_eq!(error(inputs), expected);
    }
}

#[test]
fn errors_of_hands_forces_and_drives_name_the_path() {
    let of = |line: &str| error(&format!("{{\"time\": 0}}\n{{\"time\": 1, {line}}}")).replace(", line 2: ", "");
    for (line, expected) in [
        (r#""hand": {"body": 9, "grip": "slide"}"#, "`hand.body` is not a field of a hand: did you mean `block`?"),
        (r#""hand": {"grip": "slide"}"#, "a hand lacks `hand.block`, expected the id of a block of the scene"),
        (r#""hand": {"block": 1, "grip": "slide"}"#, "`hand.block` is 1, expected the id of a block of the scene"),
        (r#""hand": {"block": 9}"#, "a hand lacks `hand.grip`, expected \"slide\", \"carry\" or \"push\""),
        (
            r#""hand": {"block": 9, "grip": "hold"}"#,
            "`hand.grip` is \"hold\", expected \"slide\", \"carry\" or \"push\"",
        ),
        (
            r#""hand": {"block": 9, "grip": "push"}"#,
            "a hand lacks `hand.axis`, expected the direction of the push, a vector that is not zero",
        ),
        (
            r#""hand": {"block": 9, "grip": "push", "axis": [0, 0, 0]}"#,
            "`hand.axis` is [0,0,0], expected the direction of the push, a vector that is not zero",
        ),
        (
            r#""hand": {"block": 9, "grip": "slide", "axis": [0, 0, 1]}"#,
            "`hand.axis` is [0,0,1], expected none: it is the direction of a push",
        ),
        (
            r#""hand": {"block": 9, "grip": "slide", "max_force": 51}"#,
            "`hand.max_force` is 51, expected a number from 0 to 50 N",
        ),
        (
            r#""hand": {"block": 9, "grip": "slide", "target": [0, 1]}"#,
            "`hand.target` is [0,1], expected a list of three numbers, m",
        ),
        (
            r#""hand": {"block": 9, "grip": "carry", "orientation": [0, 0, 0, 2]}"#,
            "`hand.orientation` is [0,0,0,2], expected a quaternion x, y, z, w of unit length",
        ),
        (
            r#""forces": [{"block": 9, "force": [0, 0, 0]}, {"block": 9}]"#,
            "a force lacks `forces[1].force`, expected a list of three numbers, N",
        ),
        (
            r#""drives": [{"block": 9, "velocity": [0, 0, null]}]"#,
            "`drives[0].velocity` is a list of 3, expected a list of three numbers, m/s",
        ),
    ] {
        assert_eq!(of(line), expected);
    }
}

#[test]
fn standard_input_is_one_file() {
    let done = teeter(&["run", "-", "--inputs", "-"]);
    assert_eq!(
        done.error_line(),
        "standard input cannot be both the scene and the inputs: give the file of one of them"
    );
    let done = teeter_with(&["run", "block", "--seconds", "0.1", "--json", "--inputs", "-"], b"{\"time\": 0}");
    assert_eq!(done.json()["stands"], true);
}
