//! The force map against rigid blocks, and how it comes nearer with stiffness.

use serde_json::json;
use teeter_scene::Scene;
use teeter_study::{BlockForces, Breakaway, force_map};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{correlation, mean, percent, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// A block that starts below this is found loose, N.
const FOUND: f64 = 0.1;

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "forces",
        "The force that starts each block",
        "Each block of a settled tower is pulled both ways along its length by a force that grows slowly; the last states before it slides are tried again \
         with the force held still, so that inertia does not count. Rigid blocks give three forces from the same normal forces: sliding straight; with what lies \
         above turning; and the one at which the tower rocks instead. The answer is exact where the first two agree within 1 % and the tower does not rock \
         before, and where contacts of the scene's stiffness, at rest, say the same as rigid ones; elsewhere the engine is held against the range from turning to straight. A block leans with the tower, so its two directions differ by twice its weight \
         times the slope: the mean of both is compared.",
    );
    let stiffest = if size.quick { 1e6 } else { 3e6 };
    let all = maps(size, size.towers, stiffest)?;
    let exact: Vec<(f64, f64)> =
        all.iter().filter_map(|b| exact_of(b).zip(middle(b)).map(|(e, f)| (e.straight_n, f))).collect();
    let errors: Vec<f64> = exact.iter().map(|(e, f)| (e - f).abs()).collect();
    let tight: Vec<(f64, f64)> = exact.iter().copied().filter(|p| p.0 > FOUND).collect();
    let (found, loose) = loose_found(&all);
    let r = correlation(&exact);
    section.goal("force map where exact: correlation", format!("{r:.5}"), "0.995", r >= 0.995);
    section.goal("loose blocks found below 0.1 N", format!("{found} of {loose}"), "every one", found == loose);
    section.goal(
        "force map where exact: mean error",
        format!("{:.4} N", mean(&errors)),
        "0.02 N",
        mean(&errors) <= 0.02,
    );
    section.say("the same, 95 % within", format!("{:.4} N", quantile(&errors, 0.95)));
    section
        .say("blocks with an exact answer", format!("{} of {}, {} of them tight", exact.len(), all.len(), tight.len()));
    section.say(
        "tight ones among them: correlation, mean error",
        format!(
            "{:.5}, {:.4} N",
            correlation(&tight),
            mean(&tight.iter().map(|(e, f)| (e - f).abs()).collect::<Vec<_>>())
        ),
    );
    // heights within what contacts give: the straight answer of springs of the same stiffness in place of that of rigid blocks
    let close: Vec<(f64, f64)> = all
        .iter()
        .filter(|b| !b.is_generic() && loose_by_rigid(b))
        .filter_map(|b| b.on_springs_n.zip(middle(b)))
        .collect();
    section.say(
        "blocks that only rigid blocks call loose, for heights differ by less than contacts give: straight pull on springs at rest, and measured",
        if close.is_empty() { "none".into() } else { close.iter().map(|(s, f)| format!("{s:.3} N, {f:.3} N")).collect::<Vec<_>>().join("; ") },
    );
    let turning: Vec<(f64, f64)> = all
        .iter()
        .filter_map(|b| b.exact.filter(|e| !e.is_exact() && !e.rocks()).zip(middle(b)).map(|(e, f)| (e.turning_n, f)))
        .collect();
    let off: Vec<f64> = turning.iter().map(|(e, f)| (e - f).abs()).collect();
    section.say(
        "tight blocks whose tower turns: correlation and mean distance from the turning answer",
        format!("{:.4}, {:.3} N over {} blocks", correlation(&turning), mean(&off), turning.len()),
    );
    let rocking = percent(&all, |b| b.exact.is_some_and(|e| e.rocks()));
    section.say("blocks for which the tower rocks before they slide straight", format!("{rocking:.0} %"));

    let mut errors_of = Series { name: "where exact".into(), line: true, ..Series::default() };
    let mut turning_of = Series { name: "turning".into(), line: true, ..Series::default() };
    let mut rows = Vec::new();
    let steps: &[f64] = if size.quick { &[3e5] } else { &[3e5, 1e6] };
    let few = size.share(4);
    let mut scan: Vec<(f64, Vec<BlockForces>)> = Vec::new();
    for &k in steps {
        scan.push((k, maps(size, few, k)?));
    }
    let per_tower = all.len() / size.towers as usize;
    scan.push((stiffest, all[..per_tower * few as usize].to_vec()));
    for (k, blocks) in &scan {
        let of = |keep: &dyn Fn(&BlockForces) -> Option<f64>| -> Vec<f64> {
            blocks.iter().filter_map(|b| Some((keep(b)? - middle(b)?).abs())).collect()
        };
        let exact = of(&|b| exact_of(b).map(|e| e.straight_n));
        let turning = of(&|b| b.exact.filter(|e| !e.is_exact() && !e.rocks()).map(|e| e.turning_n));
        let (found, loose) = loose_found(blocks);
        errors_of.points.push((*k, mean(&exact)));
        turning_of.points.push((*k, mean(&turning)));
        rows.push(vec![
            format!("{k:.0e}"),
            format!("{:.4}", mean(&exact)),
            format!("{:.4}", mean(&turning)),
            format!("{found} of {loose}"),
        ]);
    }
    section.table(&["stiffness N/m", "mean error where exact N", "from the turning answer N", "loose found"], rows);
    let points = |pairs: &[(f64, f64)], name: &str| Series { name: name.into(), points: pairs.to_vec(), line: false };
    section.plots.push(Plot {
        title: format!("Force that starts a block, k = {stiffest:.0e} N/m"),
        x: Axis::log("rigid blocks, N"),
        y: Axis::log("engine, N"),
        series: vec![points(&exact, "exact"), points(&turning, "turning")],
        diagonal: true,
    });
    section.plots.push(Plot {
        title: "Error and stiffness".into(),
        x: Axis::log("stiffness, N/m"),
        y: Axis::log("mean error, N"),
        series: vec![errors_of, turning_of],
        diagonal: false,
    });
    section.data = json!({"stiffness": stiffest, "blocks": all});
    Ok(section)
}

/// Whether rigid blocks call a block loose.
fn loose_by_rigid(block: &BlockForces) -> bool {
    block.exact.is_some_and(|e| e.straight_n < FOUND)
}

/// How many blocks that are loose beyond doubt start below [`FOUND`] both ways, and how many there are.
fn loose_found(blocks: &[BlockForces]) -> (usize, usize) {
    let loose: Vec<&BlockForces> = blocks.iter().filter(|b| b.is_generic() && loose_by_rigid(b)).collect();
    (loose.iter().filter(|b| b.both().iter().all(|f| f.is_some_and(|f| f < FOUND))).count(), loose.len())
}

/// The exact answer for a block, where there is one.
fn exact_of(block: &BlockForces) -> Option<Breakaway> {
    block.exact.filter(|e| e.is_exact() && block.is_generic())
}

/// The mean of both directions, N.
fn middle(block: &BlockForces) -> Option<f64> {
    Some(0.5 * (block.forward_n? + block.backward_n?))
}

fn maps(size: &Size, towers: u64, stiffness: f64) -> Result<Vec<BlockForces>, Error> {
    let scenes: Vec<Scene> = size.towers(towers, stiffness, &size.options());
    let bar = progress(scenes.iter().map(|s| s.blocks.len() as u64).sum(), "blocks pulled");
    let mut all = Vec::new();
    for scene in &scenes {
        all.extend(force_map(scene, params(), || bar.inc(1)).map_err(built)?);
    }
    bar.finish_and_clear();
    Ok(all)
}
