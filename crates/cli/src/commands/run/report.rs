//! Report on a run.

use serde::Serialize;
use teeter_scene::Scene;

use crate::fallen;
use crate::warnings::Warnings;

/// Report on a run.
#[derive(Debug, Serialize)]
pub struct Report {
    /// True when no block fell.
    pub stands: bool,
    /// Ids of the blocks that fell.
    pub fell: Vec<u32>,
    /// Maximum displacement of any block from its start, at any time.
    pub max_displacement_mm: f64,
    /// Maximum displacement of any block from its position at 2 s, at any time after; null in
    /// shorter runs.
    pub creep_mm: Option<f64>,
    /// Distance of the top below the sum of the tallest blocks, at the end.
    pub sink_mm: f64,
    /// Maximum overlap at the end of any frame.
    pub penetration_mm: f64,
    /// Root mean square over all blocks at the end, m/s.
    pub rms_speed: f64,
    /// Energies of the run.
    pub energy: EnergyReport,
    /// Processor time of the steps, s.
    pub cpu_s: f64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Hash of the state at the end.
    pub hash: String,
    /// Time since which all blocks have been asleep, s; null where one is awake at the end.
    pub asleep_at_s: Option<f64>,
    /// Warnings, which are printed besides.
    pub warnings: Warnings,
}

/// Energies of a run, J.
#[derive(Debug, Serialize)]
pub struct EnergyReport {
    /// Work of the inputs, and what changes of gravity add.
    pub put_in: f64,
    /// Energy lost by friction, impacts and damping.
    pub lost: f64,
    /// Largest energy that a frame gained although nobody put it in.
    pub worst_gain: f64,
}

impl Report {
    /// Returns the report as text: lines without the end of the last one.
    pub fn text(&self, scene: &Scene) -> String {
        let weight: f64 = scene.blocks.iter().map(|block| block.mass * scene.gravity).sum();
        let count = scene.blocks.len();
        let row = |name: &str, value: String| format!("  {name:22} {value}");
        [
            format!("{}: {}", scene.name, fallen::result(&self.fell, count)),
            row("blocks", format!("{count}, {weight:.2} N in all")),
            row("largest displacement", millimetres(self.max_displacement_mm)),
            row("creep after 2 s", self.creep_mm.map_or("not seen: the run ends before".into(), millimetres)),
            row("sink of the top", millimetres(self.sink_mm)),
            row("deepest overlap", millimetres(self.penetration_mm)),
            row("speed at the end", format!("{}/s (root mean square)", millimetres(1e3 * self.rms_speed))),
            row("asleep", self.asleep_at_s.map_or("not all blocks".into(), |time| format!("since {time:.2} s"))),
            row("time", format!("{:.2} s simulated in {:.2} s of the processor", self.simulated_s, self.cpu_s)),
            row("hash", self.hash.clone()),
        ]
        .join("\n")
    }
}

/// Returns a length (mm) with three decimals where it is visible, as a power of ten where it is
/// not.
fn millimetres(mm: f64) -> String {
    if mm == 0.0 || mm.abs() >= 0.01 { format!("{mm:.3} mm") } else { format!("{mm:.1e} mm") }
}
