//! `teeter tournament`: games of opponents, their records, and the table of results.

use std::fs;

use crate::common::teeter;
use serde_json::Value;

#[test]
fn a_tournament_is_the_same_for_a_seed_and_its_records_replay() {
    let dir = tempfile::tempdir().unwrap();
    let run = |name: &str| {
        let out = dir.path().join(name).display().to_string();
        let common = ["tournament", "--games", "2", "--rows", "3", "--seed", "4", "--json", "--out", &out];
        teeter(&[&common[..], &["--players", "random,beginner", "--effort", "0.1"]].concat()).json()
    };
    let report = run("one");
    assert_eq!(report, run("two"));
    let games = report["games"].as_array().unwrap();
    assert_eq!(games.len(), 2);
    for game in games {
        let file = game["file"].as_str().unwrap();
        let [one, two] = ["one", "two"].map(|name| fs::read(dir.path().join(name).join(file)).unwrap());
        assert_eq!(one, two);
    }
    // The second game is on the same tower with changed seats.
    assert_eq!((&games[0]["first"], &games[0]["second"]), (&games[1]["second"], &games[1]["first"]));
    let file = dir.path().join("one").join(games[0]["file"].as_str().unwrap()).display().to_string();
    assert_eq!(teeter(&["replay", &file, "--verify", "--json"]).json()["same"], true);

    assert_eq!(teeter(&["replay", &file, "--json"]).json()["players"], serde_json::json!(["random", "beginner"]));

    let table = report["table"].as_array().unwrap();
    let of = |player: &str| {
        let row = table.iter().find(|row| row["player"] == player && row["against"].is_null());
        row.unwrap_or_else(|| panic!("{player} in {report}"))
    };
    let wins = |row: &Value| row["wins"].as_u64().unwrap();
    let ended = games.iter().filter(|game| !game["winner"].is_null()).count() as u64;
    assert_eq!(wins(of("random")) + wins(of("beginner")), ended);
    assert!(table.iter().all(|row| row["low"].as_f64() <= row["share"].as_f64()));
}

#[test]
fn a_tournament_needs_two_opponents_that_exist() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().display().to_string();
    let refused = |players: &str| teeter(&["tournament", "--out", &out, "--players", players]).error_line().to_owned();
    assert!(refused("expert").contains("two opponents"));
    assert!(refused("expert,master").contains("expected one of random, beginner, skilled, expert, gentle"));
}
