//! Figures computed from times.

use teeter_cost::{Measurement, quartiles};

use crate::measure::{Timed, name};

/// Goal of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// No goal.
    None,
    /// Maximum.
    AtMost(f64),
    /// Minimum.
    AtLeast(f64),
    /// Value within 5 %, or less.
    About(f64),
}

impl Goal {
    /// Returns true if a figure meets the goal; `None` without a goal.
    pub fn met(self, value: f64) -> Option<bool> {
        match self {
            Goal::None => None,
            Goal::AtMost(max) => Some(value <= max),
            Goal::AtLeast(min) => Some(value >= min),
            Goal::About(about) => Some(value <= 1.05 * about),
        }
    }
}

/// Row of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Label.
    pub of: String,
    /// Goal.
    pub goal: Goal,
    /// Unit after a space, empty for a ratio.
    pub unit: &'static str,
    /// Quartiles over the rounds.
    pub quartiles: [f64; 3],
    /// Value where it is not the median of the rounds.
    value: Option<f64>,
    /// Hashes of the final states.
    pub hash: String,
}

impl Figure {
    /// Value of the figure.
    pub fn value(&self) -> f64 {
        self.value.unwrap_or(self.quartiles[1])
    }

    /// Converts the figure to another unit.
    fn times(self, factor: f64, unit: &'static str) -> Self {
        Self { unit, quartiles: self.quartiles.map(|q| q * factor), value: self.value.map(|v| v * factor), ..self }
    }
}

/// Returns all figures in the order of the table.
pub fn figures(timed: &[Timed]) -> Vec<Figure> {
    use Goal::{About, AtLeast, AtMost};
    use name::*;
    let of = |workload: &str, mode: &str| {
        timed.iter().find(|t| t.workload == workload && t.mode == mode).expect("every workload of the list is timed")
    };
    let native = |workload: &str| of(workload, NATIVE);
    let one = |workload: &str| of(workload, ONE_THREAD);
    let two = |workload: &str| of(workload, TWO_THREADS);
    vec![
        frame("full tower awake, a frame, native", native(AWAKE)),
        frame("the same in registers no wider than AVX2", of(AWAKE, AVX2)),
        ratio("full tower awake, WebAssembly with simd128 over native", AtMost(2.2), of(AWAKE, SIMD128), native(AWAKE)),
        ratio(
            "full tower awake, WebAssembly without simd128 over native",
            AtMost(5.0),
            of(AWAKE, SCALAR),
            native(AWAKE),
        ),
        ratio(
            "full tower awake, WebAssembly with simd128 over native AVX2",
            AtMost(2.2),
            of(AWAKE, SIMD128),
            of(AWAKE, AVX2),
        ),
        ratio(
            "full tower awake, WebAssembly without simd128 over native AVX2",
            AtMost(5.0),
            of(AWAKE, SCALAR),
            of(AWAKE, AVX2),
        ),
        worst("full collapse, worst frame, native", AtMost(8.0), native(COLLAPSE)),
        worst("full collapse, worst frame, WebAssembly", AtMost(16.0), of(COLLAPSE, SIMD128)),
        worst("six lowest rows knocked out, worst frame, native", AtMost(8.0), native(HIT_LOW)),
        worst("six lowest rows knocked out, worst frame, WebAssembly", AtMost(16.0), of(HIT_LOW, SIMD128)),
        worst("collapse of 40 rows, worst frame, native", Goal::None, native(TALL)),
        second("blocks of springs, full tower awake, a second, native", AtMost(350.0), native(SPRINGS)),
        second("blocks of springs, full tower awake, a second, WebAssembly", AtMost(650.0), of(SPRINGS, SIMD128)),
        ratio("tower asleep over awake", AtMost(1.0), native(ASLEEP), native(AWAKE)).times(100.0, " %"),
        ratio("cost of a block, 60 rows at rest over 6 rows", AtMost(1.15), native(ROWS_60), native(ROWS_6))
            .times(0.1, ""),
        ratio("cost of a block, 60 rows that sway over 6 rows", Goal::None, native(SWAYING), native(ROWS_6))
            .times(0.1, ""),
        speedup("200 towers in a world over one of them alone", About(200.0), one(TOGETHER_200), one(APART_200))
            .times(200.0, ""),
        speedup("64 towers in a world, two threads over one", AtLeast(1.9), one(TOGETHER_64), two(TOGETHER_64)),
        speedup("64 towers in a world each, two threads over one", AtLeast(1.9), one(APART_64), two(APART_64)),
    ]
}

/// Processor time of a frame, ms.
fn per_frame(measurement: &Measurement) -> f64 {
    measurement.cpu / measurement.frames.len() as f64
}

/// Figure of the processor time of a frame.
fn frame(of: &str, timed: &Timed) -> Figure {
    let frames: Vec<f64> = timed.measurements.iter().map(per_frame).collect();
    Figure {
        of: of.into(),
        goal: Goal::None,
        unit: " ms",
        quartiles: quartiles(&frames),
        value: None,
        hash: hashes(&[timed]),
    }
}

/// Figure of the processor time of a second of 60 frames.
fn second(of: &str, goal: Goal, timed: &Timed) -> Figure {
    Figure { goal, ..frame(of, timed).times(60.0, " ms") }
}

/// Figure of the ratio of the processor times of a frame in the same round.
fn ratio(of: &str, goal: Goal, over: &Timed, under: &Timed) -> Figure {
    let ratios: Vec<f64> =
        over.measurements.iter().zip(&under.measurements).map(|(a, b)| per_frame(a) / per_frame(b)).collect();
    Figure { of: of.into(), goal, unit: "", quartiles: quartiles(&ratios), value: None, hash: hashes(&[over, under]) }
}

/// Figure of the slowest frame.
///
/// The time of a frame is its minimum over the rounds, because the work is the same each time and
/// the rest is load of the machine. The quartiles are those of the same frame over the rounds.
fn worst(of: &str, goal: Goal, timed: &Timed) -> Figure {
    let min = min_frames(timed);
    let frame = (0..min.len()).max_by(|&a, &b| min[a].total_cmp(&min[b])).expect("a workload has frames");
    let rounds: Vec<f64> = timed.measurements.iter().map(|measurement| measurement.frames[frame]).collect();
    Figure {
        of: of.into(),
        goal,
        unit: " ms",
        quartiles: quartiles(&rounds),
        value: Some(min[frame]),
        hash: hashes(&[timed]),
    }
}

/// Figure of the speed-up in wall-clock time: the ratio of the fastest frames, because all frames
/// are the same work. The quartiles are those of the rounds.
fn speedup(of: &str, goal: Goal, slow: &Timed, fast: &Timed) -> Figure {
    let sum = |measurement: &Measurement| measurement.frames.iter().sum::<f64>();
    let ratios: Vec<f64> = slow.measurements.iter().zip(&fast.measurements).map(|(a, b)| sum(a) / sum(b)).collect();
    let shortest = |timed: &Timed| min_frames(timed).into_iter().fold(f64::INFINITY, f64::min);
    let value = Some(shortest(slow) / shortest(fast));
    Figure { of: of.into(), goal, unit: "", quartiles: quartiles(&ratios), value, hash: hashes(&[slow, fast]) }
}

/// Returns the minimum time of each frame over the rounds, ms.
fn min_frames(timed: &Timed) -> Vec<f64> {
    let frames = 0..timed.measurements[0].frames.len();
    frames
        .map(|i| timed.measurements.iter().map(|measurement| measurement.frames[i]).fold(f64::INFINITY, f64::min))
        .collect()
}

/// Formats the hashes of measurements, each once.
fn hashes(timed: &[&Timed]) -> String {
    let mut hashes: Vec<&str> = timed.iter().map(|t| t.measurements[0].hash.as_str()).collect();
    hashes.dedup();
    hashes.join(", ")
}

#[cfg(test)]
mod tests {
    use teeter_cost::CostError;

    use super::*;

    fn timed(mode: &'static str, rounds: &[&[f64]]) -> Timed {
        let mut timed = Timed::new("it", mode, || Err(CostError::UnknownWorkload));
        let measurement =
            |frames: &[f64]| Measurement { cpu: frames.iter().sum(), frames: frames.to_vec(), hash: mode.into() };
        timed.measurements = rounds.iter().map(|frames| measurement(frames)).collect();
        timed
    }

    #[test]
    fn the_slowest_frame_is_the_maximum_of_the_minima() {
        // Each round is disturbed in another frame.
        let it = timed("a", &[&[1.0, 2.0, 90.0], &[70.0, 2.2, 1.0], &[1.0, 80.0, 1.5]]);
        let figure = worst("it", Goal::AtMost(2.0), &it);
        assert_eq!((figure.value(), figure.quartiles[1]), (2.0, 2.2));
        assert_eq!(figure.goal.met(figure.value()), Some(true));
        assert_eq!(Goal::AtMost(1.9).met(figure.value()), Some(false));
    }

    #[test]
    fn a_ratio_compares_frames_of_the_same_round() {
        let (over, under) =
            (timed("a", &[&[4.0], &[40.0], &[9.0]]), timed("b", &[&[1.0, 3.0], &[10.0, 30.0], &[1.0, 2.0]]));
        let figure = ratio("it", Goal::None, &over, &under);
        assert_eq!((figure.value(), figure.hash.as_str()), (2.0, "a, b"));
        assert_eq!(figure.times(100.0, " %").value(), 200.0);
    }

    #[test]
    fn a_speedup_ignores_disturbed_rounds() {
        let (slow, fast) = (timed("a", &[&[4.1, 4.0], &[7.0, 50.0]]), timed("a", &[&[9.0, 60.0], &[2.0, 3.0]]));
        assert_eq!(speedup("it", Goal::AtLeast(1.9), &slow, &fast).value(), 2.0);
    }
}
