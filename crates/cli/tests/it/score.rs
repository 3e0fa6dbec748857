//! `teeter score`: a prediction a scene, in the file's order, and the comparison with the labels.
//!
//! The 400 towers that stand or fall are a test of the engine; here are some of them, all that are
//! tilted, and the file's form.

use std::io::{Read, Write};
use std::path::PathBuf;

use crate::common::{teeter, teeter_with};
use serde_json::Value;

/// Lines of a file of labelled towers.
fn labelled(name: &str) -> Vec<String> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../data/oracle").join(name);
    let mut text = String::new();
    flate2::read::GzDecoder::new(std::fs::File::open(path).unwrap()).read_to_string(&mut text).unwrap();
    text.lines().map(str::to_owned).collect()
}

fn parse(line: &str) -> Value {
    serde_json::from_str(line).unwrap()
}

#[test]
fn towers_that_stand_and_fall() {
    let all = labelled("config.jsonl.gz");
    assert_eq!(all.len(), 400);
    let some: Vec<&String> = all.iter().step_by(10).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.jsonl.gz");
    let mut packer = flate2::write::GzEncoder::new(std::fs::File::create(&path).unwrap(), flate2::Compression::fast());
    some.iter().for_each(|line| writeln!(packer, "{line}").unwrap());
    packer.finish().unwrap();
    let out = folder.path().join("out.jsonl");

    let done = teeter(&["score", path.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    assert!(done.out.starts_with("40 scenes\n  40 of 40 labels right"), "{}", done.out);
    let predictions = std::fs::read_to_string(&out).unwrap();
    assert_eq!(predictions.lines().count(), 40);
    for (scene, prediction) in some.iter().zip(predictions.lines()) {
        let (scene, prediction) = (parse(scene), parse(prediction));
        assert_eq!(prediction["name"], scene["name"]);
        assert_eq!(prediction["fell"], scene["label"] == "unstable", "{prediction}");
        assert_eq!(prediction.as_object().unwrap().len(), 2);
    }
}

#[test]
fn wrong_labels_are_counted() {
    // The first ten with their labels turned round: a score that ignores predictions would count
    // them as right.
    let turned: Vec<String> = labelled("config.jsonl.gz")[..10]
        .iter()
        .map(|line| {
            let mut scene = parse(line);
            scene["label"] = Value::from(if scene["label"] == "stable" { "unstable" } else { "stable" });
            scene.to_string()
        })
        .collect();
    let summary = teeter_with(&["score", "-", "--json"], turned.join("\n").as_bytes()).json();
    assert_eq!((&summary["scenes"], &summary["config"]["right"]), (&Value::from(10), &Value::from(0)));
    assert_eq!(summary["config"]["wrong"].as_array().unwrap().len(), 10);
    assert_eq!(summary["warnings"].as_array().unwrap().len(), 0);
}

/// Angles of collapse of all tilted towers: what the labels say is exact for toppling and an upper
/// bound for all.
#[test]
fn towers_that_are_tilted() {
    let all = labelled("tilt.jsonl.gz");
    assert_eq!(all.len(), 50);
    let summary = teeter_with(&["score", "-", "--json"], all.join("\n").as_bytes()).json();
    let (clear, sides) = (&summary["tilt"], &summary["tilt_side_sensitive"]);
    assert_eq!((clear["labelled"].as_u64(), sides["labelled"].as_u64()), (Some(41), Some(9)));
    assert!(clear["median_abs_deg"].as_f64().unwrap() <= 0.15, "{clear}");
    assert!(clear["p95_abs_deg"].as_f64().unwrap() <= 0.4, "{clear}");
    for part in [clear, sides] {
        assert_eq!((&part["over"], &part["never_fell"]), (&Value::from(0), &Value::from(0)), "{part}");
    }
}

/// A block on a slope slides where the tangent is the coefficient of friction, if it is flat enough
/// not to topple first.
#[test]
fn a_block_slides_at_the_angle_of_friction() {
    let scene = r#"{"name": "slope", "friction": 0.3, "tilt_az": 0.7, "blocks":
        [{"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009], "yaw": 0.4}]}"#;
    let scene = scene.replace('\n', " ");
    let done = teeter_with(&["score", "-"], scene.as_bytes());
    let tilt = parse(&done.out)["tilt_deg"].as_f64().unwrap();
    let exact = 16.6992;
    assert!((tilt - exact).abs() < 0.05, "{tilt}, {exact}");
}

#[test]
fn a_scene_that_never_falls_says_so() {
    let scene = r#"{"name": "glued", "friction": 2.0, "tilt_az": 0.0, "blocks": [{"id": 0, "size": [0.1, 0.1, 0.01], "mass": 0.1, "pos": [0, 0, 0.005]}]}"#;
    let done = teeter_with(&["score", "-"], scene.as_bytes());
    assert_eq!(parse(&done.out), serde_json::json!({"name": "glued", "tilt_deg": null}));
}
