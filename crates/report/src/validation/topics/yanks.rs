//! Blocks torn out in six directions, collapses, and the heaps that are left.

use glam::DVec3;
use serde_json::{Value, json};
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{Random, Scene};
use teeter_study::{Collapse, collapse, long_axis, par_map, settled};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{largest, percent, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// A look at the blocks every so often, s.
const LOOK: f64 = 1.0 / 240.0;
/// How long a yank is watched after letting go, s, and a collapse.
const WATCHED: (f64, f64) = (1.0, 4.0);
/// An overlap that is there for longer than this lasts, s.
const LASTS: f64 = 0.05;

/// What is torn, and how.
struct Case {
    tower: usize,
    bodies: Vec<BodyId>,
    velocity: DVec3,
    watched: f64,
}

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "yanks",
        "Yanks and collapses",
        "Blocks chosen at random are torn out of settled towers (k = 1e6 N/m) by a strong arm, 100 N, forwards, backwards, to both sides, up and down at 1, 2, 5 and 10 m/s; a tenth of the \
         cases tears two whole low rows away, a collapse. Overlap is judged by separating axes of its own at each 1/240 s, and on the straight way between two looks in steps of less than \
         a quarter of a block: a block that goes through another, or through the floor, has been inside it by 5 mm or more there.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.options());
    let short = Params { frame: LOOK, ..params() };
    let worlds =
        par_map(&scenes, |s| settled(s, short).map_err(built)).into_iter().collect::<Result<Vec<World>, _>>()?;
    let cases = cases(size, &scenes);
    let bar = progress(cases.len() as u64, "yanks");
    let seen: Vec<Collapse> = par_map(&cases, |case| {
        let seen = collapse(&worlds[case.tower], &case.bodies, case.velocity, case.watched);
        bar.inc(1);
        seen
    });
    bar.finish_and_clear();
    let n = seen.len();
    let count = |so: &dyn Fn(&Collapse) -> bool| seen.iter().filter(|y| so(y)).count();
    let (lasting, lost, through) = (count(&|y| y.lasting_s > LASTS), count(&|y| y.lost), count(&|y| y.through));
    section.goal(
        "yanks and collapses: overlap of more than 1 mm for more than 50 ms",
        format!("{lasting} of {n}"),
        "none",
        lasting == 0,
    );
    section.goal("yanks and collapses: not finite or run away", format!("{lost} of {n}"), "none", lost == 0);
    section.goal(
        "yanks and collapses: a block through another or the floor",
        format!("{through} of {n}"),
        "none",
        through == 0,
    );
    let deepest: Vec<f64> = seen.iter().map(|y| y.deepest_mm).collect();
    section.say(
        "deepest overlap at any look: median, 95 %, largest",
        format!("{:.3}, {:.3}, {:.3} mm", quantile(&deepest, 0.5), quantile(&deepest, 0.95), largest(&deepest)),
    );
    section.say(
        "longest overlap of more than 1 mm",
        format!("{:.3} s", largest(&seen.iter().map(|y| y.lasting_s).collect::<Vec<_>>())),
    );
    let piles: Vec<Collapse> = seen.iter().zip(&cases).filter(|(_, c)| c.bodies.len() > 1).map(|(y, _)| *y).collect();
    let quiet = percent(&piles, |y| y.quiet_s.is_some());
    let times: Vec<f64> = piles.iter().filter_map(|y| y.quiet_s).collect();
    section.goal(
        format!("piles quiet {:.0} s after a collapse", WATCHED.1),
        format!("{quiet:.0} % of {}", piles.len()),
        "all",
        quiet == 100.0,
    );
    section.say("quiet after: median, largest", format!("{:.2}, {:.2} s", quantile(&times, 0.5), largest(&times)));
    let rows = seen.iter().zip(&cases).filter(|(y, _)| y.lasting_s > LASTS || y.lost || y.through);
    let rows = rows.map(|(y, c)| {
        let v = c.velocity;
        let at = format!("{} blocks {:?} at ({}, {}, {}) m/s", scenes[c.tower].name, c.bodies, v.x, v.y, v.z);
        vec![
            at,
            format!("{:.2} mm", y.deepest_mm),
            format!("{:.3} s", y.lasting_s),
            y.through.to_string(),
            y.lost.to_string(),
        ]
    });
    section.table(&["case", "deepest", "lasts", "through", "lost"], rows.take(100).collect());
    let points = cases.iter().zip(&seen).map(|(c, y)| (c.velocity.length(), y.deepest_mm)).collect();
    section.plots.push(Plot {
        title: "Deepest overlap".into(),
        x: Axis::new("speed, m/s"),
        y: Axis::log("mm"),
        series: vec![Series { name: String::new(), points, line: false }],
        diagonal: false,
    });
    let all: Vec<Value> = cases
        .iter()
        .zip(&seen)
        .map(|(c, y)| json!({"tower": scenes[c.tower].name, "bodies": c.bodies, "velocity": c.velocity.to_array(), "seen": y}))
        .collect();
    section.data = json!(all);
    Ok(section)
}

fn cases(size: &Size, scenes: &[Scene]) -> Vec<Case> {
    let mut random = Random::new(size.seed);
    let mut of = |n: usize| (random.uniform() * n as f64) as usize;
    let mut case = |i: usize| {
        let tower = i % scenes.len();
        let blocks = &scenes[tower].blocks;
        let speed = [1.0, 2.0, 5.0, 10.0_f64][of(4)];
        if i % 10 == 9 {
            let row = of(2);
            let along = if of(2) == 0 { DVec3::X } else { DVec3::Y };
            let bodies = (3 * row as u32..3 * row as u32 + 6).map(BodyId).collect();
            return Case { tower, bodies, velocity: along * speed.min(5.0), watched: WATCHED.1 };
        }
        let body = of(blocks.len());
        let along = long_axis(&blocks[body]).extend(0.0);
        let across = DVec3::new(-along.y, along.x, 0.0);
        let direction = [along, -along, across, -across, DVec3::Z, DVec3::NEG_Z][of(6)];
        Case { tower, bodies: vec![BodyId(body as u32)], velocity: direction * speed, watched: WATCHED.0 }
    };
    (0..size.yanks).map(&mut case).collect()
}
