//! Errors of scenes: one line that names the block, the field and the expected value.

use serde_json::{Value, json};
use teeter_scene::{MAX_BLOCKS, Scene, SceneError};

fn valid_scene() -> Value {
    json!({"name": "two", "gravity": 9.81, "friction": 0.4, "restitution": 0.0, "stiffness": 1e6, "family": "unknown fields are ignored", "blocks": [
        {"id": 7, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.009], "yaw": 0.0},
        {"id": 9, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.027], "yaw": 0.3}]})
}

fn error_line(text: &str) -> String {
    let error = Scene::from_json(text).expect_err(text).to_string();
    assert!(!error.contains('\n'), "{error:?}");
    error
}

/// Writes a value to one field.
type SetField = fn(&mut Scene, f64);

/// Returns the error of the valid scene with one value changed, or removed.
fn error_with(pointer: &str, value: Option<Value>) -> String {
    let mut scene = valid_scene();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match (value, scene.pointer_mut(parent).unwrap()) {
        (Some(v), _) => *scene.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = v,
        (None, Value::Object(o)) => drop(o.remove(key).unwrap()),
        (None, other) => panic!("{other} has no fields"),
    }
    error_line(&scene.to_string())
}

#[test]
fn the_good_scene_is_valid_scene() {
    let scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    assert_eq!(scene.blocks.len(), 2);
    let mut plain = valid_scene();
    for optional in ["gravity", "restitution", "stiffness"] {
        plain.as_object_mut().unwrap().remove(optional);
    }
    plain["blocks"][0].as_object_mut().unwrap().remove("yaw");
    assert_eq!(Scene::from_json(&plain.to_string()).unwrap(), scene);
    assert!(Scene::from_json(&format!("\u{feff}{}\r\n", valid_scene())).is_ok(), "a byte order mark is accepted");
}

#[test]
fn missing_fields_are_named() {
    for field in ["name", "friction", "blocks"] {
        let error = error_with(&format!("/{field}"), None);
        assert!(error.starts_with(&format!("missing field `{field}` (line 1")), "{error}");
    }
    for field in ["id", "size", "mass", "pos"] {
        let error = error_with(&format!("/blocks/1/{field}"), None);
        let block = if field == "id" { "block at index 1 of the list" } else { "block 9" };
        assert!(error.starts_with(&format!("{block}: missing field `{field}` (line 1")), "{error}");
    }
}

#[test]
fn values_of_the_wrong_type_are_named() {
    assert!(
        error_with("/blocks/1/mass", Some(json!("heavy")))
            .starts_with("block 9: `mass`: invalid type: string \"heavy\", expected f64")
    );
    assert!(error_with("/blocks/1/pos", Some(json!([0.0, 1.0]))).starts_with("block 9: `pos`: invalid length 2"));
    assert!(
        error_with("/blocks/1/id", Some(json!(-1)))
            .starts_with("block at index 1 of the list: `id`: invalid value: integer `-1`")
    );
    assert!(error_with("/friction", Some(Value::Null)).starts_with("`friction`: invalid type: null"));
    assert!(
        error_with("/stiffness", Some(json!("stiff")))
            .starts_with("`stiffness`: invalid type: string \"stiff\", expected f64")
    );
    assert!(error_with("/blocks", Some(json!({}))).starts_with("`blocks`: invalid type: map, expected a sequence"));
}

#[test]
fn non_finite_values_are_rejected() {
    for field in ["mass", "yaw"] {
        let error = error_with(&format!("/blocks/0/{field}"), Some(Value::Null));
        assert!(error.starts_with(&format!("block 7: `{field}`: invalid type: null, expected f64")), "{error}");
    }
    for field in ["size", "pos"] {
        let error = error_with(&format!("/blocks/0/{field}/1"), Some(Value::Null));
        assert!(error.starts_with(&format!("block 7: `{field}[1]`: invalid type: null")), "{error}");
    }
    let text = valid_scene().to_string();
    let error = error_line(&text.replacen("0.0196", "1e999", 1));
    assert!(error.contains("`mass`: number out of range"), "{error}");
    let error = error_line(&text.replacen("0.0196", "NaN", 1));
    assert!(error.contains("this is not JSON: expected value"), "{error}");
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let base = Scene::from_json(&text).unwrap();
        let fields: [(&str, SetField); 10] = [
            ("block 7: `size`", |s, x| s.blocks[0].size[2] = x),
            ("block 7: `mass`", |s, x| s.blocks[0].mass = x),
            ("block 7: `pos`", |s, x| s.blocks[0].pos[0] = x),
            ("block 7: `yaw`", |s, x| s.blocks[0].yaw = x),
            ("`gravity`", |s, x| s.gravity = x),
            ("`friction`", |s, x| s.friction = x),
            ("`kinetic_friction`", |s, x| s.kinetic_friction = Some(x)),
            ("`restitution`", |s, x| s.restitution = x),
            ("`stiffness`", |s, x| s.stiffness = x),
            ("`tilt_az`", |s, x| s.tilt_az = Some(x)),
        ];
        for (field, set) in fields {
            let mut scene = base.clone();
            set(&mut scene, value);
            let error = scene.validate().unwrap_err().to_string();
            assert!(error.starts_with(&format!("{field} is ")), "{error}");
        }
    }
}

#[test]
fn values_out_of_range_are_rejected() {
    for value in [0.0, -0.01, 10.5, 1e-4] {
        let error = error_with("/blocks/1/size/1", Some(json!(value)));
        assert_eq!(
            error,
            format!("block 9: `size` is [0.081, {value}, 0.018] m, expected three lengths of 0.001 to 10 m")
        );
    }
    for value in [0.0, -1.0] {
        assert_eq!(
            error_with("/blocks/1/mass", Some(json!(value))),
            format!("block 9: `mass` is {value} kg, expected above 0 and at most 10000 kg")
        );
    }
    for (field, value, expected) in [
        ("gravity", -1.0, "0 to 100 m/s²"),
        ("gravity", 101.0, "0 to 100 m/s²"),
        ("friction", -0.1, "0 to 2"),
        ("friction", 2.1, "0 to 2"),
        ("restitution", 1.1, "0 to 1"),
        ("stiffness", 9999.0, "1e4 to 1e8 N/m"),
        ("stiffness", 100000001.0, "1e4 to 1e8 N/m"),
        ("stiffness", -1000000.0, "1e4 to 1e8 N/m"),
    ] {
        assert_eq!(
            error_with(&format!("/{field}"), Some(json!(value))),
            format!("`{field}` is {value}, expected {expected}")
        );
    }
    let mut scene = valid_scene();
    scene["kinetic_friction"] = json!(0.5);
    assert_eq!(error_line(&scene.to_string()), "`kinetic_friction` is 0.5, expected at most `friction`, 0.4");
    scene["kinetic_friction"] = json!(0.3);
    assert_eq!(Scene::from_json(&scene.to_string()).unwrap().kinetic_friction, Some(0.3));
    scene["label"] = json!("sturdy");
    assert_eq!(error_line(&scene.to_string()), "`label` is \"sturdy\", expected `stable` or `unstable`");
    assert!(
        error_with("/blocks/1/pos/0", Some(json!(2000))).starts_with("block 9: `pos` is [2000, 0, 0.027] m, expected")
    );
}

#[test]
fn overlapping_blocks_are_rejected() {
    let error = error_with("/blocks/0/pos/2", Some(json!(0.008)));
    assert_eq!(
        error,
        "block 7: `pos` is 8.000 mm above the floor at its centre, expected at least half its height, 9.000 mm"
    );
    let error = error_with("/blocks/1/pos/2", Some(json!(0.0265)));
    assert_eq!(error, "blocks 7 and 9: `pos` makes them overlap by 0.500 mm, expected at most 0.001 mm");
    let mut touching = valid_scene();
    touching["blocks"][1]["pos"][2] = json!(0.0269995);
    assert!(Scene::from_json(&touching.to_string()).is_ok(), "half a micrometre is rounding");
    let error = error_with("/blocks/1/id", Some(json!(7)));
    assert_eq!(
        error,
        "block 7: `id` is used twice, by the blocks at indices 0 and 1 of the list, expected one block an id"
    );
}

#[test]
fn empty_and_oversized_scenes_are_rejected() {
    assert_eq!(error_with("/blocks", Some(json!([]))), "`blocks` is a list of 0, expected 1 to 20000 blocks");
    let mut scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    let block = scene.blocks[0].clone();
    let put = |i: usize| {
        let mut b = block.clone();
        b.id = i as u32;
        b.pos = [0.1 * (i % 150) as f64, 0.1 * (i / 150) as f64, 0.009];
        b
    };
    scene.blocks = (0..MAX_BLOCKS).map(put).collect();
    assert_eq!(scene.validate(), Ok(()));
    scene.blocks.push(put(MAX_BLOCKS));
    assert_eq!(scene.validate().unwrap_err().to_string(), "`blocks` is a list of 20001, expected 1 to 20000 blocks");
}

#[test]
fn the_first_of_many_overlaps_is_named() {
    let mut scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    let block = scene.blocks[0].clone();
    scene.blocks = (0..500).map(|i| teeter_scene::Block { id: 1000 - i, ..block.clone() }).collect();
    assert!(matches!(scene.validate(), Err(SceneError::Overlap { a: 1000, b: 999, .. })));
}

#[test]
fn text_that_is_not_a_scene_is_rejected() {
    assert_eq!(error_line(""), "the scene is empty, expected JSON");
    assert_eq!(error_line(" \n\t"), "the scene is empty, expected JSON");
    assert_eq!(
        error_line("[]"),
        "the scene is a JSON list, expected a JSON object with `name`, `friction` and `blocks`"
    );
    assert_eq!(
        error_line("3"),
        "the scene is a JSON number, expected a JSON object with `name`, `friction` and `blocks`"
    );
    assert!(error_line("hello").starts_with("this is not JSON: expected value (line 1, column 1)"));
    assert!(error_line("{\"name\": ").starts_with("this is not JSON: EOF while parsing a value"));
    assert!(error_line(&format!("{} x", valid_scene())).starts_with("this is not JSON: trailing characters"));
    let error = error_line(&format!("{{\"x\":{}", "[".repeat(100_000)));
    assert!(error.starts_with("this is not JSON: EOF while parsing a list"), "{error}");
    let error = error_line(&format!("{{\"blocks\":{}", "[".repeat(100_000)));
    assert!(error.starts_with("block at index 0 of the list: "), "{error}");
}

#[test]
fn reading_stops_at_the_limit() {
    let text = valid_scene().to_string();
    assert!(Scene::read(text.as_bytes(), text.len() as u64).is_ok());
    assert_eq!(Scene::read(std::io::repeat(b' '), 3_000_000), Err(SceneError::TooLarge { limit_mb: 3 }));
    assert_eq!(Scene::read(&b"{\"name\": \"\xff\"}"[..], 100), Err(SceneError::NotUtf8(10)));
}
