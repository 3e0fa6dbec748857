//! Which of several exact answers springs come to as they grow stiff.
//!
//! Rigid blocks that lie flat on each other share a load between the corners of a patch in more than one way. Springs of a stiffness per area have one:
//! the least of
//!
//! ```text
//! E(u) = sum w u + 1/2 sum k_i max(0, -(gap_i + a_i u))^2
//! ```
//!
//! over heights and small tilts u. As k grows their forces go to that one of the optimal solutions of the linear programme that has the least
//! sum N_i^2 / k_i. E is convex and quadratic in pieces, so Newton's method with a line search ends after a few steps at each stiffness; stiffness grows
//! tenfold from one to the next.

use crate::linear::solve;

/// Springs with which the search begins, N/m.
const SOFTEST: f64 = 1e4;
/// Springs that are as good as rigid, N/m: a force of 1 N overlaps by 1 nm, and heights differ by 0.1 mm.
pub const RIGID: f64 = 1e9;
/// Most steps of Newton's method at one stiffness.
const STEPS: usize = 200;
/// Share of the largest stiffness that holds what no spring does, so that each step has an answer.
const HELD: f64 = 1e-6;
/// Share of the slope at the start of a step at which the search along it ends.
const STEEP: f64 = 0.1;
/// What is left of the largest weight where forces balance: well above what rounding leaves at the stiffest.
const BALANCED: f64 = 1e-7;

/// A spring between unknowns: it is as short as `gap` plus the sum of factors times unknowns, m, and pushes where that is negative.
pub struct Spring {
    /// Unknowns and their factors.
    pub acts: Vec<(usize, f64)>,
    /// Length without displacement, m.
    pub gap: f64,
    /// Share of the stiffness.
    pub share: f64,
}

/// The forces (N) of springs of the `stiffness` (N/m) under `weights`, one an unknown (N, and for a tilt N times its unit of length). The search begins at `start`,
/// best where all springs push. None where they do not come to rest.
pub fn forces(springs: &[Spring], weights: &[f64], start: Vec<f64>, stiffness: f64) -> Option<Vec<f64>> {
    let mut u = start;
    let mut k = SOFTEST.min(stiffness);
    loop {
        rest(springs, weights, k, &mut u)?;
        if k >= stiffness {
            return Some(springs.iter().map(|s| k * s.share * s.overlap(&u)).collect());
        }
        k = (10.0 * k).min(stiffness);
    }
}

impl Spring {
    fn overlap(&self, u: &[f64]) -> f64 {
        (-self.acts.iter().fold(self.gap, |sum, &(i, factor)| sum + factor * u[i])).max(0.0)
    }
}

/// How the energy changes along `step` away from `u`, J: a sum of forces, which tells a minimum from what is beside it where energies do not differ any more.
fn slope(springs: &[Spring], weights: &[f64], k: f64, u: &[f64], step: &[f64]) -> f64 {
    let falls: f64 = weights.iter().zip(step).map(|(w, s)| w * s).sum();
    let shortens = |s: &Spring| s.acts.iter().map(|&(i, factor)| factor * step[i]).sum::<f64>();
    springs.iter().fold(falls, |sum, s| sum - k * s.share * s.overlap(u) * shortens(s))
}

/// Takes `u` to the least energy at stiffness `k`.
fn rest(springs: &[Spring], weights: &[f64], k: f64, u: &mut [f64]) -> Option<()> {
    let n = weights.len();
    let load = weights.iter().map(|w| w.abs()).fold(0.0, f64::max);
    for _ in 0..STEPS {
        let mut gradient = weights.to_vec();
        let mut matrix = vec![0.0; n * n];
        for spring in springs {
            let overlap = spring.overlap(u);
            if overlap <= 0.0 {
                continue;
            }
            let stiffness = k * spring.share;
            for &(i, fi) in &spring.acts {
                gradient[i] -= stiffness * overlap * fi;
                for &(j, fj) in &spring.acts {
                    matrix[i * n + j] += stiffness * fi * fj;
                }
            }
        }
        if gradient.iter().all(|g| g.abs() < BALANCED * load) {
            return Some(());
        }
        (0..n).for_each(|i| matrix[i * n + i] += HELD * k);
        let step = solve(matrix, gradient)?;
        let step: Vec<f64> = step.iter().map(|s| -s).collect();
        let at = |share: f64| u.iter().zip(&step).map(|(u, s)| u + share * s).collect::<Vec<_>>();
        // E is convex: where it still falls after the whole step that is taken, else the search closes in on the place from which it rises
        let steep = -slope(springs, weights, k, u, &step);
        let (mut low, mut share, mut high) = (0.0, 1.0, 1.0);
        let next = loop {
            let next = at(share);
            let rises = slope(springs, weights, k, &next, &step);
            if rises.abs() <= STEEP * steep || (share == 1.0 && rises < 0.0) || high - low < 1e-9 {
                break next;
            }
            if rises > 0.0 {
                high = share
            } else {
                low = share
            }
            share = 0.5 * (low + high);
        };
        u.copy_from_slice(&next);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A weight on three springs of which one is too short: two carry it by their shares, and the third as well once the weight is great enough.
    #[test]
    fn only_springs_that_are_reached_push() {
        let spring = |gap, share| Spring { acts: vec![(0, 1.0)], gap, share };
        let forces =
            forces(&[spring(0.0, 1.0), spring(0.0, 3.0), spring(1e-4, 1.0)], &[2.0], vec![-1e-3], RIGID).unwrap();
        for (force, expected) in forces.into_iter().zip([0.5, 1.5, 0.0]) {
            assert!((force - expected).abs() < 1e-6, "{force} instead of {expected} N");
        }
    }

    #[test]
    fn what_nothing_holds_does_not_rest() {
        let spring = Spring { acts: vec![(0, 1.0)], gap: 0.0, share: 1.0 };
        assert!(forces(&[spring], &[1.0, 1.0], vec![0.0; 2], RIGID).is_none());
    }
}
