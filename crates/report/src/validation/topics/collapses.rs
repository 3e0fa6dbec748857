//! Blocks torn out in six directions, collapses, and the heaps that are left.

use glam::DVec3;
use serde_json::{Value, json};
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{Random, Scene};
use teeter_study::{Collapse, collapse, long_axis, par_map, settled};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, percent, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Time between two samples of the blocks, s.
const FRAME: f64 = 1.0 / 240.0;
/// Time simulated after a block was let go, s.
const BLOCK_TIME: f64 = 1.0;
/// Time simulated after a collapse, s.
const COLLAPSE_TIME: f64 = 4.0;
/// Duration from which on an overlap counts, s.
const MAX_OVERLAP_TIME: f64 = 0.05;
/// Maximum number of cases listed.
const MAX_LISTED: usize = 100;

/// Blocks torn out of a tower together.
struct Case {
    tower: usize,
    bodies: Vec<BodyId>,
    velocity: DVec3,
    seconds: f64,
}

/// Pulls out blocks and rows suddenly.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "yanks",
        "Sudden pulls and collapses",
        "Blocks chosen at random are torn out of settled towers (k = 1e6 N/m) by a strong arm, 100 \
         N, forwards, backwards, to both sides, up and down at 1, 2, 5 and 10 m/s; a tenth of the \
         cases tears two whole low rows away, a collapse. Overlap is computed by separating axes \
         of its own at each 1/240 s, and along the straight line between two samples in steps of \
         less than a quarter of a block: a block that goes through another, or through the floor, \
         has been inside it by 5 mm or more there.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.tower_options());
    let short = Params { frame: FRAME, ..params() };
    let worlds = par_map(&scenes, |scene| settled(scene, short)).into_iter().collect::<Result<Vec<World>, _>>()?;
    let cases = cases(size, &scenes);
    let bar = progress(cases.len() as u64, "cases");
    let outcomes: Vec<Collapse> = par_map(&cases, |case| {
        let outcome = collapse(&worlds[case.tower], &case.bodies, case.velocity, case.seconds);
        bar.inc(1);
        outcome
    });
    bar.finish_and_clear();
    overlap_figures(&mut section, &outcomes);
    let collapses: Vec<Collapse> =
        cases.iter().zip(&outcomes).filter(|(c, _)| c.bodies.len() > 1).map(|(_, y)| *y).collect();
    collapse_figures(&mut section, &collapses);
    let listed = cases.iter().zip(&outcomes).filter(|(_, y)| y.lasting_s > MAX_OVERLAP_TIME || y.lost || y.through);
    let rows = listed.take(MAX_LISTED).map(|(case, outcome)| row(&scenes[case.tower].name, case, outcome)).collect();
    section.table(&["case", "deepest", "lasts", "through", "lost"], rows);
    let points =
        cases.iter().zip(&outcomes).map(|(case, outcome)| (case.velocity.length(), outcome.deepest_mm)).collect();
    section.charts.push(Chart {
        title: "Deepest overlap".into(),
        x: Axis::new("speed, m/s"),
        y: Axis::log("mm"),
        series: vec![Series::points("", points)],
        ..Chart::default()
    });
    let data = |(case, outcome): (&Case, &Collapse)| {
        let (tower, velocity) = (&scenes[case.tower].name, case.velocity.to_array());
        json!({"tower": tower, "bodies": case.bodies, "velocity": velocity, "seen": outcome})
    };
    section.data = json!(cases.iter().zip(&outcomes).map(data).collect::<Vec<Value>>());
    Ok(section)
}

fn overlap_figures(section: &mut Section, outcomes: &[Collapse]) {
    section.number("cases", outcomes.len() as f64);
    let mut none = |what: &str, name: &str, is_bad: fn(&Collapse) -> bool| {
        let count = outcomes.iter().filter(|outcome| is_bad(outcome)).count();
        let value = format!("{count} of {}", outcomes.len());
        section.goal(format!("sudden pulls and collapses: {what}"), value, "none", count == 0);
        section.number(name, count as f64);
    };
    none("overlap of more than 1 mm for more than 50 ms", "overlaps", |outcome| outcome.lasting_s > MAX_OVERLAP_TIME);
    none("not finite or run away", "lost", |outcome| outcome.lost);
    none("a block through another or the floor", "through", |outcome| outcome.through);
    let deepest: Vec<f64> = outcomes.iter().map(|outcome| outcome.deepest_mm).collect();
    let lasting: Vec<f64> = outcomes.iter().map(|outcome| outcome.lasting_s).collect();
    section.inform(
        "deepest overlap of any sample: median, 95 %, largest",
        format!("{:.3}, {:.3}, {:.3} mm", quantile(&deepest, 0.5), quantile(&deepest, 0.95), max(&deepest)),
    );
    section.number("deepest_mm", max(&deepest));
    section.inform("longest overlap of more than 1 mm", format!("{:.3} s", max(&lasting)));
}

fn collapse_figures(section: &mut Section, collapses: &[Collapse]) {
    let quiet = percent(collapses, |collapse| collapse.quiet_s.is_some());
    let times: Vec<f64> = collapses.iter().filter_map(|collapse| collapse.quiet_s).collect();
    section.goal(
        format!("piles quiet {COLLAPSE_TIME:.0} s after a collapse"),
        format!("{quiet:.0} % of {}", collapses.len()),
        "all",
        quiet == 100.0,
    );
    section.number("quiet_percent", quiet);
    section.inform("quiet after: median, largest", format!("{:.2}, {:.2} s", quantile(&times, 0.5), max(&times)));
}

fn row(tower: &str, case: &Case, collapse: &Collapse) -> Vec<String> {
    let v = case.velocity;
    let bodies: Vec<String> = case.bodies.iter().map(BodyId::to_string).collect();
    vec![
        format!("{tower} blocks {} at ({}, {}, {}) m/s", bodies.join(", "), v.x, v.y, v.z),
        format!("{:.2} mm", collapse.deepest_mm),
        format!("{:.3} s", collapse.lasting_s),
        collapse.through.to_string(),
        collapse.lost.to_string(),
    ]
}

/// Draws the cases at random. Every tenth is a collapse.
fn cases(size: &Size, scenes: &[Scene]) -> Vec<Case> {
    let mut random = Random::new(size.seed);
    let mut below = |n: usize| (random.uniform() * n as f64) as usize;
    let mut case = |i: usize| {
        let tower = i % scenes.len();
        let blocks = &scenes[tower].blocks;
        let speed = [1.0, 2.0, 5.0, 10.0_f64][below(4)];
        if i % 10 == 9 {
            let row = below(2);
            let along = if below(2) == 0 { DVec3::X } else { DVec3::Y };
            let bodies = (3 * row as u32..3 * row as u32 + 6).map(BodyId).collect();
            return Case { tower, bodies, velocity: along * speed.min(5.0), seconds: COLLAPSE_TIME };
        }
        let body = below(blocks.len());
        let along = long_axis(&blocks[body]).extend(0.0);
        let across = DVec3::new(-along.y, along.x, 0.0);
        let direction = [along, -along, across, -across, DVec3::Z, DVec3::NEG_Z][below(6)];
        Case { tower, bodies: vec![BodyId(body as u32)], velocity: direction * speed, seconds: BLOCK_TIME }
    };
    (0..size.collapses).map(&mut case).collect()
}
