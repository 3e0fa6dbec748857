//! `teeter validate`: the report is written, its figures are there, and a data sheet of a real
//! tower is held against the engine.

use crate::common::teeter;
use serde_json::Value;

/// Runs the command into a folder of its own; what it said, and the figures.
fn report(args: &[&str]) -> (String, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    let done = teeter(&[&["validate", "--quick", "--out", out.to_str().unwrap()], args].concat());
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    (done.out, serde_json::from_str(&read("validation.json")).unwrap(), read("validation.html"))
}

#[test]
fn the_parts_asked_for_are_measured_and_met() {
    let (said, json, html) = report(&["--only", "tilt,removal,rest"]);
    let sections = json["sections"].as_array().unwrap();
    let names: Vec<&str> = sections.iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["tilt", "removal", "rest"]);
    for figure in sections.iter().flat_map(|s| s["figures"].as_array().unwrap()) {
        assert_ne!(figure["met"], false, "{figure}");
    }
    assert!(said.contains("  ok     tilt, median error: "), "{said}");
    assert!(html.starts_with("<!doctype html>") && html.contains("<svg ") && html.contains("id=\"removal\""));
    assert_eq!(sections[2]["data"]["rests"][0]["hash"].as_str().unwrap().len(), 16);
}

#[test]
fn results_for_programs_are_one_object() {
    let args = ["validate", "--quick", "--only", "put-back,tilt", "--json", "--seeds"];
    let of = |seeds: &str| -> Value {
        let done = teeter(&[&args[..], &[seeds]].concat());
        assert_eq!((done.code, done.err.as_str()), (0, ""));
        serde_json::from_str(&done.out).unwrap()
    };
    let results = of("3..5");
    let figures = results["put-back"]["figures"].as_object().unwrap();
    for name in ["tries", "over_1mm", "over_5mm", "worst_mm", "not_home"] {
        assert!(figures[name].is_number(), "{name}");
    }
    // two towers, two blocks of each, four distances
    assert_eq!((&figures["tries"], &results["put-back"]["met"]), (&Value::from(16.0), &Value::from(true)));
    assert!(results["tilt"]["figures"]["median_error_deg"].as_f64().unwrap() < 0.1);
    assert_ne!(of("5..7")["put-back"], results["put-back"], "other seeds are other towers");
}

#[test]
fn seeds_that_are_no_range_are_refused() {
    for seeds in ["3", "5..5", "7..3", "1..9999", "a..b", "1..-2"] {
        let done = teeter(&["validate", "--json", "--seeds", seeds]);
        assert_eq!((done.code, done.out.as_str(), done.err.lines().count()), (2, "", 1), "{seeds}: {}", done.err);
    }
    assert_eq!(teeter(&["validate", "--only", "tilt"]).code, 2, "neither a folder nor JSON is asked for");
}

/// Three rows of which the middle blocks bear all, with the pulls that Coulomb's law gives: a sheet
/// that the engine must meet.
#[test]
fn a_sheet_that_coulomb_filled_in_is_met() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sheet.csv");
    let mut sheet = String::from(
        "length_mm,81\nwidth_mm,26.8\nfriction,0.4\nbalance_error_N,0.005\nrow,column,height_mm,mass_g,pull_N\n",
    );
    for row in 1..=3 {
        for column in 1..=3 {
            let above = if column == 2 { 3 * (3 - row) } else { 0 };
            let height = if column == 2 { 18.0 } else { 17.8 };
            let pull = 0.4 * 0.0196 * 9.81 * f64::from(1 + above);
            sheet += &format!("{row},{column},{height},19.6,{pull:.4}\n");
        }
    }
    std::fs::write(&file, &sheet).unwrap();
    let (said, json, _) = report(&["--real", file.to_str().unwrap()]);
    assert!(
        said.contains("readings met: 100 % of 9") && said.contains("loose and tight as in the real tower: 100 %"),
        "{said}"
    );
    assert_eq!(json["sections"].as_array().unwrap().len(), 1);

    // one that is wrong is not met
    std::fs::write(&file, sheet.replace("1,2,18,19.6,0.5384", "1,2,18,19.6,1.5")).unwrap();
    let (said, ..) = report(&["--real", file.to_str().unwrap()]);
    assert!(said.contains("readings met: 89 % of 9"), "{said}");
}

#[test]
fn the_sheet_of_the_documentation_can_be_read_and_asks_for_pulls() {
    let sheet = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/data-sheet.csv");
    let folder = tempfile::tempdir().unwrap();
    let done = teeter(&["validate", "--quick", "--out", folder.path().to_str().unwrap(), "--real", sheet]);
    assert_eq!(done.error_line(), "the data sheet has no pulls to compare");
}

/// Two rows and the top of blocks whose heights leave no doubt.
#[test]
fn loose_rows_of_a_real_set_are_held_against_the_engine_and_against_heights() {
    let folder = tempfile::tempdir().unwrap();
    let [blocks, rows] = ["blocks.csv", "rows.csv"].map(|name| folder.path().join(name));
    let heights = [15.0, 14.7, 15.0, 14.7, 15.0, 14.7, 15.0, 15.0, 15.0];
    let lines = heights.iter().enumerate().map(|(id, height)| format!("{id},75,25,{height}\n"));
    std::fs::write(&blocks, "id,length_mm,width_mm,height_mm\n".to_owned() + &lines.collect::<String>()).unwrap();
    let table = |label: u32| format!("first,middle,last,label\n0,1,2,3\n3,4,5,{label}\n");
    let run = || report(&["--real", blocks.to_str().unwrap(), "--rows", rows.to_str().unwrap()]).0;
    std::fs::write(&rows, table(4)).unwrap();
    let said = run();
    for method in ["engine, rows from the bottom up", "engine, rows from the top down", "rule by heights"] {
        assert!(said.contains(&format!("{method}: 100.0 % of blocks, 100.0 % of rows")), "{said}");
    }
    // a row in which a player found nothing loose
    std::fs::write(&rows, table(0)).unwrap();
    let said = run();
    assert!(said.contains("rule by heights: 66.7 % of blocks, 50.0 % of rows"), "{said}");
    let alone = teeter(&["validate", "--out", folder.path().to_str().unwrap(), "--rows", rows.to_str().unwrap()]);
    assert!(alone.error_line().contains("--real"), "{}", alone.error_line());
}
