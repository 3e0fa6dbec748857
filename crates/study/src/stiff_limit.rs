//! Forces of springs between rigid blocks in the limit of high stiffness.
//!
//! Rigid blocks that lie flat on each other can share a load between the corners of a patch in many
//! distributions. Springs of a given stiffness per area have one solution, the minimum of
//!
//! ```text
//! E(u) = sum w u + 1/2 sum k_i max(0, -(gap_i + a_i u))^2
//! ```
//!
//! over heights and small tilts u. As k grows, their forces converge to the optimal solution of the
//! linear programme that minimises sum N_i^2 / k_i. E is convex and piecewise quadratic, so
//! Newton's method with a line search ends after a few steps; the stiffness grows tenfold from one
//! minimisation to the next.

use crate::cholesky::solve;

/// Stiffness of the first minimisation, N/m.
const MIN_STIFFNESS: f64 = 1e4;
/// Stiffness that stands for rigid contacts, N/m: a force of 1 N overlaps by 1 nm, and heights
/// differ by 0.1 mm.
pub const RIGID: f64 = 1e9;
/// Largest number of Newton steps at one stiffness.
const MAX_STEPS: usize = 200;
/// Stiffness of the regularisation over that of the springs: unknowns without a spring keep a step.
const REGULARISATION: f64 = 1e-6;
/// Slope at the end of a line search over that at its start.
const SLOPE_RATIO: f64 = 0.1;
/// Unbalanced force over the largest weight at a minimum: well above the rounding of the stiffest
/// springs.
const TOLERANCE: f64 = 1e-7;

/// Spring between unknowns. Its length is `gap` plus the sum of factors times unknowns, m; it
/// pushes where that is negative.
pub struct Spring {
    /// Unknowns with their factors.
    pub coefficients: Vec<(usize, f64)>,
    /// Length without displacement, m.
    pub gap: f64,
    /// Stiffness over that of the search.
    pub share: f64,
}

/// Returns the forces (N) of springs of the `stiffness` (N/m) under `weights`, one for each unknown
/// (N, and for a tilt N times its unit of length); none where the search does not converge. It
/// begins at `start`, best where all springs push.
pub fn forces(springs: &[Spring], weights: &[f64], start: Vec<f64>, stiffness: f64) -> Option<Vec<f64>> {
    let mut u = start;
    let mut k = MIN_STIFFNESS.min(stiffness);
    loop {
        Energy { springs, weights, k }.minimize(&mut u)?;
        if k >= stiffness {
            return Some(springs.iter().map(|s| k * s.share * s.overlap(&u)).collect());
        }
        k = (10.0 * k).min(stiffness);
    }
}

impl Spring {
    /// Overlap at `u`, m.
    fn overlap(&self, u: &[f64]) -> f64 {
        (-self.coefficients.iter().fold(self.gap, |sum, &(i, factor)| sum + factor * u[i])).max(0.0)
    }
}

/// Energy E(u) at the stiffness `k` (N/m).
struct Energy<'a> {
    springs: &'a [Spring],
    weights: &'a [f64],
    k: f64,
}

impl Energy<'_> {
    /// Derivative of the energy along `step` at `u`, J. A sum of forces resolves a minimum where
    /// energies no longer differ by rounding.
    fn slope(&self, u: &[f64], step: &[f64]) -> f64 {
        let weights: f64 = self.weights.iter().zip(step).map(|(w, s)| w * s).sum();
        let lengthening = |s: &Spring| s.coefficients.iter().map(|&(i, factor)| factor * step[i]).sum::<f64>();
        self.springs.iter().fold(weights, |sum, s| sum - self.k * s.share * s.overlap(u) * lengthening(s))
    }

    /// Gradient and matrix of second derivatives at `u`.
    fn derivatives(&self, u: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.weights.len();
        let mut gradient = self.weights.to_vec();
        let mut matrix = vec![0.0; n * n];
        for spring in self.springs {
            let overlap = spring.overlap(u);
            if overlap <= 0.0 {
                continue;
            }
            let stiffness = self.k * spring.share;
            for &(i, fi) in &spring.coefficients {
                gradient[i] -= stiffness * overlap * fi;
                for &(j, fj) in &spring.coefficients {
                    matrix[i * n + j] += stiffness * fi * fj;
                }
            }
        }
        (gradient, matrix)
    }

    /// Moves `u` to the minimum; none where Newton's method does not converge.
    fn minimize(&self, u: &mut [f64]) -> Option<()> {
        let n = self.weights.len();
        let load = self.weights.iter().map(|w| w.abs()).fold(0.0, f64::max);
        for _ in 0..MAX_STEPS {
            let (gradient, mut matrix) = self.derivatives(u);
            if gradient.iter().all(|g| g.abs() < TOLERANCE * load) {
                return Some(());
            }
            (0..n).for_each(|i| matrix[i * n + i] += REGULARISATION * self.k);
            let step = solve(matrix, gradient)?;
            let step: Vec<f64> = step.iter().map(|s| -s).collect();
            u.copy_from_slice(&self.line_search(u, &step));
        }
        None
    }

    /// Point along `step` where the slope is nearly zero. E is convex: the whole step is taken
    /// where E still falls at its end, else bisection finds the zero.
    fn line_search(&self, u: &[f64], step: &[f64]) -> Vec<f64> {
        let at = |share: f64| u.iter().zip(step).map(|(u, s)| u + share * s).collect::<Vec<_>>();
        let initial = -self.slope(u, step);
        let (mut low, mut share, mut high) = (0.0, 1.0, 1.0);
        loop {
            let next = at(share);
            let slope = self.slope(&next, step);
            if slope.abs() <= SLOPE_RATIO * initial || (share == 1.0 && slope < 0.0) || high - low < 1e-9 {
                return next;
            }
            if slope > 0.0 {
                high = share
            } else {
                low = share
            }
            share = 0.5 * (low + high);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spring of three under a weight is too short: the others carry it by their shares.
    #[test]
    fn springs_that_are_not_reached_have_no_force() {
        let spring = |gap, share| Spring { coefficients: vec![(0, 1.0)], gap, share };
        let forces =
            forces(&[spring(0.0, 1.0), spring(0.0, 3.0), spring(1e-4, 1.0)], &[2.0], vec![-1e-3], RIGID).unwrap();
        for (force, expected) in forces.into_iter().zip([0.5, 1.5, 0.0]) {
            assert!((force - expected).abs() < 1e-6, "{force} instead of {expected} N");
        }
    }

    #[test]
    fn an_unknown_without_a_spring_has_no_minimum() {
        let spring = Spring { coefficients: vec![(0, 1.0)], gap: 0.0, share: 1.0 };
        assert!(forces(&[spring], &[1.0, 1.0], vec![0.0; 2], RIGID).is_none());
    }
}
