//! Blocks placed and dropped on top.

use serde_json::json;
use teeter_physics::{BodyId, World};
use teeter_scene::{Block, Scene};
use teeter_study::{DroppedBlock, drop_block, par_map};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{largest, mean, percent, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// What is left under a block that is placed and not dropped, m.
const PLACED: f64 = 5e-5;
/// How high it is held while the tower settles, m.
const HELD: f64 = 0.03;

/// The scene with one more block above its top row, across it, at one of three places.
fn with_block(scene: &Scene, column: usize) -> Scene {
    let mut scene = scene.clone();
    let last = scene.blocks.len() - 3;
    let top = scene.blocks[last..].iter().map(|b| b.pos[2] + 0.5 * b.size[2]).fold(0.0, f64::max);
    let below = scene.blocks[last - 3 + column].clone();
    let pos = [below.pos[0], below.pos[1], top + HELD + 0.5 * below.size[2]];
    scene.blocks.push(Block { id: u32::MAX, pos, ..below });
    scene
}

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "placing",
        "Placing and dropping on top",
        "A hand holds a block across the full top row of a settled tower, left, middle and right, and lets go: 0.05 mm above it, which is placing, and 10 and 20 mm above it. k = 1e6 N/m, restitution 0.5. Rest is \
         when nothing has moved faster than 0.1 mm/s for a quarter of a second.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.options());
    let cases: Vec<(&Scene, usize)> = scenes.iter().flat_map(|s| (0..3).map(move |c| (s, c))).collect();
    let heights = [PLACED, 0.01, 0.02];
    let bar = progress((cases.len() * heights.len()) as u64, "blocks let go");
    let (mut moved, mut after) = (
        Series { name: "at any time".into(), line: true, ..Series::default() },
        Series { name: "at rest".into(), line: true, ..Series::default() },
    );
    let mut rows = Vec::new();
    let mut data = Vec::new();
    for height in heights {
        let placed = par_map(&cases, |&(scene, column)| {
            let scene = with_block(scene, column);
            let placed = World::new(&scene, params())
                .map(|w| drop_block(w, BodyId(scene.blocks.len() as u32 - 1), height))
                .map_err(built);
            bar.inc(1);
            placed
        });
        let placed: Vec<DroppedBlock> = placed.into_iter().collect::<Result<_, _>>()?;
        let of = |f: fn(&DroppedBlock) -> f64| placed.iter().map(f).collect::<Vec<f64>>();
        let rests: Vec<f64> = placed.iter().filter_map(|p| p.rest_s).collect();
        let stay = percent(&placed, |p| p.stays);
        let cm = 100.0 * height;
        section.goal(
            format!("let go {cm:.1} cm above the top: stays, and nothing falls"),
            format!("{stay:.1} % of {}", placed.len()),
            "99 %",
            stay >= 99.0,
        );
        moved.points.push((cm, mean(&of(|p| p.others_mm))));
        after.points.push((cm, mean(&of(|p| p.others_after_mm))));
        let three = |v: &[f64]| format!("{:.3}, {:.3}, {:.3}", quantile(v, 0.5), quantile(v, 0.95), largest(v));
        rows.push(vec![
            format!("{cm:.1}"),
            three(&of(|p| p.others_mm)),
            three(&of(|p| p.others_after_mm)),
            three(&of(|p| p.aside_mm)),
            three(&rests),
            (placed.len() - rests.len()).to_string(),
        ]);
        data.push(json!({"height_m": height, "placed": placed}));
    }
    bar.finish_and_clear();
    section.table(
        &[
            "cm",
            "others move mm: median, 95 %, largest",
            "others at rest mm",
            "the block comes to lie aside mm",
            "time to rest s",
            "not at rest after 5 s",
        ],
        rows,
    );
    section.plots.push(Plot {
        title: "What others move".into(),
        x: Axis::new("height, cm"),
        y: Axis::new("mean, mm"),
        series: vec![moved, after],
        diagonal: false,
    });
    section.data = json!(data);
    Ok(section)
}
