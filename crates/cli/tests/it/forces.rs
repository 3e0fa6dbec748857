//! `teeter forces`: every block of a scene in both directions, beside the exact answer.

use crate::common::{teeter, teeter_with};

#[test]
fn the_blocks_of_a_column_start_at_coulombs_force() {
    let report = teeter(&["forces", "column", "--json"]).json();
    let blocks = report["blocks"].as_array().unwrap();
    assert_eq!(blocks.len(), 10);
    for (i, block) in blocks.iter().enumerate() {
        assert_eq!(block["id"], i);
        let expected = 0.4 * 0.0196 * 9.81 * (10 - i) as f64;
        for force in
            [&block["forward_N"], &block["backward_N"], &block["exact"]["straight_n"], &block["exact"]["turning_n"]]
        {
            let force = force.as_f64().unwrap();
            assert!((force / expected - 1.0).abs() < 5e-3, "block {i}: {force} instead of {expected}");
        }
    }
}

/// A tower that falls has no exact answer, and what 10 N does not move has no force.
#[test]
fn unknown_forces_are_null() {
    let scene = r#"{"name": "heavy", "gravity": 9.81, "friction": 1.0, "blocks":
        [{"id": 3, "size": [0.081, 0.0268, 0.018], "mass": 2.0, "pos": [0, 0, 0.009], "yaw": 0}]}"#;
    let report = teeter_with(&["forces", "-", "--json"], scene.as_bytes()).json();
    let block = &report["blocks"][0];
    assert!(block["forward_N"].is_null() && block["backward_N"].is_null(), "{block}");
    assert!((block["exact"]["straight_n"].as_f64().unwrap() - 19.62).abs() < 1e-6);
    let report = teeter(&["forces", "test-4", "--json"]).json();
    assert!(report["blocks"][1]["exact"].is_null(), "{report}");
}

#[test]
fn the_table_is_for_people() {
    let done = teeter(&["forces", "test-5", "--stiffness", "3e6"]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    let lines: Vec<&str> = done.out.lines().collect();
    assert_eq!(lines[0], "test-5: forces in N; - is none below 10 N, or no exact answer");
    assert_eq!(lines.len(), 2 + 4);
    // a block that nothing lies on holds its own weight: 0.4 of 0.19 N
    assert!(lines[5].split_whitespace().nth(1).unwrap().starts_with("0.07"), "{}", lines[5]);
}
