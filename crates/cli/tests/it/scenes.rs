//! `teeter scene`: what it prints is a scene that `teeter run` takes.

use crate::common::{teeter, teeter_with};
use serde_json::json;
use teeter_scene::{NAMED, Scene};

#[test]
fn the_default_tower() {
    let done = teeter(&["scene", "tower"]);
    let scene = Scene::from_json(&done.out).unwrap();
    assert_eq!(scene, teeter_scene::tower(&Default::default()).unwrap());
    assert_eq!((done.code, done.err.as_str(), scene.blocks.len()), (0, "", 54));
    assert_eq!(
        teeter(&["scene", "tower", "--rows", "18", "--seed", "1", "--block", "dissertation", "--height-sd", "0.1"]).out,
        done.out
    );
}

#[test]
fn options_reach_the_tower() {
    let scene = teeter(&[
        "scene",
        "tower",
        "--rows",
        "3",
        "--block",
        "official",
        "--height-sd",
        "0",
        "--mass-sd",
        "0",
        "--friction",
        "0.3",
    ])
    .json();
    assert_eq!(scene["blocks"].as_array().unwrap().len(), 9);
    assert_eq!(scene["blocks"][4]["size"], json!([0.075, 0.025, 0.015]));
    assert_eq!(scene["blocks"][4]["mass"], json!(0.0141));
    assert_eq!(scene["friction"], json!(0.3));
    assert_eq!(scene["stiffness"], json!(1e6));
    for what in [&["tower"][..], &["config", "--config", "(010)"], &["midgame"]] {
        let scene = teeter(&[&["scene"], what, &["--stiffness", "3e5"]].concat()).json();
        assert_eq!(scene["stiffness"], json!(3e5), "{what:?}");
    }
    assert_ne!(teeter(&["scene", "tower", "--seed", "2"]).out, teeter(&["scene", "tower"]).out);
}

#[test]
fn configurations() {
    let scene = teeter(&["scene", "config", "--config", "(010)-(010)-(011)"]).json();
    assert_eq!(scene["name"], "(010)-(010)-(011)");
    assert_eq!(scene["blocks"][3]["pos"], json!([0.0, 0.0271, 0.045]));
    let scene = teeter(&["scene", "config", "--loose", "(L00)-(00L)"]).json();
    assert_eq!(scene["blocks"].as_array().unwrap().len(), 6);
}

#[test]
fn the_list_and_its_scenes() {
    let plain = teeter(&["scene", "list"]);
    let json = teeter(&["scene", "list", "--json"]).json();
    assert_eq!(plain.out.lines().count(), NAMED.len());
    for (entry, row) in NAMED.iter().zip(json["scenes"].as_array().unwrap()) {
        assert!(plain.out.contains(entry.title));
        assert_eq!((row["name"].as_str(), row["title"].as_str()), (Some(entry.name), Some(entry.title)));
        let printed = teeter(&["scene", entry.name]);
        let printed = Scene::from_json(&printed.out).unwrap();
        // Commands of the same name, whose defaults are these scenes.
        if ["tower", "cards"].contains(&entry.name) {
            assert_eq!(printed.blocks, entry.scene().blocks);
            continue;
        }
        assert_eq!(printed, entry.scene());
    }
}

#[test]
fn a_printed_scene_can_be_run() {
    let printed = teeter(&["scene", "tower", "--rows", "4", "--seed", "5"]);
    let report = teeter_with(&["run", "-", "--seconds", "1", "--json"], printed.out.as_bytes()).json();
    assert_eq!(report["stands"], true);
}

/// Each storey has a frame of two cards less than the one below, and level cards between them.
#[test]
fn houses_of_cards() {
    for (storeys, count) in [("1", 2), ("2", 7), ("4", 26), ("5", 40)] {
        let scene = Scene::from_json(&teeter(&["scene", "cards", "--storeys", storeys]).out).unwrap();
        assert_eq!(scene.blocks.len(), count, "{storeys}");
    }
    let sharp = teeter(&["scene", "cards", "--edge-radius", "0", "--pitch", "94", "--friction", "0.8"]);
    let sharp = Scene::from_json(&sharp.out).unwrap();
    assert_eq!((sharp.edge_radius, sharp.friction), (0.0, 0.8));
    for (flag, value, found) in
        [("--storeys", "0", "'0'"), ("--pitch", "40", "57 to 95.1"), ("--edge-radius", "1", "1")]
    {
        let done = teeter(&["scene", "cards", flag, value]);
        assert!(done.error_line().contains(found), "{}", done.err);
    }
}

#[test]
fn edges_of_towers_can_be_round() {
    for kind in [&["tower"][..], &["config", "--config", "(010)"]] {
        let scene = teeter(&[&["scene"], kind, &["--edge-radius", "0.3"]].concat()).json();
        assert!((scene["edge_radius"].as_f64().unwrap() - 3e-4).abs() < 1e-18);
    }
    let done = teeter(&["scene", "tower", "--rows", "1", "--height-sd", "0", "--edge-radius", "7"]);
    let expected = "`edge_radius` is 0.007 m, expected 0 to 0.006000 m, a third of the smallest edge of block 0";
    assert_eq!(done.error_line(), expected);
}

#[test]
fn the_licences_of_all_parts_are_printed() {
    let done = teeter(&["--licences"]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    for part in ["standard library of Rust", "* three 0.", "* glam 0.", "* clap 4.", "Permission is hereby granted"] {
        assert!(done.out.contains(part), "{part}");
    }
    assert_eq!(teeter(&["--licenses"]).out, done.out);
}
