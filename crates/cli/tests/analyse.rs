//! `teeter analyse`: chances with intervals, forces and what holds each block; moves of a record.

mod common;

use common::{teeter, teeter_with};
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
    // Nothing lies on the top blocks.
    for top in &blocks[4..] {
        assert_eq!(top["held_by"], Value::Array(Vec::new()));
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
fn files_that_are_neither_a_record_nor_a_scene_are_refused() {
    assert!(teeter(&["analyse", "nowhere"]).error_line().contains("nowhere"));
    assert!(teeter_with(&["analyse", "-"], b"{}").error_line().starts_with("standard input: "));
    let truncated = teeter_with(&["analyse", "-"], b"teeter-record\x01");
    assert!(truncated.error_line().contains("truncated"), "{}", truncated.err);
}
