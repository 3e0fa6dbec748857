//! The towers of `data/oracle`, which are in the program.

use std::io::Read;

use flate2::bufread::MultiGzDecoder;
use serde_json::json;

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::quantile;
use crate::error::Error;
use crate::progress;
use crate::score::{self, Labelled};
use teeter_study::{Prediction, par_map, predict};

const CONFIG: &[u8] = include_bytes!("../../../../../data/oracle/config.jsonl.gz");
const TILT: &[u8] = include_bytes!("../../../../../data/oracle/tilt.jsonl.gz");

/// The towers of a packed file, every `step`-th of them.
fn towers(size: &Size, packed: &[u8], step: usize) -> Result<Vec<Labelled>, Error> {
    let mut text = String::new();
    MultiGzDecoder::new(packed).read_to_string(&mut text).map_err(super::built)?;
    let formed = |t: Labelled| Labelled { scene: size.formed(t.scene), ..t };
    text.lines().step_by(step).map(|line| score::parse(line).map(formed).map_err(super::built)).collect()
}

fn predictions(towers: &[Labelled]) -> Result<Vec<Prediction>, Error> {
    let bar = progress(towers.len() as u64, "labelled towers");
    let all = par_map(towers, |t| {
        let prediction = predict(&t.scene, params());
        bar.inc(1);
        prediction
    });
    bar.finish_and_clear();
    all.into_iter().collect::<Result<_, _>>().map_err(super::built)
}

/// Which stand.
pub fn standing(size: &Size) -> Result<Section, Error> {
    let towers = towers(size, CONFIG, if size.quick { 40 } else { 1 })?;
    let predictions = predictions(&towers)?;
    let mut section = Section::new(
        "labelled",
        "Labelled towers",
        "Configurations of which limit analysis of rigid blocks says whether they stand. Gravity grows over 0.3 s; a tower fell when within 5 s \
         any block moved by more than 5 mm or came down by more than 3 mm.",
    );
    let mut rows = Vec::new();
    let (mut right, mut clear, mut clear_right) = (0, 0, 0);
    for (t, p) in towers.iter().zip(&predictions) {
        let Prediction::Config { fell, .. } = p else { continue };
        let good = t.scene.label.as_deref() == Some(if *fell { "unstable" } else { "stable" });
        let is_clear = t.scene.margin.is_none_or(|m| m.abs() >= 0.1);
        right += usize::from(good);
        clear += usize::from(is_clear);
        clear_right += usize::from(good && is_clear);
        if !good {
            rows.push(vec![
                t.scene.name.clone(),
                t.scene.label.clone().unwrap_or_default(),
                format!("{:?}", t.scene.margin),
            ]);
        }
    }
    section.goal(
        "labelled towers with a margin of 0.1 mm or more",
        format!("{clear_right} of {clear} right"),
        "all",
        clear_right == clear,
    );
    let n = towers.len();
    section.goal("all labelled towers", format!("{right} of {n} right"), "99.5 %", right as f64 >= 0.995 * n as f64);
    section.table(&["wrong", "label", "margin mm"], rows);
    section.data = json!({"towers": n, "right": right, "clear": clear, "clear_right": clear_right});
    Ok(section)
}

/// At what tilt they collapse.
pub fn tilt(size: &Size) -> Result<Section, Error> {
    let towers = towers(size, TILT, if size.quick { 10 } else { 1 })?;
    let predictions = predictions(&towers)?;
    let mut section = Section::new(
        "tilt",
        "Tilt",
        "The angle of the floor at which a tower collapses, by bisection with gravity held still, against limit analysis. Towers whose answer depends \
         on contact between the sides of neighbours are left out of the figures and drawn apart.",
    );
    let (mut plain, mut sides, mut errors) =
        (Series { name: "towers".into(), ..Series::default() }, Series::default(), Vec::new());
    sides.name = "depends on sides".into();
    for (t, p) in towers.iter().zip(&predictions) {
        let (Prediction::Tilt { tilt_deg, .. }, Some(truth)) = (p, t.truth.tilt_deg) else { continue };
        // a tower that never falls is off by all that was tried
        let said = tilt_deg.unwrap_or(60.0);
        if t.truth.side_sensitive {
            sides.points.push((truth, said));
        } else {
            plain.points.push((truth, said));
            errors.push((said - truth).abs());
        }
    }
    let (median, most) = (quantile(&errors, 0.5), quantile(&errors, 0.95));
    section.goal("tilt, median error", format!("{median:.3} degrees"), "0.1 degrees", median <= 0.1);
    section.goal("tilt, 95 % within", format!("{most:.3} degrees"), "0.3 degrees", most <= 0.3);
    section.say("towers", format!("{} and {} that depend on sides", plain.points.len(), sides.points.len()));
    section.data = json!({"plain": plain.points, "sides": sides.points});
    section.plots.push(Plot {
        title: "Angle of collapse".into(),
        x: Axis::new("limit analysis, degrees"),
        y: Axis::new("engine, degrees"),
        series: vec![plain, sides],
        diagonal: true,
    });
    Ok(section)
}
