//! Axes: their ranges, ticks and labels.

use std::ops::Range;

use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;

/// Spacing of values along an axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Scale {
    /// In proportion to the values.
    #[default]
    Linear,
    /// In proportion to the logarithms of the values.
    Log,
}

/// Axis of a chart.
#[derive(Debug, Clone, Default)]
pub struct Axis {
    /// Quantity with its unit.
    pub label: String,
    /// Spacing of the values.
    pub scale: Scale,
}

impl Axis {
    /// Linear axis.
    pub fn new(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Linear }
    }

    /// Logarithmic axis.
    pub fn log(label: &str) -> Self {
        Self { label: label.to_owned(), scale: Scale::Log }
    }

    /// Returns true if the axis has a position for a value.
    pub(super) fn admits(&self, value: f64) -> bool {
        value.is_finite() && (self.scale == Scale::Linear || value > 0.0)
    }

    /// Coordinate of the smallest range between round numbers that contains `values`.
    pub(super) fn coordinate(&self, values: impl Iterator<Item = f64>) -> Coordinate {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (1.0, 1.0) };
        match self.scale {
            Scale::Linear => {
                let step = if low < high { round_step(high - low) } else { 1.0 };
                let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
                Coordinate::Linear((low..if low < high { high } else { low + step }).into())
            }
            Scale::Log => {
                let low = libm::floor(libm::log10(low)) as i32;
                let high = (libm::ceil(libm::log10(high)) as i32).max(low + 1);
                Coordinate::Log { log: (power(low)..power(high)).log_scale().into(), low, high }
            }
        }
    }
}

/// Returns a power of ten.
fn power(exponent: i32) -> f64 {
    libm::pow(10.0, f64::from(exponent))
}

/// Returns powers of ten from `low` to `high` (exponents), at most `count`, or also twice and five
/// times these on a short axis.
fn log_ticks(low: i32, high: i32, count: usize) -> Vec<f64> {
    let decades = (high - low) as usize;
    let factors: &[f64] = if decades <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let powers = (low..=high).step_by(1 + decades / count.max(1)).map(power);
    let ticks = powers.flat_map(|power| factors.iter().map(move |factor| factor * power));
    ticks.filter(|tick| *tick <= power(high)).collect()
}

/// Returns 1, 2 or 5 times a power of ten, about a fifth of a length.
fn round_step(length: f64) -> f64 {
    let raw = length / 5.0;
    let power = libm::pow(10.0, libm::floor(libm::log10(raw)));
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= raw * (1.0 - 1e-9))
        .unwrap_or(raw)
}

/// Map from values to pixels, linear or logarithmic.
pub(super) enum Coordinate {
    Linear(RangedCoordf64),
    Log {
        log: LogCoord<f64>,
        /// Exponents of the ends of the axis.
        low: i32,
        high: i32,
    },
}

impl Ranged for Coordinate {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        match self {
            Self::Linear(linear) => linear.map(value, limit),
            Self::Log { log, .. } => log.map(value, limit),
        }
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match self {
            Self::Linear(linear) => linear.key_points(hint),
            Self::Log { low, high, .. } => log_ticks(*low, *high, hint.max_num_points()),
        }
    }

    fn range(&self) -> Range<f64> {
        match self {
            Self::Linear(linear) => linear.range(),
            Self::Log { log, .. } => log.range(),
        }
    }
}

impl ValueFormatter<f64> for Coordinate {
    fn format_ext(&self, value: &f64) -> String {
        // Ticks are sums of steps: twelve digits hide what rounding adds.
        let rounded: f64 = format!("{value:.12e}").parse().unwrap_or(*value);
        match rounded.abs() {
            size if size != 0.0 && !(1e-3..1e5).contains(&size) => format!("{rounded:e}"),
            _ => format!("{rounded}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_begin_and_end_at_round_numbers() {
        let range = |axis: Axis, values: &[f64]| axis.coordinate(values.iter().copied()).range();
        assert_eq!(range(Axis::new("x"), &[0.13, 3.7]), 0.0..4.0);
        assert_eq!(range(Axis::new("x"), &[2.0]), 2.0..3.0);
        let log = range(Axis::log("x"), &[3e-4, 20.0]);
        assert!((log.start / 1e-4 - 1.0).abs() < 1e-12 && (log.end / 100.0 - 1.0).abs() < 1e-12, "{log:?}");
    }

    #[test]
    fn ticks_of_a_logarithmic_axis_contain_both_ends() {
        assert_eq!(log_ticks(-2, -1, 8), [0.01, 0.02, 0.05, 0.1]);
        assert_eq!(log_ticks(0, 3, 8), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(log_ticks(0, 10, 6), [1.0, 100.0, 1e4, 1e6, 1e8, 1e10]);
    }

    #[test]
    fn labels_are_short() {
        let label = |value| Axis::log("x").coordinate([1.0].into_iter()).format_ext(&value);
        assert_eq!([label(0.30000000000000004), label(1e-4), label(1e6), label(0.0)], ["0.3", "1e-4", "1e6", "0"]);
    }
}
