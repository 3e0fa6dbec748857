//! Stability of the labelled towers of `data/oracle/config.jsonl.gz`.

use serde_json::json;
use teeter_study::{Prediction, par_map, predict};

use crate::error::Error;
use crate::output::progress;
use crate::score::{Labelled, OracleSet};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Margin from which on a label counts as clear, mm.
const CLEAR_MARGIN: f64 = 0.1;

/// Returns every `step`-th tower of a set of the program.
pub fn towers(size: &Size, set: OracleSet, step: usize) -> Result<Vec<Labelled>, Error> {
    let all = set.towers()?;
    Ok(all.into_iter().step_by(step).map(|t| Labelled { scene: size.with_form(t.scene), ..t }).collect())
}

/// Predicts towers, in their order.
pub fn predictions(towers: &[Labelled]) -> Result<Vec<Prediction>, Error> {
    let bar = progress(towers.len() as u64, "labelled towers");
    let all = par_map(towers, |tower| {
        let prediction = predict(&tower.scene, params());
        bar.inc(1);
        prediction
    });
    bar.finish_and_clear();
    Ok(all.into_iter().collect::<Result<_, _>>()?)
}

/// Compares predictions with labels.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let towers = towers(size, OracleSet::Config, if size.quick { 40 } else { 1 })?;
    let predictions = predictions(&towers)?;
    let mut section = Section::new(
        "labelled",
        "Labelled towers",
        "Limit analysis of rigid blocks says of each configuration whether it stands. Gravity \
         grows over 0.3 s. A tower fell when within 5 s any block dropped from its bearers by a \
         sixth of its height or tipped.",
    );
    let mut rows = Vec::new();
    let (mut right, mut clear, mut clear_right) = (0, 0, 0);
    for (tower, prediction) in towers.iter().zip(&predictions) {
        let Prediction::Config { fell, .. } = prediction else { continue };
        let scene = &tower.scene;
        let is_right = scene.label.as_deref() == Some(if *fell { "unstable" } else { "stable" });
        let is_clear = scene.margin.is_none_or(|margin| margin.abs() >= CLEAR_MARGIN);
        right += usize::from(is_right);
        clear += usize::from(is_clear);
        clear_right += usize::from(is_right && is_clear);
        if !is_right {
            let margin = scene.margin.map_or("unknown".into(), |margin| margin.to_string());
            rows.push(vec![scene.name.clone(), scene.label.clone().unwrap_or_default(), margin]);
        }
    }
    let count = towers.len();
    let value = format!("{clear_right} of {clear} right");
    section.goal("labelled towers with a margin of 0.1 mm or more", value, "all", clear_right == clear);
    let met = right as f64 >= 0.995 * count as f64;
    section.goal("all labelled towers", format!("{right} of {count} right"), "99.5 %", met);
    for (name, number) in [("towers", count), ("right", right), ("clear", clear), ("clear_right", clear_right)] {
        section.number(name, number as f64);
    }
    section.table(&["wrong", "label", "margin mm"], rows);
    section.data = json!({"towers": count, "right": right, "clear": clear, "clear_right": clear_right});
    Ok(section)
}
