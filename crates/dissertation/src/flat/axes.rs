//! Separating axes (section 2.3.3): the static test, witnesses cached from step to step (section
//! 2.3.4), and the extension to moving bodies.

use std::collections::BTreeMap;

use glam::DVec2;
use serde::Serialize;

use super::body::Body;

/// Counters of the tests.
///
/// ```
/// use teeter_dissertation::flat::axes::Tester;
///
/// assert_eq!(Tester::new(true).counters.pairs, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Number of pairs of bodies tested.
    pub pairs: u64,
    /// Number of axes on which two bodies were projected.
    pub axes: u64,
    /// Number of pairs that their witness separated at once.
    pub witnesses: u64,
}

/// Axes of a pair: two of each body.
fn axes(a: &Body, b: &Body) -> [DVec2; 4] {
    let ([a0, a1], [b0, b1]) = (a.axes(), b.axes());
    [a0, a1, b0, b1]
}

/// Half the length of a body's projection on an axis, m.
fn half_extent(body: &Body, axis: DVec2) -> f64 {
    let [x, y] = body.axes();
    body.half.x * x.dot(axis).abs() + body.half.y * y.dot(axis).abs()
}

/// Separation of the projections of two bodies on an axis, m; negative where they overlap.
fn gap(a: &Body, b: &Body, axis: DVec2) -> f64 {
    (b.centre - a.centre).dot(axis).abs() - half_extent(a, axis) - half_extent(b, axis)
}

/// Returns the index of the axis of maximum separation of two bodies, and that separation, m.
pub fn max_separation(a: &Body, b: &Body) -> (usize, f64) {
    let gaps = axes(a, b).map(|axis| gap(a, b, axis));
    // The first of nearly equal axes, so that rounding does not decide.
    (1..4).fold((0, gaps[0]), |best, n| if gaps[n] > best.1 + 1e-9 { (n, gaps[n]) } else { best })
}

/// Unit normal from `b` to `a` along the axis of maximum separation.
pub fn normal(a: &Body, b: &Body) -> DVec2 {
    let axis = axes(a, b)[max_separation(a, b).0];
    if (a.centre - b.centre).dot(axis) < 0.0 { -axis } else { axis }
}

/// Static overlap test with or without witnesses.
///
/// ```
/// use teeter_dissertation::flat::axes::Tester;
/// use teeter_dissertation::flat::body::Body;
/// use teeter_dissertation::flat::scene::stack;
///
/// let blocks = stack(2, 1e-3).iter().map(Body::new).collect::<Vec<_>>();
/// let mut tester = Tester::new(true);
/// assert!(!tester.overlap((0, 1), &blocks[0], &blocks[1], 0.0));
/// assert!(!tester.overlap((0, 1), &blocks[0], &blocks[1], 0.0));
/// assert_eq!(tester.counters.witnesses, 1); // the second test needed one axis
/// ```
#[derive(Debug, Clone, Default)]
pub struct Tester {
    /// Counters of the tests.
    pub counters: Counters,
    /// Last separating axis of each pair; `None` without witnesses.
    witnesses: Option<BTreeMap<(u32, u32), u8>>,
}

impl Tester {
    /// Creates a test; `use_witnesses` caches separating axes.
    pub fn new(use_witnesses: bool) -> Self {
        Self { counters: Counters::default(), witnesses: use_witnesses.then(BTreeMap::new) }
    }

    /// Returns true if two bodies overlap by more than `slop` (m). `ids` identify the pair for its
    /// witness.
    pub fn overlap(&mut self, ids: (u32, u32), a: &Body, b: &Body, slop: f64) -> bool {
        self.counters.pairs += 1;
        let axes = axes(a, b);
        let mut first = None;
        if let Some(&n) = self.witnesses.as_ref().and_then(|witnesses| witnesses.get(&ids)) {
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
                if let Some(witnesses) = &mut self.witnesses {
                    witnesses.insert(ids, n as u8);
                }
                return false;
            }
        }
        true
    }

    /// Returns the first time from 0 to 1 at which two bodies overlap by more than `slop` (m) while
    /// `b` moves by `displacement` (m) relative to `a` and neither rotates.
    ///
    /// On every axis the projections overlap during an interval of time, and the bodies while all
    /// do.
    pub fn first_overlap(&mut self, a: &Body, b: &Body, displacement: DVec2, slop: f64) -> Option<f64> {
        self.counters.pairs += 1;
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in axes(a, b) {
            self.counters.axes += 1;
            let (position, speed) = ((b.centre - a.centre).dot(axis), displacement.dot(axis));
            let extent = half_extent(a, axis) + half_extent(b, axis) - slop;
            if speed == 0.0 {
                if position.abs() >= extent {
                    return None;
                }
                continue;
            }
            let (s, t) = ((-extent - position) / speed, (extent - position) / speed);
            (enter, leave) = (enter.max(s.min(t)), leave.min(s.max(t)));
            if enter >= leave {
                return None;
            }
        }
        Some(enter)
    }
}
