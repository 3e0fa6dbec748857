//! Results as JSON and as a table.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

/// Maximum breakaway force of a loose block, N: between the friction of its own weight and that of
/// the lightest load.
const LOOSE: f64 = 0.15;

/// Results of a run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Report {
    /// Name of the processor.
    pub processor: String,
    /// Simulated time at rest, s, of which the first two are not timed.
    pub seconds: usize,
    /// Rows of the table.
    pub results: Vec<Result>,
}

/// Result of an engine with a setting.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Result {
    /// Name of the engine.
    pub engine: String,
    /// Name of the setting.
    pub setting: String,
    /// Values of the setting.
    pub details: String,
    /// True when the tower stood to the end.
    pub stands: bool,
    /// Maximum displacement of a block since two seconds, mm.
    pub creep_mm: f64,
    /// Height of the highest corner below that of the rigid tower, mm.
    pub sink_mm: f64,
    /// Median CPU time of a simulated second, ms.
    pub cpu_ms_per_s: f64,
    /// CPU time of each simulated second, ms.
    pub cpu_ms_stretches: Vec<f64>,
    /// Force at which the column slips, over Coulomb's limit.
    pub push_over_coulomb: f64,
    /// True when the settled tower had the same bits each time.
    pub reproducible: bool,
    /// Blocks pulled out of the tower.
    pub pulls: Vec<Slid>,
}

/// Block pulled along its long axis.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Slid {
    /// Index of the block.
    pub block: usize,
    /// Exact breakaway force where blocks may rotate about the vertical, with the normal forces at
    /// rest, N.
    pub turning_n: f64,
    /// Exact breakaway force without rotation, N.
    pub straight_n: f64,
    /// Measured breakaway force, N.
    pub force_n: f64,
}

impl Slid {
    /// Returns true if only the block's own weight, about 0.08 N of friction, holds it.
    fn loose(&self) -> bool {
        self.straight_n < LOOSE
    }

    /// Distance of the force from the range between the two exact answers, N.
    fn error(&self) -> f64 {
        let (low, high) = (self.turning_n.min(self.straight_n), self.straight_n);
        (low - self.force_n).max(self.force_n - high).max(0.0)
    }
}

impl Result {
    /// Correlation of the forces with one of the exact answers; `None` without forces.
    pub fn correlation(&self, exact: fn(&Slid) -> f64) -> Option<f64> {
        let n = self.pulls.len() as f64;
        let mean = |f: fn(&Slid) -> f64| self.pulls.iter().map(f).sum::<f64>() / n;
        let (x, y) = (mean(exact), mean(|p| p.force_n));
        let sum = |f: &dyn Fn(&Slid) -> f64| self.pulls.iter().map(f).sum::<f64>();
        let xy = sum(&|p| (exact(p) - x) * (p.force_n - y));
        let norm = (sum(&|p| (exact(p) - x).powi(2)) * sum(&|p| (p.force_n - y).powi(2))).sqrt();
        (self.pulls.len() > 1 && norm > 0.0).then(|| xy / norm)
    }

    /// Mean distance of the forces from the range between the two exact answers, N; `None` without
    /// forces.
    pub fn mean_error(&self) -> Option<f64> {
        self.mean_error_of(|_| true)
    }

    fn mean_error_of(&self, which: fn(&Slid) -> bool) -> Option<f64> {
        let errors: Vec<f64> = self.pulls.iter().filter(|p| which(p)).map(Slid::error).collect();
        (!errors.is_empty()).then(|| errors.iter().sum::<f64>() / errors.len() as f64)
    }

    /// Number of loose blocks measured as loose, of loose blocks, of tight blocks measured as
    /// tight, and of tight blocks.
    fn classified(&self) -> [usize; 4] {
        let count = |f: &dyn Fn(&Slid) -> bool| self.pulls.iter().filter(|p| f(p)).count();
        [
            count(&|p| p.loose() && p.force_n < LOOSE),
            count(&Slid::loose),
            count(&|p| !p.loose() && p.force_n >= LOOSE),
            count(&|p| !p.loose()),
        ]
    }

    /// Name as `engine setting`.
    pub fn name(&self) -> String {
        format!("{} {}", self.engine, self.setting)
    }
}

/// Header of the table.
const HEAD: &str = "\
| engine, setting | CPU ms per simulated s (quartiles) | mean error N | of loose blocks | loose seen | tight seen | correlation turning | straight | push / Coulomb | creep mm | sink mm | stands |
|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|";

impl Report {
    /// Formats the table and its notes as Markdown.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        let mut line = |s: &str| writeln!(text, "{s}").expect("writing to a string does not fail");
        line(HEAD);
        let number = |f: Option<f64>| f.map_or("-".into(), |f| format!("{f:.3}"));
        for r in &self.results {
            let mut sorted = r.cpu_ms_stretches.clone();
            sorted.sort_by(f64::total_cmp);
            let quartile = |share: f64| sorted[((sorted.len() - 1) as f64 * share).round() as usize];
            let [loose, all_loose, tight, all_tight] = r.classified();
            line(&format!(
                "| {} | {:.0} ({:.0} to {:.0}) | {} | {} | {loose} of {all_loose} | {tight} of {all_tight} | {} | {} | {} | {} | {} | {} |",
                r.name(),
                r.cpu_ms_per_s,
                quartile(0.25),
                quartile(0.75),
                number(r.mean_error()),
                number(r.mean_error_of(Slid::loose)),
                number(r.correlation(|p| p.turning_n)),
                number(r.correlation(|p| p.straight_n)),
                number(Some(r.push_over_coulomb).filter(|p| p.is_finite())),
                significant(r.creep_mm),
                significant(r.sink_mm),
                if r.stands { "yes" } else { "no" },
            ));
        }
        line(&format!("\n{}, one thread, {} s simulated.", self.processor, self.seconds));
        let odd: Vec<_> = self.results.iter().filter(|r| !r.reproducible).map(Result::name).collect();
        if !odd.is_empty() {
            line(&format!("The settled tower was not the same to the bit each time it was built: {}.", odd.join(", ")));
        }
        line("\nThe settings, spelled out:\n\n| engine, setting | |\n|---|---|");
        for r in &self.results {
            line(&format!("| {} | {} |", r.name(), r.details));
        }
        text
    }
}

/// Formats two significant digits, without an exponent where that is short.
fn significant(value: f64) -> String {
    match value.abs() {
        v if v < 1e-3 => format!("{value:.1e}"),
        v if v < 0.1 => format!("{value:.4}"),
        v if v < 10.0 => format!("{value:.2}"),
        _ => format!("{value:.1}"),
    }
}

/// Returns the name of the processor.
pub fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|l| l.strip_prefix("model name")).and_then(|l| l.split_once(": "));
    name.map_or("a processor without a name".into(), |(_, name)| name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(pulls: &[(f64, f64, f64)]) -> Result {
        let slid = |(block, &(turning_n, straight_n, force_n))| Slid { block, turning_n, straight_n, force_n };
        Result {
            engine: "E".into(),
            setting: "s".into(),
            details: String::new(),
            stands: true,
            creep_mm: 0.0,
            sink_mm: 0.0,
            cpu_ms_per_s: 1.0,
            cpu_ms_stretches: vec![1.0],
            push_over_coulomb: 1.0,
            reproducible: true,
            pulls: pulls.iter().enumerate().map(slid).collect(),
        }
    }

    #[test]
    fn correlation_follows_its_definition() {
        let r = result(&[(1.0, 1.0, 2.0), (2.0, 2.0, 1.0), (3.0, 3.0, 3.0)]);
        assert!((r.correlation(|p| p.straight_n).unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(result(&[]).correlation(|p| p.straight_n), None);
    }

    #[test]
    fn an_error_is_the_distance_from_the_range() {
        let r = result(&[(1.0, 2.0, 0.5), (1.0, 2.0, 1.5), (1.0, 2.0, 3.0), (0.08, 0.08, 0.09)]);
        assert!((r.mean_error().unwrap() - (0.5 + 1.0 + 0.01) / 4.0).abs() < 1e-12);
        assert!((r.mean_error_of(Slid::loose).unwrap() - 0.01).abs() < 1e-12);
        assert_eq!(r.classified(), [1, 1, 3, 3]);
    }
}
