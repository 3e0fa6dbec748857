//! How predictions compare with labels.

use std::fmt;

use serde::Serialize;

use super::labelled::Labelled;
use teeter_study::Prediction;

/// Above this margin a label is beyond doubt, mm; below it a hair's breadth decides.
const CLEAR: f64 = 0.1;
/// By how much an angle may be off before it is counted, degrees.
const FAR: f64 = 0.2;

/// How predictions compare with labels.
#[derive(Debug, Default, Serialize)]
pub struct Summary {
    /// Number of scenes.
    scenes: usize,
    /// Scenes with a label for standing and falling.
    #[serde(skip_serializing_if = "Option::is_none")]
    config: Option<Config>,
    /// Scenes with an angle of collapse, without those that depend on the sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<Tilt>,
    /// Scenes with an angle of collapse that depends on contact between the sides of neighbours.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt_side_sensitive: Option<Tilt>,
}

/// Standing and falling.
#[derive(Debug, Default, Serialize)]
struct Config {
    labelled: usize,
    right: usize,
    /// Wrong with a margin of 0.1 mm or more.
    wrong_clear: usize,
    /// Wrong with less.
    wrong_borderline: usize,
    /// Said to stand, and falls.
    false_stable: usize,
    /// Said to fall, and stands.
    false_unstable: usize,
    /// The wrong ones, the clearest first.
    wrong: Vec<Wrong>,
}

#[derive(Debug, Serialize)]
struct Wrong {
    name: String,
    label: String,
    margin_mm: Option<f64>,
}

/// Angles of collapse.
#[derive(Debug, Default, Serialize)]
struct Tilt {
    labelled: usize,
    /// Never fell.
    never_fell: usize,
    median_abs_deg: Option<f64>,
    p95_abs_deg: Option<f64>,
    max_abs_deg: Option<f64>,
    mean_signed_deg: Option<f64>,
    /// More than 0.2 degrees above the bound.
    over: usize,
    /// More than 0.2 degrees below it.
    under: usize,
    /// The ten furthest off.
    worst: Vec<Off>,
}

#[derive(Debug, Serialize)]
struct Off {
    name: String,
    truth_deg: f64,
    error_deg: f64,
}

impl Summary {
    /// Compares the predictions with the labels of the same scenes, in the same order.
    pub fn of(scenes: &[Labelled], predictions: &[Prediction]) -> Self {
        let mut config = Config::default();
        let mut plain = Errors::default();
        let mut sides = Errors::default();
        for (s, p) in scenes.iter().zip(predictions) {
            match p {
                Prediction::Config { fell, .. } => config.count(s, *fell),
                Prediction::Tilt { tilt_deg, .. } => {
                    if let Some(truth) = s.truth.tilt_deg {
                        let errors = if s.truth.side_sensitive { &mut sides } else { &mut plain };
                        errors.count(&s.scene.name, truth, *tilt_deg);
                    }
                }
            }
        }
        config.wrong.sort_by(|a, b| b.clearness().total_cmp(&a.clearness()));
        Self {
            scenes: scenes.len(),
            config: (config.labelled > 0).then_some(config),
            tilt: plain.summary(),
            tilt_side_sensitive: sides.summary(),
        }
    }
}

impl Config {
    fn count(&mut self, s: &Labelled, fell: bool) {
        let Some(label) = &s.scene.label else { return };
        self.labelled += 1;
        if fell == (label == "unstable") {
            self.right += 1;
            return;
        }
        let wrong = Wrong { name: s.scene.name.clone(), label: label.clone(), margin_mm: s.scene.margin };
        if wrong.clearness() >= CLEAR {
            self.wrong_clear += 1
        } else {
            self.wrong_borderline += 1
        }
        if fell {
            self.false_unstable += 1
        } else {
            self.false_stable += 1
        }
        self.wrong.push(wrong);
    }
}

impl Wrong {
    /// Distance from the edge between standing and falling, mm; a label without one counts as clear.
    fn clearness(&self) -> f64 {
        self.margin_mm.map_or(f64::INFINITY, f64::abs)
    }
}

#[derive(Default)]
struct Errors {
    never_fell: usize,
    all: Vec<Off>,
}

impl Errors {
    fn count(&mut self, name: &str, truth_deg: f64, tilt_deg: Option<f64>) {
        match tilt_deg {
            Some(deg) => self.all.push(Off { name: name.to_owned(), truth_deg, error_deg: deg - truth_deg }),
            None => self.never_fell += 1,
        }
    }

    fn summary(mut self) -> Option<Tilt> {
        let labelled = self.all.len() + self.never_fell;
        if labelled == 0 {
            return None;
        }
        let over = self.all.iter().filter(|e| e.error_deg > FAR).count();
        let under = self.all.iter().filter(|e| e.error_deg < -FAR).count();
        let n = self.all.len();
        let mean_signed_deg = (n > 0).then(|| self.all.iter().map(|e| e.error_deg).sum::<f64>() / n as f64);
        self.all.sort_by(|a, b| b.error_deg.abs().total_cmp(&a.error_deg.abs()));
        let mut sizes: Vec<f64> = self.all.iter().map(|e| e.error_deg.abs()).collect();
        sizes.reverse();
        self.all.truncate(10);
        Some(Tilt {
            labelled,
            never_fell: self.never_fell,
            median_abs_deg: quantile(&sizes, 0.5),
            p95_abs_deg: quantile(&sizes, 0.95),
            max_abs_deg: sizes.last().copied(),
            mean_signed_deg,
            over,
            under,
            worst: self.all,
        })
    }
}

/// The `q`-quantile of sorted values, between neighbours where it falls between them.
pub fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let x = q * (sorted.len().checked_sub(1)?) as f64;
    let i = x as usize;
    let next = sorted.get(i + 1).unwrap_or(&sorted[i]);
    Some(sorted[i] + (x - i as f64) * (next - sorted[i]))
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} scenes", self.scenes)?;
        if let Some(c) = &self.config {
            write!(
                f,
                "\n  {} of {} labels right; wrong: {} with a margin of {CLEAR} mm or more, ",
                c.right, c.labelled, c.wrong_clear
            )?;
            write!(f, "{} below ({} said to stand, {} to fall)", c.wrong_borderline, c.false_stable, c.false_unstable)?;
            for w in &c.wrong {
                let margin = w.margin_mm.map_or("of unknown margin".to_owned(), |m| format!("by {m} mm"));
                write!(f, "\n    {} is {} {margin}", w.name, w.label)?;
            }
        }
        let parts = [
            ("angles of collapse", &self.tilt),
            ("angles that depend on the sides of neighbours", &self.tilt_side_sensitive),
        ];
        for (name, part) in parts {
            let Some(t) = part else { continue };
            write!(f, "\n  {} {name}", t.labelled)?;
            if t.never_fell > 0 {
                write!(f, ", {} of them never fell", t.never_fell)?;
            }
            if let (Some(median), Some(p95), Some(max), Some(mean)) =
                (t.median_abs_deg, t.p95_abs_deg, t.max_abs_deg, t.mean_signed_deg)
            {
                write!(
                    f,
                    ": median error {median:.3} degrees, 95 % within {p95:.3}, at most {max:.3}, mean {mean:+.3}; "
                )?;
                write!(f, "{} above the bound by more than {FAR}, {} below", t.over, t.under)?;
            }
            for e in t.worst.iter().filter(|e| e.error_deg.abs() > FAR) {
                write!(
                    f,
                    "\n    {} collapses at {:.2} degrees, said {:.2}",
                    e.name,
                    e.truth_deg,
                    e.truth_deg + e.error_deg
                )?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn quantiles_lie_between_neighbours() {
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[3.0], 0.95), Some(3.0));
        assert_eq!(quantile(&[1.0, 2.0, 4.0, 8.0], 0.5), Some(3.0));
        assert_eq!(quantile(&[0.0, 10.0], 0.95), Some(9.5));
    }
}
