//! Measured forces of a real tower against those of the engine.

use serde_json::json;
use teeter_study::{BlockForces, force_map, long_axis};

use super::data_sheet::DataSheet;
use super::section::Section;
use super::size::params;
use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{correlation, mean, min, percent};

/// Share of a force by which a reading may differ from the engine.
const TOLERANCE: f64 = 0.15;
/// Breakaway force below which a block counts as loose, over friction times its weight.
const LOOSE: f64 = 1.5;

/// Reading of a block and the forces of the engine.
struct Comparison<'a> {
    pull: f64,
    block: &'a BlockForces,
    /// Direction of the block's length.
    lies: &'static str,
}

impl Comparison<'_> {
    /// Returns true if the reading agrees with either direction, within the error of the balance
    /// (N) or [`TOLERANCE`].
    fn agrees(&self, error: f64) -> bool {
        self.block.both().into_iter().any(|force| match force {
            Some(force) => (force - self.pull).abs() <= error.max(TOLERANCE * self.pull.min(force)),
            None => self.pull.is_infinite(),
        })
    }

    /// Returns true if reading and engine agree whether the block starts below `limit`, N.
    fn agrees_on_loose(&self, limit: f64) -> bool {
        let engine: Vec<f64> = self.block.both().into_iter().flatten().collect();
        (self.pull < limit) == (min(&engine) < limit)
    }

    fn row(&self) -> Vec<String> {
        let newtons = |force: Option<f64>| force.filter(|f| f.is_finite()).map_or("-".into(), |f| format!("{f:.3}"));
        vec![
            self.block.id.to_string(),
            self.lies.into(),
            newtons(Some(self.pull)),
            newtons(self.block.forward_n),
            newtons(self.block.backward_n),
            newtons(self.block.exact.map(|exact| exact.straight_n)),
        ]
    }
}

/// Compares the readings of a data sheet with the engine.
pub fn measure(sheet: &DataSheet) -> Result<Section, Error> {
    let mut section = Section::new(
        "real",
        "A real tower",
        "Heights, masses, friction and pulls come from a data sheet. The tower is built from them \
         at 3e6 N/m, and each block is pulled in both directions. A reading counts as met where it \
         is within the error of the balance, or 15 % of the force, of one of the two.",
    );
    if sheet.pulls.iter().all(Option::is_none) {
        return Err(Error::NoPulls);
    }
    let scene = &sheet.scene;
    let bar = progress(scene.blocks.len() as u64, "blocks pulled");
    let blocks = force_map(scene, params(), || bar.inc(1)).map_err(Error::RealTower)?;
    bar.finish_and_clear();
    let compared: Vec<Comparison> = blocks
        .iter()
        .zip(&sheet.pulls)
        .zip(&scene.blocks)
        .filter_map(|((block, pull), built)| {
            let lies = if long_axis(built).x.abs() > 0.5 { "along x" } else { "along y" };
            Some(Comparison { pull: (*pull)?, block, lies })
        })
        .collect();
    let weight = mean(&scene.blocks.iter().map(|b| b.mass * scene.gravity).collect::<Vec<_>>());
    let limit = LOOSE * scene.friction * weight;
    let finite = compared.iter().filter(|c| c.pull.is_finite());
    let pairs: Vec<(f64, f64)> = finite.filter_map(|c| Some((c.pull, c.block.forward_n?))).collect();
    let met = percent(&compared, |c| c.agrees(sheet.error));
    section.number("readings_met_percent", met);
    section.inform("readings met", format!("{met:.0} % of {}", compared.len()));
    section.inform("correlation of the forces", format!("{:.3}", correlation(&pairs)));
    let same = percent(&compared, |c| c.agrees_on_loose(limit));
    section.number("loose_right_percent", same);
    section.inform("loose and tight as in the real tower", format!("{same:.0} %"));
    section.table(
        &["block", "lies", "pulled N", "forward N", "backward N", "rigid, straight N"],
        compared.iter().map(Comparison::row).collect(),
    );
    let pulls: Vec<Option<f64>> = sheet.pulls.iter().map(|pull| pull.filter(|p| p.is_finite())).collect();
    section.data = json!({"blocks": blocks, "pulls": pulls});
    section.charts.push(Chart {
        title: "Breakaway force of each block".into(),
        x: Axis::log("real tower, N"),
        y: Axis::log("engine, N"),
        series: vec![Series::points("", pairs)],
        diagonal: true,
        ..Chart::default()
    });
    Ok(section)
}
