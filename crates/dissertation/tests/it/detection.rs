//! Detection against samples in time of moving primitives, which do not use cubics.
//!
//! `PROPTEST_CASES=1000000 cargo test --release -p teeter-dissertation --test it detection` is the
//! long run.

use crate::common::{cases, vector};
use glam::DVec3;
use proptest::prelude::*;
use teeter_dissertation::jenga3d::edge_edge;
use teeter_dissertation::jenga3d::path::Path;
use teeter_dissertation::jenga3d::point_face;

/// Number of time samples of the reference.
const SAMPLES: usize = 128;

/// Distance from the border of a primitive within which the reference does not decide.
const MARGIN: f64 = 1e-6;

/// Returns the first change of sign of `value` between samples that `counts`, by bisection.
fn first_change(value: impl Fn(f64) -> f64, counts: impl Fn(f64, bool) -> bool) -> Option<f64> {
    let time = |k: usize| k as f64 / SAMPLES as f64;
    (0..SAMPLES).find_map(|k| {
        let (mut low, mut high) = (time(k), time(k + 1));
        let positive = value(low) > 0.0;
        if positive == (value(high) > 0.0) {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (value(middle) > 0.0) == positive { low = middle } else { high = middle }
        }
        counts(high, positive).then_some(high)
    })
}

/// Six times the volume of the tetrahedron of four points.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    (d - a).dot((b - a).cross(c - a))
}

/// Uncertainty by rounding of the time of a change of sign. Volumes of primitives of size 1 have
/// errors of about 1e-16, which a slow change turns into a long time.
fn blur(value: impl Fn(f64) -> f64, t: f64) -> f64 {
    const ROUNDING: f64 = 1e-14;
    let apart = 1e-4;
    2.0 * apart * ROUNDING / (value(t + apart) - value(t - apart)).abs()
}

/// Returns a path of the size of the primitives, or a tenth to a millionth of it.
fn path_near(start: DVec3, step: DVec3, smaller: u32) -> Path {
    Path { start, step: step * 0.1f64.powi_exact(smaller) }
}

trait Powers {
    fn powi_exact(self, n: u32) -> f64;
}

impl Powers for f64 {
    fn powi_exact(self, n: u32) -> f64 {
        (0..n).fold(1.0, |power, _| power * self)
    }
}

proptest! {
    #![proptest_config(cases(40_000))]

    #[test]
    fn point_face_detection_agrees_with_samples(
        corners in [vector(), vector(), vector()], share in [0.0..1.0, 0.0..1.0f64], aside in vector(), near in 0..7u32,
        steps in [vector(), vector(), vector(), vector()], smaller in 0..7u32,
    ) {
        let face = [0, 1, 2].map(|i| path_near(corners[i], steps[i], smaller));
        // The point starts near the triangle, so that crossings are frequent at every scale of
        // motion.
        let (s, t) = (share[0].min(share[1]), share[0].max(share[1]));
        let on = corners[0] * s + corners[1] * (t - s) + corners[2] * (1.0 - t);
        let point = path_near(on + aside * 0.1f64.powi_exact(near), steps[3], smaller);

        let at = |t: f64| [face[0].at(t), face[1].at(t), face[2].at(t), point.at(t)];
        // Positive in front: the corners are clockwise there.
        let height = |t: f64| { let [a, b, c, p] = at(t); -volume(a, b, c, p) };
        let shares = |t: f64| {
            let [a, b, c, p] = at(t);
            let n = (b - a).cross(c - a);
            let part = |x: DVec3, y: DVec3| (x - p).cross(y - p).dot(n) / n.length_squared();
            [part(b, c), part(c, a), part(a, b)]
        };
        let distance = point_face::distance(&point, &face);
        let hit = if distance.may_have_root() { point_face::first_hit(&distance, &point, &face, 0.0) } else { None };
        let seen = first_change(height, |t, falls| falls && shares(t).iter().all(|w| *w > MARGIN));
        if let Some(t) = seen {
            let hit = hit.ok_or_else(|| TestCaseError::fail(format!("missed at {t}")))?;
            prop_assert!(hit.t <= t + blur(height, t), "{} after {t}", hit.t);
        }
        if let Some(hit) = hit {
            prop_assert!((0.0..=1.0).contains(&hit.t));
            let [a, b, c, p] = at(hit.t);
            let size = (b - a).cross(c - a).length();
            // The bound is the rounding error of the cubic for lengths of 1.
            prop_assert!(height(hit.t).abs() < 1e-13, "not in the plane: {}", height(hit.t) / size);
            if size > 1e-3 {
                prop_assert!(shares(hit.t).iter().all(|w| *w > -MARGIN), "outside: {:?}", shares(hit.t));
                let again = a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2];
                prop_assert!(again.distance(p) < 1e-9, "weights of another point: {:?}", hit.weights);
            }
        }
    }

    #[test]
    fn edge_edge_detection_agrees_with_samples(
        first in [vector(), vector()], along in [0.0..1.0, 0.0..1.0f64], direction in vector(), aside in vector(), near in 0..7u32,
        steps in [vector(), vector(), vector(), vector()], smaller in 0..7u32,
    ) {
        let a = [0, 1].map(|i| path_near(first[i], steps[i], smaller));
        let cross = first[0] + along[0] * (first[1] - first[0]) + aside * 0.1f64.powi_exact(near);
        let b = [path_near(cross - along[1] * direction, steps[2], smaller), path_near(cross + (1.0 - along[1]) * direction, steps[3], smaller)];

        let at = |t: f64| [a[0].at(t), a[1].at(t), b[0].at(t), b[1].at(t)];
        let height = |t: f64| { let [p1, p2, p3, p4] = at(t); volume(p1, p2, p3, p4) };
        // Position of the crossing on each edge, seen along their common normal.
        let positions = |t: f64| {
            let [p1, p2, p3, p4] = at(t);
            let n = (p2 - p1).cross(p4 - p3);
            let position = |x: DVec3, y: DVec3, u: DVec3, v: DVec3| {
                let side = |p: DVec3| (p - u).dot((v - u).cross(n));
                side(x) / (side(x) - side(y))
            };
            [position(p1, p2, p3, p4), position(p3, p4, p1, p2)]
        };
        let inside = |t: f64, margin: f64| positions(t).iter().all(|mu| *mu > margin && *mu < 1.0 - margin);
        let across = |t: f64| { let [p1, p2, p3, p4] = at(t); (p2 - p1).cross(p4 - p3).length() };
        let distance = edge_edge::distance(&a, &b);
        let hit = if distance.may_have_root() { edge_edge::first_hit(&distance, &a, &b, 0.0) } else { None };
        let seen = first_change(height, |t, _| across(t) > 1e-3 && inside(t, MARGIN));
        if let Some(t) = seen {
            let hit = hit.ok_or_else(|| TestCaseError::fail(format!("missed at {t}")))?;
            prop_assert!(hit.t <= t + blur(height, t), "{} after {t}", hit.t);
        }
        if let Some(hit) = hit {
            prop_assert!((0.0..=1.0).contains(&hit.t));
            prop_assert!(height(hit.t).abs() < 1e-13, "not crossing: {}", height(hit.t));
            if across(hit.t) > 1e-3 {
                prop_assert!(inside(hit.t, -MARGIN), "beyond the ends: {:?}", positions(hit.t));
                let [p1, p2, p3, p4] = at(hit.t);
                let (on_a, on_b) = (p1 + hit.mu_1 * (p2 - p1), p3 + hit.mu_2 * (p4 - p3));
                prop_assert!(on_a.distance(on_b) < 1e-9, "positions of another point: {} {}", hit.mu_1, hit.mu_2);
            }
        }
    }
}

/// The plane test of section 4.4.1 compares the two ends only and misses a point that passes a
/// rotating face and returns within the step. The detection of collisions finds it.
#[test]
fn a_point_that_returns_within_the_step_is_detected() {
    let still = |start: DVec3| Path { start, step: DVec3::ZERO };
    // Clockwise from above. The face rises on one side and falls on the other, so a point that
    // crosses it sideways is above, below and above.
    let face = [still(DVec3::new(-1.0, 0.0, 0.0)), still(DVec3::new(0.0, 1.0, 0.0)), still(DVec3::new(1.0, 0.0, 0.0))];
    let turning = [
        Path { start: DVec3::new(-1.0, -1.0, 0.0), step: DVec3::new(0.0, 0.0, 0.8) },
        Path { start: DVec3::new(0.0, 2.0, 0.0), step: DVec3::ZERO },
        Path { start: DVec3::new(1.0, -1.0, 0.0), step: DVec3::new(0.0, 0.0, -0.8) },
    ];
    let through = Path { start: DVec3::new(-0.6, 0.0, 0.05), step: DVec3::new(1.2, 0.0, -0.1) };
    let count = |face: &[Path; 3], point: &Path| point_face::distance(point, face).crossings().as_slice().len();
    assert_eq!(count(&face, &still(DVec3::new(0.0, 0.5, 0.1))), 0);
    assert!(!point_face::passes_plane(&through, &turning));
    let hit = point_face::first_hit(&point_face::distance(&through, &turning), &through, &turning, 0.0);
    assert!(hit.is_some());
}
