//! Breakaway forces against rigid blocks, and their convergence with contact stiffness.

use serde_json::json;
use teeter_study::{BlockForces, Breakaway, force_map};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{correlation, mean, percent, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Breakaway force below which a block counts as loose, N.
const LOOSE: f64 = 0.1;

/// Measures the breakaway force of each block of several towers.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "forces",
        "Breakaway force of each block",
        "Each block of a settled tower is pulled along its length in both directions by a force \
         that grows slowly; the last states before it slides are tried again with the force \
         constant, so that inertia does not count. Rigid blocks give three forces from the same \
         normal forces: sliding straight; with the tower above turning; and the one at which the \
         tower rocks instead. The answer is exact where the first two agree within 1 % and the \
         tower does not rock before, and where contacts of the scene's stiffness, at rest, give \
         the same as rigid ones; elsewhere the engine is compared with the range from turning to \
         straight. A block leans with the tower, so its two directions differ by twice its weight \
         times the slope: the mean of both is compared.",
    );
    let stiffest = if size.quick { 1e6 } else { 3e6 };
    let all = force_maps(size, size.towers, stiffest)?;
    exact_figures(&mut section, &all);
    other_figures(&mut section, &all);
    let compared = vec![
        Series::points("exact", pairs(&all, straight_answer)),
        Series::points("turning", pairs(&all, turning_answer)),
    ];
    let per_tower = all.len() / size.towers as usize;
    let mut scan = Vec::new();
    for &stiffness in if size.quick { &[3e5][..] } else { &[3e5, 1e6] } {
        scan.push((stiffness, force_maps(size, size.share(4), stiffness)?));
    }
    scan.push((stiffest, all[..per_tower * size.share(4) as usize].to_vec()));
    convergence(&mut section, &scan);
    let chart = Chart {
        title: format!("Breakaway force, k = {stiffest:.0e} N/m"),
        x: Axis::log("rigid blocks, N"),
        y: Axis::log("engine, N"),
        series: compared,
        diagonal: true,
        ..Chart::default()
    };
    section.charts.insert(0, chart);
    section.data = json!({"stiffness": stiffest, "blocks": all});
    Ok(section)
}

/// Figures of the blocks for which rigid blocks have an exact answer.
fn exact_figures(section: &mut Section, all: &[BlockForces]) {
    let exact = pairs(all, straight_answer);
    let tight: Vec<(f64, f64)> = exact.iter().copied().filter(|pair| pair.0 > LOOSE).collect();
    let (errors, (found, loose), r) = (differences(&exact), count_loose(all), correlation(&exact));
    let error = mean(&errors);
    section.goal("force map where exact: correlation", format!("{r:.5}"), "0.995", r >= 0.995);
    section.goal("loose blocks found below 0.1 N", format!("{found} of {loose}"), "every one", found == loose);
    section.goal("force map where exact: mean error", format!("{error:.4} N"), "0.02 N", error <= 0.02);
    section.number("correlation", r);
    section.number("mean_error_N", error);
    section.number("loose_found", found as f64);
    section.number("loose", loose as f64);
    section.number("exact", exact.len() as f64);
    section.inform("force map where exact: 95 % within", format!("{:.4} N", quantile(&errors, 0.95)));
    let value = format!("{} of {}, {} of them tight", exact.len(), all.len(), tight.len());
    section.inform("blocks with an exact answer", value);
    section.inform(
        "tight blocks with an exact answer: correlation, mean error",
        format!("{:.5}, {:.4} N", correlation(&tight), mean(&differences(&tight))),
    );
}

/// Figures of the blocks without an exact answer.
fn other_figures(section: &mut Section, all: &[BlockForces]) {
    // Where heights differ by less than contacts give, the straight answer on springs of that
    // stiffness stands for that of rigid blocks.
    let close: Vec<String> = all
        .iter()
        .filter(|block| !block.is_generic() && loose_by_rigid(block))
        .filter_map(|block| block.on_springs_n.zip(mean_force(block)))
        .map(|(springs, engine)| format!("{springs:.3} N, {engine:.3} N"))
        .collect();
    section.inform(
        "blocks that only rigid blocks call loose, for heights differ by less than contacts give: \
         straight pull on springs at rest, and measured",
        if close.is_empty() { "none".into() } else { close.join("; ") },
    );
    let turning = pairs(all, turning_answer);
    let distance = mean(&differences(&turning));
    section.inform(
        "tight blocks whose tower turns: correlation and mean distance from the turning answer",
        format!("{:.4}, {distance:.3} N over {} blocks", correlation(&turning), turning.len()),
    );
    let rocking = percent(all, |block| block.exact.is_some_and(|exact| exact.rocks()));
    section.inform("blocks for which the tower rocks before they slide straight", format!("{rocking:.0} %"));
}

/// Table and chart of the errors by contact stiffness, N/m.
fn convergence(section: &mut Section, scan: &[(f64, Vec<BlockForces>)]) {
    let (mut exact_errors, mut turning_errors, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for (stiffness, blocks) in scan {
        let exact = mean(&differences(&pairs(blocks, straight_answer)));
        let turning = mean(&differences(&pairs(blocks, turning_answer)));
        let (found, loose) = count_loose(blocks);
        exact_errors.push((*stiffness, exact));
        turning_errors.push((*stiffness, turning));
        let cells = [format!("{stiffness:.0e}"), format!("{exact:.4}"), format!("{turning:.4}")];
        rows.push([&cells[..], &[format!("{found} of {loose}")]].concat());
    }
    section.table(&["stiffness N/m", "mean error where exact N", "from the turning answer N", "loose found"], rows);
    section.charts.push(Chart {
        title: "Error and stiffness".into(),
        x: Axis::log("stiffness, N/m"),
        y: Axis::log("mean error, N"),
        series: vec![Series::line("where exact", exact_errors), Series::line("turning", turning_errors)],
        ..Chart::default()
    });
}

/// Pairs of an answer of rigid blocks and the force of the engine, N, of the blocks that have both.
fn pairs(blocks: &[BlockForces], answer: fn(&BlockForces) -> Option<f64>) -> Vec<(f64, f64)> {
    blocks.iter().filter_map(|block| answer(block).zip(mean_force(block))).collect()
}

fn differences(pairs: &[(f64, f64)]) -> Vec<f64> {
    pairs.iter().map(|(a, b)| (a - b).abs()).collect()
}

/// Exact answer, N.
fn straight_answer(block: &BlockForces) -> Option<f64> {
    block.exact.filter(|exact| exact.is_exact() && block.is_generic()).map(|exact| exact.straight_n)
}

/// Answer with the tower above turning, N, where it differs from the straight one and the tower
/// does not rock.
fn turning_answer(block: &BlockForces) -> Option<f64> {
    let turns = |exact: &Breakaway| !exact.is_exact() && !exact.rocks();
    block.exact.filter(turns).map(|exact| exact.turning_n)
}

/// Mean of both directions, N.
fn mean_force(block: &BlockForces) -> Option<f64> {
    Some(0.5 * (block.forward_n? + block.backward_n?))
}

/// Returns true if rigid blocks call a block loose.
fn loose_by_rigid(block: &BlockForces) -> bool {
    block.exact.is_some_and(|exact| exact.straight_n < LOOSE)
}

/// Number of loose blocks that start below [`LOOSE`] in both directions, and number of loose
/// blocks.
fn count_loose(blocks: &[BlockForces]) -> (usize, usize) {
    let loose: Vec<&BlockForces> = blocks.iter().filter(|b| b.is_generic() && loose_by_rigid(b)).collect();
    let found = |block: &&&BlockForces| block.both().iter().all(|force| force.is_some_and(|force| force < LOOSE));
    (loose.iter().filter(found).count(), loose.len())
}

/// Measures the blocks of `count` towers at a contact stiffness (N/m).
fn force_maps(size: &Size, count: u64, stiffness: f64) -> Result<Vec<BlockForces>, Error> {
    let scenes = size.towers(count, stiffness, &size.tower_options());
    let bar = progress(scenes.iter().map(|scene| scene.blocks.len() as u64).sum(), "blocks pulled");
    let mut all = Vec::new();
    for scene in &scenes {
        all.extend(force_map(scene, params(), || bar.inc(1))?);
    }
    bar.finish_and_clear();
    Ok(all)
}
