//! Share of loose blocks by the scatter of heights.

use serde_json::json;
use teeter_scene::{Scene, TowerOptions};
use teeter_study::{Load, RigidTower, par_map, settled, xray};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{mean, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Contact stiffness, N/m.
const STIFFNESS: f64 = 3e6;
/// Force on the upper face below which a rigid block is loose, N.
const NO_LOAD: f64 = 1e-3;

/// Loads of a tower below its top row, and the share of loose blocks there if blocks are rigid.
struct Tower {
    loads: Vec<Load>,
    rigid_share: Option<f64>,
}

impl Tower {
    fn measure(scene: &Scene) -> Result<Self, Error> {
        let world = settled(scene, params())?;
        let below_top = scene.blocks.len() - 3;
        let loads = xray(&world, scene.friction)[..below_top].to_vec();
        let rigid_share = RigidTower::new(scene).ok().map(|rigid| {
            let loose = (0..below_top).filter(|&i| rigid.force_above(i) < NO_LOAD).count();
            loose as f64 / below_top as f64
        });
        Ok(Self { loads, rigid_share })
    }

    fn share(&self) -> f64 {
        self.loads.iter().filter(|load| load.is_loose()).count() as f64 / self.loads.len() as f64
    }
}

/// Median tightness of tight blocks over that of loose ones; not a number where no block is loose.
fn tightness_ratio(towers: &[Tower]) -> f64 {
    let median = |loose: bool| -> Option<f64> {
        let loads = towers.iter().flat_map(|tower| &tower.loads).filter(|load| load.is_loose() == loose);
        let tightness: Vec<f64> = loads.map(|load| load.tightness_n).collect();
        (!tightness.is_empty()).then(|| quantile(&tightness, 0.5))
    };
    median(true).map_or(f64::NAN, |loose| median(false).unwrap_or(0.0) / loose)
}

/// Counts loose blocks at several standard deviations of the heights.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "loose",
        "Loose blocks and the scatter of heights",
        "The X-ray of settled towers: a block below the top row is loose when nothing presses on \
         it. Rigid blocks give the same share by exact mechanics. The ratio is that of the median \
         tightness of tight blocks to that of loose ones. MuJoCo's towers of jenga_sim_vision have \
         19 % loose at a scatter of 30 um and 23 % at 60 um (6 seeds, most of which fall).",
    );
    let deviations: &[f64] = if size.quick { &[0.0, 0.1] } else { &[0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3] };
    let bar = progress(deviations.len() as u64 * size.towers, "towers");
    let (mut shares, mut rigid, mut ratios, mut rows) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for &deviation in deviations {
        let options = TowerOptions { height_sd: 1e-3 * deviation, ..size.tower_options() };
        let towers = par_map(&size.towers(size.towers, STIFFNESS, &options), |scene| {
            let tower = Tower::measure(scene);
            bar.inc(1);
            tower
        });
        let towers = towers.into_iter().collect::<Result<Vec<_>, _>>()?;
        let share: Vec<f64> = towers.iter().map(Tower::share).collect();
        let exact: Vec<f64> = towers.iter().filter_map(|tower| tower.rigid_share).collect();
        let ratio = tightness_ratio(&towers);
        shares.push((deviation, 100.0 * mean(&share)));
        rigid.push((deviation, 100.0 * mean(&exact)));
        ratios.push((deviation, ratio));
        rows.push(vec![
            format!("{deviation:.2}"),
            format!("{:.1} %", 100.0 * mean(&share)),
            format!("{:.1} to {:.1} %", 100.0 * quantile(&share, 0.0), 100.0 * quantile(&share, 1.0)),
            format!("{:.1} %", 100.0 * mean(&exact)),
            format!("{ratio:.1}"),
        ]);
    }
    bar.finish_and_clear();
    if let (Some(engine), Some(exact)) = (shares.last(), rigid.last()) {
        let what = format!("share of loose blocks at {:.2} mm against rigid blocks", engine.0);
        let met = (engine.1 - exact.1).abs() <= 2.0;
        section.goal(what, format!("{:.1} and {:.1} %", engine.1, exact.1), "within 2 %", met);
        section.number("loose_percent", engine.1);
        section.number("rigid_loose_percent", exact.1);
    }
    section.table(&["scatter mm", "loose", "over towers", "rigid blocks", "tight over loose"], rows);
    let finite: Vec<(f64, Option<f64>)> = ratios.iter().map(|p| (p.0, p.1.is_finite().then_some(p.1))).collect();
    section.data = json!({"share": shares, "rigid": rigid, "ratio": finite});
    section.charts = charts([shares, rigid, ratios]);
    Ok(section)
}

fn charts([shares, rigid, ratios]: [Vec<(f64, f64)>; 3]) -> Vec<Chart> {
    let x = || Axis::new("standard deviation of the heights, mm");
    vec![
        Chart {
            title: "Share of loose blocks".into(),
            x: x(),
            y: Axis::new("loose, %"),
            series: vec![Series::line("engine", shares), Series::line("rigid blocks", rigid)],
            ..Chart::default()
        },
        Chart {
            title: "Tightness of tight over loose blocks".into(),
            x: x(),
            y: Axis::new("ratio of medians"),
            series: vec![Series::line("", ratios)],
            ..Chart::default()
        },
    ]
}
