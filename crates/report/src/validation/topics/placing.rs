//! Blocks placed and dropped on top.

use serde_json::json;
use teeter_physics::{BodyId, World};
use teeter_scene::{Block, Scene};
use teeter_study::{DroppedBlock, drop_block, par_map};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, mean, percent, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Heights at which a block is let go, m: the first is placing, the others drop it.
const HEIGHTS: [f64; 3] = [5e-5, 0.01, 0.02];
/// Height of the block above the top row while the tower settles, m.
const WAITING: f64 = 0.03;

/// Returns the scene with another block above its top row, across it, over the column `column` of
/// three.
fn with_block(scene: &Scene, column: usize) -> Scene {
    let mut scene = scene.clone();
    let last = scene.blocks.len() - 3;
    let top = scene.blocks[last..].iter().map(|b| b.pos[2] + 0.5 * b.size[2]).fold(0.0, f64::max);
    let below = scene.blocks[last - 3 + column].clone();
    let pos = [below.pos[0], below.pos[1], top + WAITING + 0.5 * below.size[2]];
    scene.blocks.push(Block { id: u32::MAX, pos, ..below });
    scene
}

/// Lets go of a block at one height (m) over each column of each tower.
fn release(scene: &Scene, column: usize, height: f64) -> Result<DroppedBlock, Error> {
    let scene = with_block(scene, column);
    let world = World::new(&scene, params())?;
    Ok(drop_block(world, BodyId(scene.blocks.len() as u32 - 1), height))
}

/// Lets go of blocks above the top row.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "placing",
        "Placing and dropping on top",
        "A hand holds a block across the full top row of a settled tower, left, middle and right, \
         and lets go: 0.05 mm above it, which is placing, and 10 and 20 mm above it. k = 1e6 N/m, \
         restitution 0.5. Rest begins when nothing has moved faster than 0.1 mm/s for a quarter of \
         a second.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.tower_options());
    let cases: Vec<(&Scene, usize)> = scenes.iter().flat_map(|s| (0..3).map(move |c| (s, c))).collect();
    let bar = progress((cases.len() * HEIGHTS.len()) as u64, "blocks let go");
    let (mut moved, mut after) = (Vec::new(), Vec::new());
    let (mut rows, mut data) = (Vec::new(), Vec::new());
    for height in HEIGHTS {
        let placed = par_map(&cases, |&(scene, column)| {
            let placed = release(scene, column, height);
            bar.inc(1);
            placed
        });
        let placed: Vec<DroppedBlock> = placed.into_iter().collect::<Result<_, _>>()?;
        let cm = 100.0 * height;
        let stay = percent(&placed, |p| p.stays);
        section.goal(
            format!("let go {cm:.1} cm above the top: stays, and nothing falls"),
            format!("{stay:.1} % of {}", placed.len()),
            "99 %",
            stay >= 99.0,
        );
        section.number(format!("{cm:.1}_cm.stay_percent"), stay);
        moved.push((cm, mean(&values(&placed, |p| p.others_mm))));
        after.push((cm, mean(&values(&placed, |p| p.others_after_mm))));
        rows.push(row(cm, &placed));
        data.push(json!({"height_m": height, "placed": placed}));
    }
    bar.finish_and_clear();
    section.table(
        &[
            "cm",
            "others move mm: median, 95 %, largest",
            "others at rest mm",
            "sideways displacement of the block mm",
            "time to rest s",
            "not at rest after 5 s",
        ],
        rows,
    );
    section.charts.push(Chart {
        title: "Displacement of the others".into(),
        x: Axis::new("height, cm"),
        y: Axis::new("mean, mm"),
        series: vec![Series::line("maximum", moved), Series::line("at rest", after)],
        ..Chart::default()
    });
    section.data = json!(data);
    Ok(section)
}

fn values(placed: &[DroppedBlock], of: fn(&DroppedBlock) -> f64) -> Vec<f64> {
    placed.iter().map(of).collect()
}

fn row(cm: f64, placed: &[DroppedBlock]) -> Vec<String> {
    let rests: Vec<f64> = placed.iter().filter_map(|p| p.rest_s).collect();
    let three = |v: &[f64]| format!("{:.3}, {:.3}, {:.3}", quantile(v, 0.5), quantile(v, 0.95), max(v));
    vec![
        format!("{cm:.1}"),
        three(&values(placed, |p| p.others_mm)),
        three(&values(placed, |p| p.others_after_mm)),
        three(&values(placed, |p| p.aside_mm)),
        three(&rests),
        (placed.len() - rests.len()).to_string(),
    ]
}
