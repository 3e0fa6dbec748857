//! Loose blocks taken out by the hand.

use glam::DVec3;
use serde_json::{Value, json};
use teeter_physics::{BodyId, World};
use teeter_scene::Scene;
use teeter_study::{Extraction, extract, long_axis, par_map, settled, xray};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{largest, mean, percent, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// What a block may move others by when it is taken out, mm.
const DISTURBS: f64 = 0.2;

/// Contacts of most towers and those that the reference for forces has, N/m.
const STIFFNESS: f64 = 1e6;
const REFERENCE: f64 = 3e6;

/// A settled tower, and its loose blocks with their axes.
type Loose = (World, Vec<(BodyId, DVec3)>);

/// A loose block in its tower, and its axis.
type Pull<'a> = (&'a World, BodyId, DVec3);

/// What is to be taken out of towers; few where it is to be `quick`.
fn pulls(worlds: &[Loose], quick: bool) -> Vec<Pull<'_>> {
    let all = worlds.iter().flat_map(|(w, l)| l.iter().map(move |&(i, axis)| (w, i, axis)));
    all.take(if quick { 4 } else { usize::MAX }).collect()
}

/// The loose blocks of settled towers below the top row.
fn loose_blocks(scenes: &[Scene]) -> Result<Vec<Loose>, Error> {
    let of = |scene: &Scene| {
        let world = settled(scene, params()).map_err(built)?;
        let loads = xray(&world, scene.friction);
        let loose = (0..scene.blocks.len() - 3).filter(|&i| loads[i].is_loose());
        let loose = loose.map(|i| (BodyId(i as u32), long_axis(&scene.blocks[i]).extend(0.0))).collect();
        Ok((world, loose))
    };
    par_map(scenes, of).into_iter().collect()
}

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "extraction",
        "Loose blocks taken out by the hand",
        "Every block that the X-ray calls loose is drawn out of its settled tower (k = 1e6 N/m, and at 5 cm/s 3e6 as well) by the hand of the game: it holds the end of the block, keeps it straight and \
         at its height, with at most 4 N. It is out when it follows the hand past its own length. What others move is the furthest that any other block was from its place \
         at any time until a second later, sway included: the block drags the tower along by its friction, and contacts give.",
    );
    let worlds = |stiffness| loose_blocks(&size.towers(size.towers, stiffness, &size.options()));
    let (usual, reference) = (worlds(STIFFNESS)?, worlds(REFERENCE)?);
    let (usual, reference) = (pulls(&usual, size.quick), pulls(&reference, size.quick));
    let speeds: &[f64] = if size.quick { &[0.05, 0.5] } else { &[0.02, 0.05, 0.1, 0.5] };
    let cases: Vec<(f64, f64, &[Pull])> =
        speeds.iter().map(|&speed| (STIFFNESS, speed, &usual[..])).chain([(REFERENCE, 0.05, &reference[..])]).collect();
    let bar = progress(cases.iter().map(|c| c.2.len() as u64).sum(), "extractions");
    let (mut success, mut moved) =
        (Series { line: true, ..Series::default() }, Series { name: "mean".into(), line: true, ..Series::default() });
    let mut most = Series { name: "largest".into(), line: true, ..Series::default() };
    let (mut rows, mut data) = (Vec::new(), Vec::<Value>::new());
    for (stiffness, speed, all) in cases {
        let taken: Vec<Extraction> = par_map(all, |&(world, body, axis)| {
            let taken = extract(world, body, axis, speed);
            bar.inc(1);
            taken
        });
        let others: Vec<f64> = taken.iter().map(|t| t.others_mm).collect();
        let (out, calm) = (percent(&taken, |t| t.out), percent(&taken, |t| t.others_mm <= DISTURBS));
        let cm = 100.0 * speed;
        if speed == 0.05 {
            let what = format!("loose block by the hand at 5 cm/s, k = {stiffness:.0e}");
            section.goal(format!("{what}: come out"), format!("{out:.1} % of {}", taken.len()), "99 %", out >= 99.0);
            section.goal(
                format!("{what}: others move"),
                format!("{:.3} mm at most", largest(&others)),
                "0.2 mm",
                largest(&others) <= DISTURBS,
            );
        }
        if stiffness == STIFFNESS {
            success.points.push((cm, out));
            moved.points.push((cm, mean(&others)));
            most.points.push((cm, largest(&others)));
        }
        let force: Vec<f64> = taken.iter().map(|t| t.force_n).collect();
        rows.push(vec![
            format!("{stiffness:.0e}"),
            format!("{cm:.0}"),
            format!("{out:.1} %"),
            format!("{calm:.1} %"),
            format!("{:.3}, {:.3}, {:.3}", quantile(&others, 0.5), quantile(&others, 0.95), largest(&others)),
            taken.iter().filter(|t| t.fell).count().to_string(),
            format!("{:.2}", quantile(&force, 0.5)),
        ]);
        let failed: Vec<Value> = taken
            .iter()
            .zip(all)
            .filter(|(t, _)| !t.out || t.others_mm > DISTURBS)
            .map(|(t, a)| json!({"body": a.1, "seen": t}))
            .collect();
        data.push(json!({"stiffness": stiffness, "speed": speed, "others_mm": others, "disturbing": failed}));
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
    let x = || Axis::log("speed, cm/s");
    section.plots.push(Plot {
        title: "Blocks that come out".into(),
        x: x(),
        y: Axis::new("%"),
        series: vec![success],
        diagonal: false,
    });
    section.plots.push(Plot {
        title: "What others move".into(),
        x: x(),
        y: Axis::log("mm"),
        series: vec![moved, most],
        diagonal: false,
    });
    section.data = json!(data);
    Ok(section)
}
