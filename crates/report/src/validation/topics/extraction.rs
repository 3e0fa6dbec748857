//! Loose blocks taken out by the hand.

use glam::DVec3;
use serde_json::{Value, json};
use teeter_physics::{BodyId, World};
use teeter_scene::Scene;
use teeter_study::{Extraction, extract, long_axis, par_map, settled, xray};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, mean, percent, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Maximum displacement of the other blocks, mm.
const MAX_DISPLACEMENT: f64 = 0.2;
/// Speed for which there are goals, m/s.
const GOAL_SPEED: f64 = 0.05;
/// Contact stiffness of most towers, N/m.
const STIFFNESS: f64 = 1e6;
/// Contact stiffness of the towers for comparison, N/m: that of the reference for forces.
const REFERENCE_STIFFNESS: f64 = 3e6;

/// Settled tower, and its loose blocks with their long axes.
type Tower = (World, Vec<(BodyId, DVec3)>);

/// Loose block in its tower, and its long axis.
type Block<'a> = (&'a World, BodyId, DVec3);

/// Blocks taken out at one stiffness (N/m) and one speed (m/s).
struct Case<'a> {
    stiffness: f64,
    speed: f64,
    blocks: &'a [Block<'a>],
}

/// Returns the loose blocks of all towers, four where the report is `quick`.
fn blocks(towers: &[Tower], quick: bool) -> Vec<Block<'_>> {
    let all = towers.iter().flat_map(|(world, loose)| loose.iter().map(move |&(body, axis)| (world, body, axis)));
    all.take(if quick { 4 } else { usize::MAX }).collect()
}

/// Settles towers and finds their loose blocks below the top row.
fn towers(scenes: &[Scene]) -> Result<Vec<Tower>, Error> {
    let tower = |scene: &Scene| {
        let world = settled(scene, params())?;
        let loads = xray(&world, scene.friction);
        let loose = (0..scene.blocks.len() - 3).filter(|&i| loads[i].is_loose());
        let loose = loose.map(|i| (BodyId(i as u32), long_axis(&scene.blocks[i]).extend(0.0))).collect();
        Ok((world, loose))
    };
    par_map(scenes, tower).into_iter().collect()
}

/// Takes loose blocks out at several speeds.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "extraction",
        "Loose blocks taken out by the hand",
        "Every block that the X-ray calls loose is drawn out of its settled tower (k = 1e6 N/m, \
         and at 5 cm/s 3e6 as well) by the hand of the game: it holds the end of the block, keeps \
         it straight and at its height, with at most 4 N. The block is out when it follows the \
         hand past its own length. The displacement of the others is the maximum of any other \
         block at any time until a second later, sway included: the block drags the tower along by \
         its friction, and contacts give.",
    );
    let settled = |stiffness| towers(&size.towers(size.towers, stiffness, &size.tower_options()));
    let (soft, stiff) = (settled(STIFFNESS)?, settled(REFERENCE_STIFFNESS)?);
    let (soft, stiff) = (blocks(&soft, size.quick), blocks(&stiff, size.quick));
    let speeds: &[f64] = if size.quick { &[0.05, 0.5] } else { &[0.02, 0.05, 0.1, 0.5] };
    let mut cases: Vec<Case> =
        speeds.iter().map(|&speed| Case { stiffness: STIFFNESS, speed, blocks: &soft }).collect();
    cases.push(Case { stiffness: REFERENCE_STIFFNESS, speed: GOAL_SPEED, blocks: &stiff });
    let bar = progress(cases.iter().map(|case| case.blocks.len() as u64).sum(), "extractions");
    let (mut success, mut moved, mut largest) = (Vec::new(), Vec::new(), Vec::new());
    let (mut rows, mut data) = (Vec::new(), Vec::<Value>::new());
    for case in &cases {
        let taken: Vec<Extraction> = par_map(case.blocks, |&(world, body, axis)| {
            let taken = extract(world, body, axis, case.speed);
            bar.inc(1);
            taken
        });
        if case.speed == GOAL_SPEED {
            goals(&mut section, case.stiffness, &taken);
        }
        if case.stiffness == STIFFNESS {
            let others = displacements(&taken);
            success.push((100.0 * case.speed, percent(&taken, |t| t.out)));
            moved.push((100.0 * case.speed, mean(&others)));
            largest.push((100.0 * case.speed, max(&others)));
        }
        rows.push(row(case, &taken));
        data.push(case_data(case, &taken));
    }
    bar.finish_and_clear();
    section.table(
        &[
            "N/m",
            "cm/s",
            "out",
            "others within 0.2 mm",
            "others mm: median, 95 %, largest",
            "towers that lose a block",
            "force N",
        ],
        rows,
    );
    section.charts = charts([success, moved, largest]);
    section.data = json!(data);
    Ok(section)
}

/// Displacements of the other blocks, mm.
fn displacements(taken: &[Extraction]) -> Vec<f64> {
    taken.iter().map(|t| t.others_mm).collect()
}

fn goals(section: &mut Section, stiffness: f64, taken: &[Extraction]) {
    let what = format!("loose block by the hand at 5 cm/s, k = {stiffness:.0e}");
    let (out, others) = (percent(taken, |t| t.out), max(&displacements(taken)));
    section.goal(format!("{what}: come out"), format!("{out:.1} % of {}", taken.len()), "99 %", out >= 99.0);
    for (name, number) in [("tries", taken.len() as f64), ("out_percent", out), ("others_mm", others)] {
        section.number(format!("{stiffness:.0e}.{name}"), number);
    }
    let value = format!("{others:.3} mm at most");
    section.goal(format!("{what}: others move"), value, "0.2 mm", others <= MAX_DISPLACEMENT);
}

fn row(case: &Case, taken: &[Extraction]) -> Vec<String> {
    let others = displacements(taken);
    let force: Vec<f64> = taken.iter().map(|t| t.force_n).collect();
    vec![
        format!("{:.0e}", case.stiffness),
        format!("{:.0}", 100.0 * case.speed),
        format!("{:.1} %", percent(taken, |t| t.out)),
        format!("{:.1} %", percent(taken, |t| t.others_mm <= MAX_DISPLACEMENT)),
        format!("{:.3}, {:.3}, {:.3}", quantile(&others, 0.5), quantile(&others, 0.95), max(&others)),
        taken.iter().filter(|t| t.fell).count().to_string(),
        format!("{:.2}", quantile(&force, 0.5)),
    ]
}

fn case_data(case: &Case, taken: &[Extraction]) -> Value {
    let failed: Vec<Value> = taken
        .iter()
        .zip(case.blocks)
        .filter(|(t, _)| !t.out || t.others_mm > MAX_DISPLACEMENT)
        .map(|(t, block)| json!({"body": block.1, "seen": t}))
        .collect();
    let others = displacements(taken);
    json!({"stiffness": case.stiffness, "speed": case.speed, "others_mm": others, "disturbing": failed})
}

fn charts([success, moved, largest]: [Vec<(f64, f64)>; 3]) -> Vec<Chart> {
    let x = || Axis::log("speed, cm/s");
    vec![
        Chart {
            title: "Blocks that come out".into(),
            x: x(),
            y: Axis::new("%"),
            series: vec![Series::line("", success)],
            ..Chart::default()
        },
        Chart {
            title: "Displacement of the others".into(),
            x: x(),
            y: Axis::log("mm"),
            series: vec![Series::line("mean", moved), Series::line("largest", largest)],
            ..Chart::default()
        },
    ]
}
