//! Errors of values: one line that names the block, the field and the expected value.

use crate::common::{error_line, error_with, error_with_field, valid_scene};
use serde_json::json;
use teeter_scene::{MAX_BLOCKS, Scene, SceneError};

/// Writes a value to one field.
type SetField = fn(&mut Scene, f64);

#[test]
fn non_finite_values_are_rejected() {
    let text = valid_scene().to_string();
    let error = error_line(&text.replacen("0.0196", "1e999", 1));
    assert!(error.starts_with("block 7: `mass` is too large a number, expected at most 1.8e308 (line 1"), "{error}");
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let base = Scene::from_json(&text).unwrap();
        let fields: [(&str, SetField); 15] = [
            ("block 7: `size`", |s, x| s.blocks[0].size[2] = x),
            ("block 7: `mass`", |s, x| s.blocks[0].mass = x),
            ("block 7: `pos`", |s, x| s.blocks[0].pos[0] = x),
            ("block 7: `yaw`", |s, x| s.blocks[0].yaw = x),
            ("block 7: `orientation`", |s, x| s.blocks[0].orientation = Some([x, 0.0, 0.0, 1.0])),
            ("block 7: `velocity`", |s, x| s.blocks[0].velocity[1] = x),
            ("block 7: `spin`", |s, x| s.blocks[0].spin[2] = x),
            ("block 7: `friction`", |s, x| s.blocks[0].friction = Some(x)),
            ("`edge_radius`", |s, x| s.edge_radius = x),
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
            format!("block 9: `size` is [0.081, {value}, 0.018] m, expected three lengths of 0.0002 to 10 m")
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
    assert_eq!(error, "blocks 7 and 9: `pos` makes them overlap by 0.500 mm, expected at most 0.02 mm");
    let mut touching = valid_scene();
    touching["blocks"][1]["pos"][2] = json!(0.026981);
    assert!(Scene::from_json(&touching.to_string()).is_ok(), "19 µm are the rounding of a file with few digits");
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
fn angles_in_degrees_are_refused() {
    for (yaw, expected) in [
        (90.0, "block 7: `yaw` is 90, which can only be degrees: write radians, 1.5708"),
        (-45.0, "block 7: `yaw` is -45, which can only be degrees: write radians, -0.7854"),
        (1e5, "block 7: `yaw` is 100000, expected an angle of at most 12.566 rad in either direction"),
    ] {
        assert_eq!(error_with("/blocks/0/yaw", Some(json!(yaw))), expected);
    }
    assert_eq!(
        error_with_field("", "tilt_az", json!(30)),
        "`tilt_az` is 30, which can only be degrees: write radians, 0.5236"
    );
    let mut scene = valid_scene();
    scene["blocks"][0]["yaw"] = json!(-2.0 * std::f64::consts::TAU);
    assert!(Scene::from_json(&scene.to_string()).is_ok(), "programs add angles up");
}

/// Block 7 with a field, and without its yaw.
fn error_of_block(field: &str, value: serde_json::Value) -> String {
    let mut scene = valid_scene();
    let block = scene["blocks"][0].as_object_mut().unwrap();
    block.remove("yaw");
    block.insert(field.to_owned(), value);
    error_line(&scene.to_string())
}

#[test]
fn orientations_must_have_unit_length() {
    assert_eq!(
        error_of_block("orientation", json!([0, 0, 1, 1])),
        "block 7: `orientation` is [0, 0, 1, 1], a quaternion of length 1.4142, expected length 1, within 0.001"
    );
    assert_eq!(
        error_of_block("orientation", json!([0, 0, 0, 0])),
        "block 7: `orientation` is [0, 0, 0, 0], a quaternion of length 0.0000, expected length 1, within 0.001"
    );
    let error = error_of_block("orientation", json!([0, 0, 0.5]));
    assert!(error.starts_with("block 7: `orientation` has 3 numbers, expected 4: a unit quaternion"), "{error}");
    let mut scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    scene.blocks[0].orientation = Some([0.0, 0.0, 0.0, 1.0009]);
    assert_eq!(scene.validate(), Ok(()), "files have few digits");
    let q = scene.blocks[0].rotation();
    assert!((q[3] - 1.0).abs() < 1e-15, "{q:?}");
    scene.blocks[0].yaw = 0.3;
    assert_eq!(
        scene.validate().unwrap_err().to_string(),
        "block 7: `yaw` is 0.3, expected 0 for a block with `orientation`"
    );
}

#[test]
fn motions_that_are_too_fast_are_refused() {
    assert_eq!(
        error_of_block("velocity", json!([0, 80, 80])),
        "block 7: `velocity` is [0, 80, 80] m/s, expected a speed of at most 100 m/s"
    );
    // A corner is 42.7 mm from the axis.
    assert_eq!(
        error_of_block("spin", json!([0, 0, 2400])),
        "block 7: `spin` is [0, 0, 2400] rad/s, expected at most 2344.2 rad/s about this axis, where a corner moves at 100 m/s"
    );
    let mut scene = valid_scene();
    scene["blocks"][0]["velocity"] = json!([100, 0, 0]);
    scene["blocks"][0]["spin"] = json!([0, 2290, 0]);
    assert!(Scene::from_json(&scene.to_string()).is_ok());
    scene["blocks"][0]["fixed"] = json!(true);
    assert_eq!(
        error_line(&scene.to_string()),
        "block 7: `velocity` is [100, 0, 0] m/s, expected zeros for a fixed block"
    );
    scene["blocks"][0]["velocity"] = json!([0, 0, 0]);
    assert_eq!(
        error_line(&scene.to_string()),
        "block 7: `spin` is [0, 2290, 0] rad/s, expected zeros for a fixed block"
    );
}

#[test]
fn a_ruler_may_spin_fast_about_its_length() {
    let mut scene = valid_scene();
    scene["blocks"][0]["size"] = json!([1.0, 0.02, 0.003]);
    scene["blocks"][0]["pos"] = json!([0, 0, 5]);
    scene["blocks"].as_array_mut().unwrap().truncate(1);
    // Its corners are 10 mm from the axis.
    scene["blocks"][0]["spin"] = json!([9000, 0, 0]);
    assert_eq!(error_line_of(&scene), None);
    scene["blocks"][0]["spin"] = json!([0, 0, 300]);
    assert!(error_line_of(&scene).unwrap().contains("at most 200.0 rad/s about this axis"));
}

fn error_line_of(scene: &serde_json::Value) -> Option<String> {
    Scene::from_json(&scene.to_string()).err().map(|error| error.to_string())
}

#[test]
fn the_friction_of_a_block_has_the_range_of_the_scenes() {
    for friction in [-0.1, 2.1] {
        let error = error_of_block("friction", json!(friction));
        assert_eq!(error, format!("block 7: `friction` is {friction}, expected 0 to 2"));
    }
}

#[test]
fn the_radius_of_edges_is_at_most_a_third_of_the_smallest_edge() {
    let mut scene = valid_scene();
    scene["blocks"][1]["size"] = json!([0.081, 0.0268, 0.009]);
    scene["blocks"][1]["pos"] = json!([0, 0, 0.0225]);
    scene["edge_radius"] = json!(0.003);
    assert_eq!(Scene::from_json(&scene.to_string()).unwrap().edge_radius, 0.003);
    scene["edge_radius"] = json!(0.0031);
    assert_eq!(
        error_line(&scene.to_string()),
        "`edge_radius` is 0.0031 m, expected 0 to 0.003000 m, a third of the smallest edge of block 9"
    );
    scene["edge_radius"] = json!(-0.001);
    assert!(error_line(&scene.to_string()).starts_with("`edge_radius` is -0.001 m, expected 0 to "));
}

#[test]
fn a_scene_of_fixed_blocks_is_valid() {
    let mut scene = Scene::from_json(&valid_scene().to_string()).unwrap();
    scene.blocks.iter_mut().for_each(|b| b.fixed = true);
    assert_eq!(scene.validate(), Ok(()));
}
