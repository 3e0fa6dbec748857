//! Errors of scenes whose JSON has another form: one line in the words of JSON.

use crate::common::{error_line, error_with, error_with_field, valid_scene};
use serde_json::{Value, json};
use teeter_scene::Scene;

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

/// Asserts the error of each value in the JSON, by its pointer.
fn assert_errors(cases: &[(&str, &str, &str)]) {
    for (pointer, value, expected) in cases {
        let error = error_with(pointer, Some(serde_json::from_str(value).unwrap()));
        assert!(error.starts_with(&format!("{expected} (line 1, column ")), "{error}");
    }
}

#[test]
fn values_of_another_kind_are_named_in_the_words_of_json() {
    assert_errors(&[
        ("/blocks/1/mass", r#""heavy""#, r#"block 9: `mass` is the text "heavy", expected a number"#),
        (
            "/blocks/1/mass",
            r#""0.02""#,
            r#"block 9: `mass` is the text "0.02", expected a number, without quotation marks"#,
        ),
        ("/blocks/1/mass", r#"[1]"#, r#"block 9: `mass` is a list, expected a number"#),
        ("/blocks/1/mass", r#"{}"#, r#"block 9: `mass` is an object, expected a number"#),
        ("/blocks/1/mass", r#"true"#, r#"block 9: `mass` is true, expected a number"#),
        ("/blocks/1/yaw", r#"null"#, r#"block 9: `yaw` is null, expected a number"#),
        (
            "/blocks/1/id",
            r#"-1"#,
            r#"block at index 1 of the list: `id` is -1, expected a whole number from 0 to 4294967295"#,
        ),
        (
            "/blocks/1/id",
            r#""b""#,
            r#"block at index 1 of the list: `id` is the text "b", expected a whole number from 0 to 4294967295"#,
        ),
        (
            "/blocks/1/id",
            r#"0.5"#,
            r#"block at index 1 of the list: `id` is 0.5, expected a whole number from 0 to 4294967295"#,
        ),
        ("/blocks/1", r#"3"#, r#"block at index 1 of the list is 3, expected an object: a block"#),
        ("/blocks/1", r#"[3]"#, r#"block at index 1 of the list is a list, expected an object: a block"#),
        ("/name", r#"3"#, r#"`name` is 3, expected a text of at most 10000 characters"#),
        ("/friction", r#"null"#, r#"`friction` is null, expected a number"#),
        ("/stiffness", r#""stiff""#, r#"`stiffness` is the text "stiff", expected a number"#),
        ("/blocks", r#"{}"#, r#"`blocks` is an object, expected a list of blocks"#),
        (
            "/gravity",
            r#"[0, 0, -9.81]"#,
            r#"`gravity` is a list, expected one number: the acceleration downwards, such as 9.81 m/s²"#,
        ),
    ]);
}

#[test]
fn lists_of_another_length_are_named() {
    assert_errors(&[
        (
            "/blocks/1/pos",
            r#"[0.0, 1.0]"#,
            r#"block 9: `pos` has 2 numbers, expected 3: x, y and z of the centre in m"#,
        ),
        ("/blocks/0/size", r#"[1, 1, 1, 1]"#, r#"block 7: `size` has 4 numbers, expected 3: the edge lengths in m"#),
        ("/blocks/0/size", r#"[]"#, r#"block 7: `size` has 0 numbers, expected 3: the edge lengths in m"#),
        ("/blocks/0/size", r#"0.1"#, r#"block 7: `size` is 0.1, expected a list of 3 numbers: the edge lengths in m"#),
        ("/blocks/0/size/1", r#"null"#, r#"block 7: `size[1]` is null, expected a number"#),
        (
            "/blocks/0/pos",
            r#"{"x": 0}"#,
            r#"block 7: `pos` is an object, expected a list of 3 numbers: x, y and z of the centre in m"#,
        ),
    ]);
}

#[test]
fn optional_fields_of_another_kind_are_named() {
    for (field, value, expected) in [
        ("form", json!("soft"), "`form` is the text \"soft\", expected rigid or lattice"),
        ("form", json!(1), "`form` is 1, expected rigid or lattice"),
        ("springs", json!([]), "`springs` is a list, expected an object: springs"),
        ("springs", json!({"damping": "low"}), "`springs.damping` is the text \"low\", expected a number"),
        (
            "springs",
            json!({"particles": "middle"}),
            "`springs.particles` is the text \"middle\", expected inside or corners",
        ),
        ("edge_radius", json!("1 mm"), "`edge_radius` is the text \"1 mm\", expected a number"),
    ] {
        let error = error_with_field("", field, value);
        assert!(error.starts_with(&format!("{expected} (line 1, column ")), "{error}");
    }
    let error = error_with_field("/blocks/0", "fixed", json!("yes"));
    assert!(error.starts_with("block 7: `fixed` is the text \"yes\", expected true or false (line 1"), "{error}");
}

#[test]
fn an_error_has_the_line_and_column_where_it_was_found() {
    let error = error_line("{\"name\": \"a\",\n \"friction\": \"b\", \"blocks\": []}");
    assert_eq!(error, "`friction` is the text \"b\", expected a number (line 2, column 16)");
    // The id comes after the error, and the text ends before the block does.
    let error = error_line("{\"blocks\": [{},\n{\"mass\": [], \"id\": 5, ");
    assert!(error.starts_with("block at index 0 of the list: missing field `id` (line 1, column 14)"), "{error}");
    let error = error_line("{\"blocks\": [{\"mass\": [], \"id\": 5, ");
    assert!(error.starts_with("block 5: `mass` is a list, expected a number (line 1, column "), "{error}");
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
    assert!(error_line("{\"name\": ").starts_with("this is not JSON: the text ends where a value is expected (line 1"));
    let error = error_line(&format!("{} x", valid_scene()));
    assert!(error.starts_with("this is not JSON: there is more after the end of the scene"), "{error}");
    let error = error_line(&format!("{{\"comment\":{}", "[".repeat(100_000)));
    assert!(error.starts_with("this is not JSON: the text ends inside a list"), "{error}");
    let error = error_line(&format!("{{\"blocks\":{}", "[".repeat(100_000)));
    assert!(error.starts_with("block at index 0 of the list is a list, expected an object: a block"), "{error}");
}

#[test]
fn unknown_fields_get_the_nearest_known_name() {
    for (parent, field, expected) in [
        ("", "stifness", "`stifness` is not a field of a scene: did you mean `stiffness`?"),
        ("", "kinetic_fricton", "`kinetic_fricton` is not a field of a scene: did you mean `kinetic_friction`?"),
        ("", "Gravity", "`Gravity` is not a field of a scene: did you mean `gravity`?"),
        ("", "edgeRadius", "`edgeRadius` is not a field of a scene: did you mean `edge_radius`?"),
        ("/blocks/1", "Mass", "block 9: `Mass` is not a field of a block: did you mean `mass`?"),
        (
            "/blocks/1",
            "postion",
            "block 9: `postion` is not a field of a block: write `pos`, the [x, y, z] of the centre in m",
        ),
        ("/blocks/1", "orientatoin", "block 9: `orientatoin` is not a field of a block: did you mean `orientation`?"),
        ("", "mass", "`mass` is not a field of a scene: `mass` is one of a block"),
        (
            "/blocks/1",
            "restitution",
            "block 9: `restitution` is not a field of a block: `restitution` is one of a scene",
        ),
        ("/springs", "dampening", "`springs`: `dampening` is not a field of springs: did you mean `damping`?"),
        (
            "/springs",
            "zebra",
            "`springs`: `zebra` is not a field of springs, which has `stiffness`, `damping`, `particles`",
        ),
    ] {
        let mut scene = valid_scene();
        scene["springs"] = json!({});
        scene.pointer_mut(parent).unwrap()[field] = json!(1);
        let error = error_line(&scene.to_string());
        assert!(error.starts_with(&format!("{expected} (line 1, column ")), "{error}");
    }
}

#[test]
fn fields_of_other_formats_get_the_name_to_write() {
    for (field, name) in [
        ("quat", "`orientation`, a unit quaternion [x, y, z, w] with w last"),
        ("quaternion", "`orientation`, a unit quaternion [x, y, z, w] with w last"),
        ("rotation", "`orientation`"),
        ("rot", "`orientation`"),
        ("rpy", "`orientation`"),
        ("euler", "`yaw` in radians"),
        ("position", "`pos`"),
        ("half_extents", "`size`, the full edge lengths"),
        ("halfExtents", "`size`, the full edge lengths"),
        ("halfsize", "`size`, the full edge lengths"),
        ("dims", "`size`"),
        ("dimensions", "`size`"),
        ("density", "`mass` in kg, the density times the volume"),
        ("weight", "`mass` in kg"),
        ("mu", "`friction`"),
        ("angular_velocity", "`spin`"),
        ("omega", "`spin`"),
        ("linear_velocity", "`velocity`"),
        ("static", "`fixed`: true"),
        ("kinematic", "`fixed`: true"),
    ] {
        let error = error_with_field("/blocks/0", field, json!(1));
        assert!(error.starts_with(&format!("block 7: `{field}` is not a field of a block: write ")), "{error}");
        assert!(error.contains(name), "{error}");
    }
    let error = error_with_field("", "bodies", json!([]));
    assert!(error.starts_with("`bodies` is not a field of a scene: write `blocks` (line 1"), "{error}");
}

#[test]
fn a_field_that_is_given_twice_is_refused() {
    let error = error_line(r#"{"name": "a", "friction": 1, "friction": 2}"#);
    assert!(error.starts_with("field `friction` is given twice (line 1"), "{error}");
    let error = error_with_field("/blocks/0", "orientation", json!([0, 0, 0, 1]));
    assert!(error.starts_with("block 7: `yaw` and `orientation` are both given, expected one of them"), "{error}");
}

/// Labelled towers and people add these.
#[test]
fn fields_for_people_and_other_programs_are_ignored() {
    let scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    let mut more = valid_scene();
    for (field, value) in [
        ("truth", json!({"tilt_deg": 12.5, "side_sensitive": false, "mode": "topple"})),
        ("family", json!("stack")),
        ("rows", json!(["010", "010"])),
        ("comment", json!(["a", {"b": "c"}])),
        ("label", Value::Null),
        ("margin", Value::Null),
        ("tilt_az", Value::Null),
    ] {
        more[field] = value;
    }
    more["blocks"][0]["comment"] = json!("the lower one");
    assert_eq!(Scene::from_json(&more.to_string()).unwrap(), scene);
}

#[test]
fn text_of_a_file_is_printable_in_scenes_and_messages() {
    let mut scene = valid_scene();
    scene["name"] = json!("red \u{1b}[31m\u{202e}\u{200b}\n");
    assert_eq!(Scene::from_json(&scene.to_string()).unwrap().name, "red  [31m   ");
    for (field, value) in [("\u{1b}[2J", json!(1)), ("form", json!("\u{1b}[2J")), ("label", json!("\u{9b}2J\u{2066}"))]
    {
        let error = error_with_field("", field, value);
        assert!(!error.chars().any(|c| c.is_control() || c == '\u{2066}'), "{error:?}");
    }
    let error = error_with("/blocks/0/mass", Some(json!("x".repeat(1_000_000))));
    assert!(error.len() < 200, "{}", error.len());
}

/// The parser stores no more blocks than a scene may have.
#[test]
fn a_list_of_too_many_blocks_is_counted() {
    let blocks = vec![r#"{"id":0,"size":[1,1,1],"mass":1,"pos":[0,0,1]}"#; 30_000].join(",");
    let error = error_line(&format!(r#"{{"name": "a", "friction": 1, "blocks": [{blocks}]}}"#));
    assert!(error.starts_with("`blocks` is a list of 30000, expected 1 to 20000 blocks (line 1"), "{error}");
}

/// A message lists all fields of an object, and the page on the format describes each.
#[test]
fn every_field_is_documented() {
    let page = include_str!("../../../../docs/scene-format.md");
    for parent in ["", "/blocks/0"] {
        let error = error_with_field(parent, "zzzzzzzzzzzz", json!(1));
        let names = error.split_once("which has ").unwrap().1.split_once(" (line").unwrap().0;
        for name in names.split(", ") {
            let rows =
                page.lines().filter(|line| line.starts_with('|') && line.split('|').nth(1).unwrap().contains(name));
            assert!(rows.count() > 0, "{name}");
        }
    }
}
