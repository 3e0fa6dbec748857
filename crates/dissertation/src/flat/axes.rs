//! Separating axes (section 2.3.3): the static test, witnesses that are kept from step to step (section 2.3.4), and the extension to moving
//! bodies.

use std::collections::BTreeMap;

use glam::DVec2;
use serde::Serialize;

use super::body::Body;

/// Counts of the work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Pairs of bodies looked at.
    pub pairs: u64,
    /// Axes on which two bodies were projected.
    pub axes: u64,
    /// Pairs that their witness parted at once.
    pub witnesses: u64,
}

/// The axes of a pair: two of each body.
fn axes(a: &Body, b: &Body) -> [DVec2; 4] {
    let ([a0, a1], [b0, b1]) = (a.axes(), b.axes());
    [a0, a1, b0, b1]
}

/// Half the length of a body's shadow on an axis, m.
fn reach(body: &Body, axis: DVec2) -> f64 {
    let [x, y] = body.axes();
    body.half.x * x.dot(axis).abs() + body.half.y * y.dot(axis).abs()
}

/// Gap between the shadows of two bodies on an axis, m; negative where they overlap.
fn gap(a: &Body, b: &Body, axis: DVec2) -> f64 {
    (b.centre - a.centre).dot(axis).abs() - reach(a, axis) - reach(b, axis)
}

/// The axis on which two bodies are furthest apart, or overlap least: its number and the gap, m.
pub fn widest(a: &Body, b: &Body) -> (usize, f64) {
    let gaps = axes(a, b).map(|axis| gap(a, b, axis));
    // Of nearly equal ones the first, so that rounding does not decide.
    (1..4).fold((0, gaps[0]), |best, n| if gaps[n] > best.1 + 1e-9 { (n, gaps[n]) } else { best })
}

/// Unit normal from `b` to `a` along the widest axis.
pub fn normal(a: &Body, b: &Body) -> DVec2 {
    let axis = axes(a, b)[widest(a, b).0];
    if (a.centre - b.centre).dot(axis) < 0.0 { -axis } else { axis }
}

/// The static test with or without witnesses.
#[derive(Debug, Clone, Default)]
pub struct Tester {
    /// What was done.
    pub counters: Counters,
    /// The axis that parted each pair last; none are kept where witnesses are not wanted.
    witnesses: Option<BTreeMap<(u32, u32), u8>>,
}

impl Tester {
    /// A test that begins without witnesses.
    pub fn new(keep_witnesses: bool) -> Self {
        Self { counters: Counters::default(), witnesses: keep_witnesses.then(BTreeMap::new) }
    }

    /// Whether two bodies overlap by more than `slop` (m). `ids` names the pair for its witness.
    pub fn overlap(&mut self, ids: (u32, u32), a: &Body, b: &Body, slop: f64) -> bool {
        self.counters.pairs += 1;
        let axes = axes(a, b);
        let mut first = None;
        if let Some(&n) = self.witnesses.as_ref().and_then(|kept| kept.get(&ids)) {
            self.counters.axes += 1;
            if gap(a, b, axes[n as usize]) >= -slop {
                self.counters.witnesses += 1;
                return false;
            }
            first = Some(n as usize);
        }
        for (n, axis) in axes.into_iter().enumerate().filter(|(n, _)| Some(*n) != first) {
            self.counters.axes += 1;
            if gap(a, b, axis) >= -slop {
                if let Some(kept) = &mut self.witnesses {
                    kept.insert(ids, n as u8);
                }
                return false;
            }
        }
        true
    }

    /// When two bodies first overlap if the one is shifted by `a_way` and the other by `b_way` (m) while t goes from 0 to 1, without turning:
    /// on every axis the shadows overlap during an interval of time, and the bodies while all do.
    pub fn first_overlap(&mut self, a: &Body, b: &Body, a_way: DVec2, b_way: DVec2, slop: f64) -> Option<f64> {
        self.counters.pairs += 1;
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in axes(a, b) {
            self.counters.axes += 1;
            let (place, speed) = ((b.centre - a.centre).dot(axis), (b_way - a_way).dot(axis));
            let reach = reach(a, axis) + reach(b, axis) - slop;
            if speed == 0.0 {
                if place.abs() >= reach {
                    return None;
                }
                continue;
            }
            let (s, t) = ((-reach - place) / speed, (reach - place) / speed);
            (enter, leave) = (enter.max(s.min(t)), leave.min(s.max(t)));
            if enter >= leave {
                return None;
            }
        }
        Some(enter)
    }
}
