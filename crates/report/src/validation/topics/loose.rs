//! How many blocks are loose, against the scatter of their heights.

use serde_json::json;
use teeter_scene::TowerOptions;
use teeter_study::{RigidTower, par_map, settled, xray};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{mean, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "loose",
        "Loose blocks and the scatter of heights",
        "The X-ray of settled towers: a block is loose when nothing presses on it, below the top row. Beside it the same for rigid blocks. The ratio is that of the median tightness \
         of tight blocks to that of loose ones. MuJoCo's towers of jenga_sim_vision have 19 % loose at a scatter of 30 um and 23 % at 60 um (6 seeds, most of which fall).",
    );
    let spreads: &[f64] = if size.quick { &[0.0, 0.1] } else { &[0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3] };
    let stiffness = 3e6;
    let bar = progress(spreads.len() as u64 * size.towers, "towers");
    let (mut share, mut rigid_share) = (
        Series { name: "engine".into(), line: true, ..Series::default() },
        Series { name: "rigid blocks".into(), line: true, ..Series::default() },
    );
    let mut ratios = Series { name: "tight over loose".into(), line: true, ..Series::default() };
    let mut rows = Vec::new();
    for &sd in spreads {
        let options = TowerOptions { height_sd: 1e-3 * sd, ..size.options() };
        let scenes = size.towers(size.towers, stiffness, &options);
        let seen = par_map(&scenes, |scene| {
            let world = settled(scene, params()).map_err(built)?;
            let loads = xray(&world, scene.friction);
            let below_top = scene.blocks.len() - 3;
            let rigid = RigidTower::new(scene).ok();
            bar.inc(1);
            let exact =
                rigid.map(|r| (0..below_top).filter(|&i| r.force_above(i) < 1e-3).count() as f64 / below_top as f64);
            Ok::<_, Error>((loads[..below_top].to_vec(), exact))
        });
        let seen = seen.into_iter().collect::<Result<Vec<_>, _>>()?;
        let tower: Vec<f64> =
            seen.iter().map(|(l, _)| l.iter().filter(|l| l.is_loose()).count() as f64 / l.len() as f64).collect();
        let exact: Vec<f64> = seen.iter().filter_map(|s| s.1).collect();
        let of = |loose: bool| -> Vec<f64> {
            seen.iter().flat_map(|s| &s.0).filter(|l| l.is_loose() == loose).map(|l| l.tightness_n).collect()
        };
        let ratio = if of(true).is_empty() { f64::NAN } else { quantile(&of(false), 0.5) / quantile(&of(true), 0.5) };
        share.points.push((sd, 100.0 * mean(&tower)));
        rigid_share.points.push((sd, 100.0 * mean(&exact)));
        ratios.points.push((sd, ratio));
        rows.push(vec![
            format!("{sd:.2}"),
            format!("{:.1} %", 100.0 * mean(&tower)),
            format!("{:.1} to {:.1} %", 100.0 * quantile(&tower, 0.0), 100.0 * quantile(&tower, 1.0)),
            format!("{:.1} %", 100.0 * mean(&exact)),
            format!("{ratio:.1}"),
        ]);
    }
    bar.finish_and_clear();
    if let (Some(ours), Some(theirs)) = (share.points.last(), rigid_share.points.last()) {
        let off = (ours.1 - theirs.1).abs();
        section.goal(
            format!("share of loose blocks at {:.2} mm against rigid blocks", ours.0),
            format!("{:.1} and {:.1} %", ours.1, theirs.1),
            "within 2 %",
            off <= 2.0,
        );
    }
    section.table(&["scatter mm", "loose", "over towers", "rigid blocks", "tight over loose"], rows);
    section.data = json!({"share": share.points, "rigid": rigid_share.points, "ratio": ratios.points.iter().map(|p| (p.0, p.1.is_finite().then_some(p.1))).collect::<Vec<_>>()});
    let x = || Axis::new("standard deviation of the heights, mm");
    section.plots.push(Plot {
        title: "Share of loose blocks".into(),
        x: x(),
        y: Axis::new("loose, %"),
        series: vec![share, rigid_share],
        diagonal: false,
    });
    section.plots.push(Plot {
        title: "Tightness of tight over loose blocks".into(),
        x: x(),
        y: Axis::new("ratio of medians"),
        series: vec![ratios],
        diagonal: false,
    });
    Ok(section)
}
