//! From times to figures.

use teeter_cost::{Stretch, quartiles};

use crate::measure::{Timed, name};

/// What a figure should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// It is for information.
    None,
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
    /// This, give or take a twentieth; less is as good.
    About(f64),
}

impl Goal {
    /// Whether a figure is what it should be; none where there is no goal.
    pub fn met(self, value: f64) -> Option<bool> {
        match self {
            Goal::None => None,
            Goal::AtMost(most) => Some(value <= most),
            Goal::AtLeast(least) => Some(value >= least),
            Goal::About(about) => Some(value <= 1.05 * about),
        }
    }
}

/// A line of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is of.
    pub of: String,
    /// What it should be.
    pub goal: Goal,
    /// Its unit after a space, empty for a ratio.
    pub unit: &'static str,
    /// Quartiles over the rounds.
    pub quartiles: [f64; 3],
    /// What it is where that is not the median of the rounds.
    value: Option<f64>,
    /// Hash of the state at the end of what was measured.
    pub hash: String,
}

impl Figure {
    /// What it is.
    pub fn value(&self) -> f64 {
        self.value.unwrap_or(self.quartiles[1])
    }

    /// The same in another unit.
    fn times(self, factor: f64, unit: &'static str) -> Self {
        Self { unit, quartiles: self.quartiles.map(|q| q * factor), value: self.value.map(|v| v * factor), ..self }
    }
}

/// All figures, in the order of the table.
pub fn figures(timed: &[Timed]) -> Vec<Figure> {
    use Goal::{About, AtLeast, AtMost};
    use name::*;
    let of = |what: &str, way: &str| {
        timed.iter().find(|t| t.what == what && t.way == way).expect("everything on the list is timed")
    };
    let native = |what: &str| of(what, NATIVE);
    let one = |what: &str| of(what, ONE_THREAD);
    let two = |what: &str| of(what, TWO_THREADS);
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
fn per_frame(stretch: &Stretch) -> f64 {
    stretch.cpu / stretch.frames.len() as f64
}

/// What a frame takes of the processor.
fn frame(of: &str, timed: &Timed) -> Figure {
    let frames: Vec<f64> = timed.stretches.iter().map(per_frame).collect();
    Figure {
        of: of.into(),
        goal: Goal::None,
        unit: " ms",
        quartiles: quartiles(&frames),
        value: None,
        hash: hashes(&[timed]),
    }
}

/// What a second of 60 frames takes of the processor.
fn second(of: &str, goal: Goal, timed: &Timed) -> Figure {
    Figure { goal, ..frame(of, timed).times(60.0, " ms") }
}

/// The ratio of what a frame takes of the processor, of both in the same round.
fn ratio(of: &str, goal: Goal, over: &Timed, under: &Timed) -> Figure {
    let ratios: Vec<f64> =
        over.stretches.iter().zip(&under.stretches).map(|(a, b)| per_frame(a) / per_frame(b)).collect();
    Figure { of: of.into(), goal, unit: "", quartiles: quartiles(&ratios), value: None, hash: hashes(&[over, under]) }
}

/// The frame that takes longest. A frame takes the least of what it took in any round: it is the same work each time, and the rest is what
/// else the machine did. The quartiles are those of the same frame over the rounds.
fn worst(of: &str, goal: Goal, timed: &Timed) -> Figure {
    let least = least(timed);
    let frame = (0..least.len()).max_by(|&a, &b| least[a].total_cmp(&least[b])).expect("a workload has frames");
    let rounds: Vec<f64> = timed.stretches.iter().map(|stretch| stretch.frames[frame]).collect();
    Figure {
        of: of.into(),
        goal,
        unit: " ms",
        quartiles: quartiles(&rounds),
        value: Some(least[frame]),
        hash: hashes(&[timed]),
    }
}

/// How much longer a frame takes by the clock on the wall: the frame that took least of one over that of the other, for they are all the
/// same work. The quartiles are those of the rounds.
fn speedup(of: &str, goal: Goal, slow: &Timed, fast: &Timed) -> Figure {
    let sum = |stretch: &Stretch| stretch.frames.iter().sum::<f64>();
    let ratios: Vec<f64> = slow.stretches.iter().zip(&fast.stretches).map(|(a, b)| sum(a) / sum(b)).collect();
    let shortest = |timed: &Timed| least(timed).into_iter().fold(f64::INFINITY, f64::min);
    let value = Some(shortest(slow) / shortest(fast));
    Figure { of: of.into(), goal, unit: "", quartiles: quartiles(&ratios), value, hash: hashes(&[slow, fast]) }
}

/// The least that each frame took in any round, ms.
fn least(timed: &Timed) -> Vec<f64> {
    let frames = 0..timed.stretches[0].frames.len();
    frames.map(|i| timed.stretches.iter().map(|stretch| stretch.frames[i]).fold(f64::INFINITY, f64::min)).collect()
}

/// The hashes of what was timed, each once.
fn hashes(timed: &[&Timed]) -> String {
    let mut hashes: Vec<&str> = timed.iter().map(|t| t.stretches[0].hash.as_str()).collect();
    hashes.dedup();
    hashes.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timed(way: &'static str, rounds: &[&[f64]]) -> Timed {
        let mut timed = Timed::new("it", way, || Err("it is not played".into()));
        let stretch = |frames: &[f64]| Stretch { cpu: frames.iter().sum(), frames: frames.to_vec(), hash: way.into() };
        timed.stretches = rounds.iter().map(|frames| stretch(frames)).collect();
        timed
    }

    #[test]
    fn the_worst_frame_is_the_worst_of_the_least() {
        // disturbed in another frame each round
        let it = timed("a", &[&[1.0, 2.0, 90.0], &[70.0, 2.2, 1.0], &[1.0, 80.0, 1.5]]);
        let figure = worst("it", Goal::AtMost(2.0), &it);
        assert_eq!((figure.value(), figure.quartiles[1]), (2.0, 2.2));
        assert_eq!(figure.goal.met(figure.value()), Some(true));
        assert_eq!(Goal::AtMost(1.9).met(figure.value()), Some(false));
    }

    #[test]
    fn a_ratio_is_that_of_frames_in_the_same_round() {
        let (over, under) =
            (timed("a", &[&[4.0], &[40.0], &[9.0]]), timed("b", &[&[1.0, 3.0], &[10.0, 30.0], &[1.0, 2.0]]));
        let figure = ratio("it", Goal::None, &over, &under);
        assert_eq!((figure.value(), figure.hash.as_str()), (2.0, "a, b"));
        assert_eq!(figure.times(100.0, " %").value(), 200.0);
    }

    #[test]
    fn a_speedup_leaves_out_what_disturbed_it() {
        let (slow, fast) = (timed("a", &[&[4.1, 4.0], &[7.0, 50.0]]), timed("a", &[&[9.0, 60.0], &[2.0, 3.0]]));
        assert_eq!(speedup("it", Goal::AtLeast(1.9), &slow, &fast).value(), 2.0);
    }
}
