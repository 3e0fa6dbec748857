//! Tests of the binding of Jenga3D.

use glam::{DQuat, Vec3};
use serde_json::Value;

use super::*;
use crate::fit;

const ONE: &str = r#"{"name": "one", "friction": 0.4, "blocks": [
    {"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009], "yaw": 0.5}]}"#;
const TWO: &str = r#"{"name": "two", "friction": 0.4, "blocks": [
    {"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009]},
    {"id": 1, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.027]}]}"#;

/// Future work of section 6.3.
const FUTURE: &str = r#"{"static_friction": "0.4", "disabling": "rigid-motion"}"#;

fn read(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_block_starts_at_the_pose_of_the_scene() {
    let space = Space::new(ONE, "{}").unwrap();
    assert_eq!((space.length(), space.views.poses.len()), (1, 7));
    let centre = DVec3::from_slice(&space.views.poses);
    // Raised by the row spacing.
    assert!(centre.distance(DVec3::new(0.0, 0.0, 0.0091)) < 1e-12, "{centre}");
    let orientation = DQuat::from_slice(&space.views.poses[3..]);
    assert!(orientation.dot(DQuat::from_rotation_z(0.5)).abs() > 1.0 - 1e-12, "{orientation}");
    assert_eq!(space.sizes(), [0.081, 0.0268, 0.018]);
}

/// Blocks at rest carry the weight in the mean: the impulses of the contacts balance gravity.
#[test]
fn contacts_carry_the_weight() {
    let mut space = Space::new(TWO, "{}").unwrap();
    for _ in 0..60 {
        space.step("").unwrap();
    }
    let (mut lower, mut upper, frames) = (0.0, 0.0, 30);
    for _ in 0..frames {
        space.step("").unwrap();
        for contact in read(&space.contacts(0).unwrap()).as_array().unwrap() {
            let along = contact["force"].as_f64().unwrap() * contact["normal"][2].as_f64().unwrap();
            if contact["other"].is_null() { lower += along } else { upper += along }
        }
    }
    let weight = 0.0196 * 9.81;
    let (lower, upper) = (lower / f64::from(frames), upper / f64::from(frames));
    assert!((lower / (2.0 * weight) - 1.0).abs() < 0.02, "{lower}");
    assert!((upper / -weight - 1.0).abs() < 0.02, "{upper}");
}

/// A displaced particle loads its seven springs by their elongation, and no other.
#[test]
fn springs_are_in_the_order_of_their_particles() {
    let mut space = Space::new(ONE, "{}").unwrap();
    let offset = DVec3::new(0.0, 0.0, 1e-3);
    space.jenga.curr[7].position += offset;
    space.lattices_ptr();
    assert_eq!(space.lattices.len(), 52);
    assert_eq!(Vec3::from_slice(&space.lattices[21..]), space.jenga.curr[7].position.as_vec3());
    let ends = (0..8).flat_map(|a| (a + 1..8).map(move |b| (a, b)));
    for ((a, b), pull) in ends.zip(&space.lattices[24..]) {
        let apart = fit::corner(b, space.views.halves[0]) - fit::corner(a, space.views.halves[0]);
        let elongation = if b == 7 { (apart + offset).length() - apart.length() } else { 0.0 };
        let expected = space.jenga.constants.stiffness * elongation;
        assert!((f64::from(*pull) - expected).abs() < 1e-5, "{a} and {b}: {pull} N, expected {expected}");
    }
}

/// The hand writes the velocity of a block in the air, so its distance from the target decays with
/// a time constant of 1/20 s.
#[test]
fn the_hand_carries_a_block() {
    let mut space = Space::new(ONE, "{}").unwrap();
    let hand = r#"{"body": 0, "target": [0, 0, 0.1]}"#;
    for _ in 0..60 {
        space.step(hand).unwrap();
    }
    let report = read(&space.step(hand).unwrap());
    assert!(report["hand"]["force"].is_null(), "{report}");
    assert!((space.views.poses[2] - 0.1).abs() < 1e-3, "{}", space.views.poses[2]);
}

#[test]
fn invalid_input_gives_one_line() {
    for scene in ["{", "[]", r#"{"name": "none", "friction": 0.4, "blocks": []}"#] {
        let line = Space::new(scene, "{}").unwrap_err().to_string();
        assert!(!line.is_empty() && !line.contains('\n'), "{line}");
    }
    let mut space = Space::new(ONE, FUTURE).unwrap();
    let before = space.time();
    assert_eq!(
        space.step(r#"{"body": 3, "target": [0, 0, 0]}"#).unwrap_err().to_string(),
        "there is no block 3: the tower has 1"
    );
    assert!(space.step("{}").unwrap_err().to_string().starts_with("hand: "));
    assert!(space.contacts(1).is_err());
    assert_eq!(space.time(), before);
}
