//! `teeter calibrate`: chances of a fall beside what happened, as figures and as a diagram.

use crate::common::teeter;
use serde_json::Value;

fn number(value: &Value, field: &str) -> f64 {
    value[field].as_f64().unwrap_or_else(|| panic!("{field} of {value}"))
}

#[test]
fn moves_are_counted_once_scores_are_those_of_chances_and_the_diagram_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let chart = folder.path().join("chart.svg");
    let chart = chart.to_str().unwrap();
    let args = ["calibrate", "--moves", "6", "--rows", "3", "--budget", "0", "--chart", chart, "--json"];
    let report = teeter(&args).json();
    assert_eq!(report, teeter(&args).json(), "it follows from the seed");
    let bins = report["bins"].as_array().unwrap();
    assert_eq!(bins.iter().map(|bin| number(bin, "moves")).sum::<f64>(), 6.0);
    assert_eq!(number(&report, "rollouts"), 6.0, "one of each move without a budget");
    let fell: f64 = bins.iter().map(|bin| number(bin, "moves") * number(bin, "fell")).sum();
    assert!((fell / 6.0 - number(&report, "fell")).abs() < 1e-9);
    let share = number(&report, "fell");
    assert!(
        (number(&report["brier"], "constant") - share * (1.0 - share)).abs() < 1e-9,
        "that of a coin of this share"
    );
    for rule in ["rollouts", "xray", "xray_fitted", "statics"] {
        assert!((0.0..=1.0).contains(&number(&report["brier"], rule)), "{rule}");
    }
    assert!(number(&report["brier"], "xray_fitted") <= number(&report["brier"], "constant") + 1e-9);
    assert!(std::fs::read_to_string(chart).unwrap().starts_with("<svg"));
}
