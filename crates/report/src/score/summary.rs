//! Comparison of predictions with labels.

use std::fmt;

use serde::Serialize;
use teeter_study::Prediction;

use super::labelled::Labelled;
use crate::statistics::sorted_quantile;

/// Margin from which on a label counts as clear, mm. Below it, a difference finer than the blocks
/// are made decides.
const CLEAR_MARGIN: f64 = 0.1;
/// Error of an angle from which on it is counted, degrees.
const MAX_ERROR: f64 = 0.2;
/// Number of angles listed with their errors.
const LISTED: usize = 10;

/// Comparison of predictions with labels.
#[derive(Debug, Default, Serialize)]
pub struct Summary {
    /// Number of scenes.
    scenes: usize,
    /// Scenes with a label for stability.
    #[serde(skip_serializing_if = "Option::is_none")]
    config: Option<Config>,
    /// Scenes with a collapse angle, without those that depend on the sides of neighbours.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<Tilt>,
    /// Scenes with a collapse angle that depends on contact between the sides of neighbours.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt_side_sensitive: Option<Tilt>,
}

/// Comparison of predictions of stability.
#[derive(Debug, Default, Serialize)]
struct Config {
    labelled: usize,
    right: usize,
    /// Wrong with a margin of 0.1 mm or more.
    wrong_clear: usize,
    /// Wrong with a smaller margin.
    wrong_borderline: usize,
    /// Predicted to stand, labelled unstable.
    false_stable: usize,
    /// Predicted to fall, labelled stable.
    false_unstable: usize,
    /// Wrong predictions, the clearest first.
    wrong: Vec<Wrong>,
}

#[derive(Debug, Serialize)]
struct Wrong {
    name: String,
    label: String,
    margin_mm: Option<f64>,
}

/// Comparison of collapse angles.
#[derive(Debug, Default, Serialize)]
struct Tilt {
    labelled: usize,
    /// Predicted to stand at any angle.
    never_fell: usize,
    median_abs_deg: Option<f64>,
    p95_abs_deg: Option<f64>,
    max_abs_deg: Option<f64>,
    mean_signed_deg: Option<f64>,
    /// More than 0.2 degrees above the bound.
    over: usize,
    /// More than 0.2 degrees below it.
    under: usize,
    /// Ten largest errors.
    worst: Vec<AngleError>,
}

#[derive(Debug, Serialize)]
struct AngleError {
    name: String,
    truth_deg: f64,
    error_deg: f64,
}

impl Summary {
    /// Compares predictions with the labels of the same scenes, in the same order.
    pub fn of(scenes: &[Labelled], predictions: &[Prediction]) -> Self {
        let mut config = Config::default();
        let mut plain = Errors::default();
        let mut sides = Errors::default();
        for (scene, prediction) in scenes.iter().zip(predictions) {
            match prediction {
                Prediction::Config { fell, .. } => config.count(scene, *fell),
                Prediction::Tilt { tilt_deg, .. } => {
                    if let Some(truth) = scene.truth.tilt_deg {
                        let errors = if scene.truth.side_sensitive { &mut sides } else { &mut plain };
                        errors.count(&scene.scene.name, truth, *tilt_deg);
                    }
                }
            }
        }
        config.wrong.sort_by(|a, b| b.margin().total_cmp(&a.margin()));
        Self {
            scenes: scenes.len(),
            config: (config.labelled > 0).then_some(config),
            tilt: plain.summary(),
            tilt_side_sensitive: sides.summary(),
        }
    }
}

impl Config {
    fn count(&mut self, tower: &Labelled, fell: bool) {
        let Some(label) = &tower.scene.label else { return };
        self.labelled += 1;
        if fell == (label == "unstable") {
            self.right += 1;
            return;
        }
        let wrong = Wrong { name: tower.scene.name.clone(), label: label.clone(), margin_mm: tower.scene.margin };
        let is_clear = wrong.margin() >= CLEAR_MARGIN;
        *(if is_clear { &mut self.wrong_clear } else { &mut self.wrong_borderline }) += 1;
        *(if fell { &mut self.false_unstable } else { &mut self.false_stable }) += 1;
        self.wrong.push(wrong);
    }
}

impl Wrong {
    /// Distance from the border between standing and falling, mm; infinite where it is not known.
    fn margin(&self) -> f64 {
        self.margin_mm.map_or(f64::INFINITY, f64::abs)
    }
}

#[derive(Default)]
struct Errors {
    never_fell: usize,
    all: Vec<AngleError>,
}

impl Errors {
    fn count(&mut self, name: &str, truth_deg: f64, tilt_deg: Option<f64>) {
        match tilt_deg {
            Some(deg) => self.all.push(AngleError { name: name.to_owned(), truth_deg, error_deg: deg - truth_deg }),
            None => self.never_fell += 1,
        }
    }

    fn summary(mut self) -> Option<Tilt> {
        let labelled = self.all.len() + self.never_fell;
        if labelled == 0 {
            return None;
        }
        let over = self.all.iter().filter(|e| e.error_deg > MAX_ERROR).count();
        let under = self.all.iter().filter(|e| e.error_deg < -MAX_ERROR).count();
        let n = self.all.len();
        let mean_signed_deg = (n > 0).then(|| self.all.iter().map(|e| e.error_deg).sum::<f64>() / n as f64);
        self.all.sort_by(|a, b| b.error_deg.abs().total_cmp(&a.error_deg.abs()));
        let mut sizes: Vec<f64> = self.all.iter().map(|e| e.error_deg.abs()).collect();
        sizes.reverse();
        self.all.truncate(LISTED);
        Some(Tilt {
            labelled,
            never_fell: self.never_fell,
            median_abs_deg: sorted_quantile(&sizes, 0.5),
            p95_abs_deg: sorted_quantile(&sizes, 0.95),
            max_abs_deg: sizes.last().copied(),
            mean_signed_deg,
            over,
            under,
            worst: self.all,
        })
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} scenes", self.scenes)?;
        if let Some(config) = &self.config {
            config.fmt(f)?;
        }
        let parts = [
            ("collapse angles", &self.tilt),
            ("collapse angles that depend on the sides of neighbours", &self.tilt_side_sensitive),
        ];
        parts.into_iter().filter_map(|(name, tilt)| Some((name, tilt.as_ref()?))).try_for_each(|(n, t)| t.write(f, n))
    }
}

impl fmt::Display for Config {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n  {} of {} labels right; ", self.right, self.labelled)?;
        write!(f, "wrong: {} with a margin of {CLEAR_MARGIN} mm or more, ", self.wrong_clear)?;
        write!(
            f,
            "{} with a smaller one ({} predicted to stand, {} to fall)",
            self.wrong_borderline, self.false_stable, self.false_unstable
        )?;
        self.wrong.iter().try_for_each(|wrong| {
            let margin = wrong.margin_mm.map_or("of unknown margin".to_owned(), |m| format!("by {m} mm"));
            write!(f, "\n    {} is {} {margin}", wrong.name, wrong.label)
        })
    }
}

impl Tilt {
    fn write(&self, f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
        write!(f, "\n  {} {name}", self.labelled)?;
        if self.never_fell > 0 {
            write!(f, ", {} of them never fell", self.never_fell)?;
        }
        if let (Some(median), Some(p95), Some(max), Some(mean)) =
            (self.median_abs_deg, self.p95_abs_deg, self.max_abs_deg, self.mean_signed_deg)
        {
            write!(f, ": median error {median:.3} degrees, 95 % within {p95:.3}, maximum {max:.3}, mean {mean:+.3}; ")?;
            write!(f, "{} above the bound by more than {MAX_ERROR}, {} below", self.over, self.under)?;
        }
        self.worst.iter().filter(|e| e.error_deg.abs() > MAX_ERROR).try_for_each(|e| {
            let predicted = e.truth_deg + e.error_deg;
            write!(f, "\n    {} collapses at {:.2} degrees, predicted {predicted:.2}", e.name, e.truth_deg)
        })
    }
}
