//! Summary of a run of the simulator of 2003.

use serde::Serialize;
use teeter_dissertation::jenga3d::counters::ROUND_BINS;
use teeter_scene::Scene;

use crate::fallen;
use crate::warnings::Warnings;

/// Summary of a run.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// True when no block fell.
    pub stands: bool,
    /// Ids of the blocks that fell.
    pub fell: Vec<u32>,
    /// Rows of the scene.
    pub rows: usize,
    /// Number of blocks.
    pub blocks: usize,
    /// Maximum displacement of any block from its position in the scene, at any time from half a
    /// second after the rows have met; in shorter runs, at the end.
    pub max_displacement_mm: f64,
    /// Maximum displacement of any block from its position at 2 s, at any time after; null in
    /// shorter runs.
    pub creep_mm: Option<f64>,
    /// Distance of the top below the sum of the tallest blocks, at the end.
    pub sink_mm: f64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Frames.
    pub frames: u64,
    /// Processor time, s.
    pub cpu_s: f64,
    /// Frames in a second of the processor.
    pub frames_per_s: f64,
    /// Mean number of collisions in a frame.
    pub collisions_per_frame: f64,
    /// Mean number of rounds over the pairs in a call of CollideBlocks; the last finds nothing.
    pub mean_rounds: f64,
    /// Maximum number of rounds in a call.
    pub max_rounds: u32,
    /// Calls of CollideBlocks.
    pub calls: u64,
    /// Calls that ended at the limit of rounds with collisions left.
    pub unresolved_calls: u64,
    /// Steps with such a call.
    pub unresolved_steps: u64,
    /// Frames with such a call.
    pub unresolved_frames: u64,
    /// Calls by their number of rounds, from one; the last entry counts those of more as well.
    pub calls_by_rounds: [u64; ROUND_BINS],
    /// Disabled blocks at the end.
    pub disabled: u64,
    /// Mean number of disabled blocks at the ends of the frames.
    pub mean_disabled: f64,
    /// Hash of the state at the end.
    pub hash: String,
    /// Warnings, which are printed besides.
    pub warnings: Warnings,
}

impl Summary {
    /// Returns the summary as text: lines without the end of the last one.
    pub fn text(&self, scene: &Scene) -> String {
        let row = |name: &str, value: String| format!("  {name:22} {value}");
        let unresolved = match (self.unresolved_calls, self.unresolved_frames) {
            (0, _) => "all collisions resolved".to_owned(),
            (calls, frames) => format!("{calls} of {} calls end unresolved, in {frames} frames", self.calls),
        };
        [
            format!("{}: {}", scene.name, fallen::result(&self.fell, self.blocks)),
            row("blocks", format!("{} in {} rows", self.blocks, self.rows)),
            row("largest displacement", format!("{:.3} mm", self.max_displacement_mm)),
            row(
                "creep after 2 s",
                self.creep_mm.map_or("not seen: the run ends before".into(), |mm| format!("{mm:.3} mm")),
            ),
            row("sink of the top", format!("{:.3} mm", self.sink_mm)),
            row("rounds over the pairs", format!("{:.2} a call, at most {}", self.mean_rounds, self.max_rounds)),
            row("collisions", format!("{:.0} a frame; {unresolved}", self.collisions_per_frame)),
            row("disabled blocks", format!("{} at the end, {:.1} in the mean", self.disabled, self.mean_disabled)),
            row("time", format!("{:.2} s simulated in {:.2} s of the processor", self.simulated_s, self.cpu_s)),
            row("frame rate", format!("{:.1} frames a second", self.frames_per_s)),
            row("hash", self.hash.clone()),
        ]
        .join("\n")
    }
}
