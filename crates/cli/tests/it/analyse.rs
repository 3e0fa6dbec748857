//! `teeter analyse`: chances with intervals, forces and what holds each block; moves of a record.

use crate::common::{teeter, teeter_with};
use serde_json::Value;
use teeter_game::{Rules, Strength, Table, contest};
use teeter_scene::{TowerOptions, config};

fn scene(text: &str) -> Vec<u8> {
    config(text, &TowerOptions::default()).unwrap().to_json().into_bytes()
}

fn number(value: &Value, field: &str) -> f64 {
    value[field].as_f64().unwrap_or_else(|| panic!("{field} of {value}"))
}

#[test]
fn each_block_has_a_chance_within_its_interval_a_force_and_its_holders() {
    let tower = scene("(111)-(010)-(111)");
    let run = || teeter_with(&["analyse", "-", "--seed", "3", "--budget", "20", "--json"], &tower).json();
    let report = run();
    assert_eq!(report, run(), "it follows from seed and budget");
    let blocks = report["blocks"].as_array().unwrap();
    assert_eq!(blocks.len(), 7);
    for (index, block) in blocks.iter().enumerate() {
        assert_eq!(block["id"], index);
        let [chance, low, high] = ["chance_of_fall", "low", "high"].map(|field| number(block, field));
        assert!(0.0 <= low && low <= chance && chance <= high && high <= 1.0, "{block}");
        assert!(number(block, "rollouts") >= 1.0 && block["held_by"].is_array(), "{block}");
    }
    // The one block of the middle row bears the three above it.
    assert_eq!((number(&blocks[3], "chance_of_fall"), &blocks[3]["falls_by_statics"]), (1.0, &true.into()));
    assert!(!blocks[3]["held_by"].as_array().unwrap().is_empty());
    // Above it is the weight of three blocks, and below that of four: friction is 0.4 of both.
    let sticks: Vec<(&str, f64, f64)> = blocks[3]["sticks_by"]
        .as_array()
        .unwrap()
        .iter()
        .map(|contact| (contact["side"].as_str().unwrap(), number(contact, "load_N"), number(contact, "friction_N")))
        .collect();
    let load = |side| sticks.iter().filter(|contact| contact.0 == side).map(|contact| contact.1).sum::<f64>();
    assert!((load("below") / load("above") - 4.0 / 3.0).abs() < 0.05, "{sticks:?}");
    assert!(sticks.iter().all(|(_, load, friction)| (friction - 0.4 * load).abs() < 1e-9), "{sticks:?}");
    // Nothing lies on the top blocks.
    for top in &blocks[4..] {
        assert_eq!(top["held_by"], Value::Array(Vec::new()));
        assert!(top["sticks_by"].as_array().unwrap().iter().all(|contact| contact["side"] != "above"));
        let force = number(top, "force_N");
        assert!((0.05..0.11).contains(&force), "{force} N instead of 0.4 of its weight");
    }
}

#[test]
fn a_record_is_analysed_move_by_move_and_names_why_it_fell() {
    let tower = config("(010)-(101)-(010)-(111)", &TowerOptions::default()).unwrap();
    let rules = Rules::of(Table::Official, 2);
    let game = contest(&tower, rules, &[Strength::Random.thinking(); 2], 1).unwrap();
    let bytes = game.record.encode();
    let report = teeter_with(&["analyse", "-", "--budget", "0", "--json"], &bytes).json();
    let moves = report["moves"].as_array().unwrap();
    let last = moves.last().unwrap();
    assert_eq!(last["fell"], true, "{report}");
    assert_eq!(last["block"], report["fall"]["taken"]);
    assert!(number(&report["fall"], "at_s") > number(last, "at_s"));
    assert!(!report["fall"]["blocks"].as_array().unwrap().is_empty());
    let riskiest = &moves[report["riskiest"].as_u64().unwrap() as usize];
    assert!(moves.iter().all(|played| number(played, "chance_of_fall") <= number(riskiest, "chance_of_fall")));
    assert_eq!(report["blocks"].as_array().unwrap().len(), tower.blocks.len());
    let done = teeter_with(&["analyse", "-", "--budget", "0"], &bytes);
    assert!(done.out.contains("the tower fell") && done.out.contains("block  chance of fall"), "{}", done.out);
}

#[test]
fn a_record_of_another_engine_is_analysed_with_a_warning() {
    let tower = config("(010)-(101)-(010)-(111)", &TowerOptions::default()).unwrap();
    let rules = Rules::of(Table::Official, 2);
    let mut record = contest(&tower, rules, &[Strength::Random.thinking(); 2], 1).unwrap().record;
    record.engine = "0.0.1+0123456789abcdef".into();
    let report = teeter_with(&["analyse", "-", "--budget", "0", "--json"], &record.encode()).json();
    let warnings = report["warnings"].as_array().unwrap();
    let warning = warnings[0].as_str().unwrap();
    assert!(warning.starts_with("the record is of engine 0.0.1+0123456789abcdef, and this is "), "{warning}");
    assert_eq!(warnings.len(), 1, "the replay is the same");
    record.scene.friction = 0.3;
    let report = teeter_with(&["analyse", "-", "--budget", "0", "--json"], &record.encode()).json();
    assert!(report["warnings"][1].as_str().unwrap().starts_with("the replay is not the same"), "{report}");
}

#[test]
fn files_that_are_neither_a_record_nor_a_scene_are_refused() {
    assert!(teeter(&["analyse", "nowhere"]).error_line().contains("nowhere"));
    assert!(teeter_with(&["analyse", "-"], b"{}").error_line().starts_with("standard input: "));
    let truncated = teeter_with(&["analyse", "-"], b"teeter-record\x01");
    assert!(truncated.error_line().contains("truncated"), "{}", truncated.err);
}
