//! Dantzig's algorithm for the linear complementarity problem of resting contact (Eq. 2.13 to
//! 2.16), after Baraff's "Fast contact force computation for nonpenetrating rigid bodies" (1994).

/// Error of the solver.
///
/// ```
/// use teeter_dissertation::flat::lcp::{LcpError, solve};
///
/// assert_eq!(solve(&[vec![2.0]], &[-6.0]), Ok(vec![3.0]));
/// assert_eq!(solve(&[vec![0.0]], &[-1.0]), Err(LcpError::Unbounded(0)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum LcpError {
    /// Linearly dependent contacts, whose forces are undetermined.
    #[error("the matrix of the contacts that bear force is singular")]
    Singular,
    /// Contact whose acceleration no force can stop.
    #[error("no force stops the acceleration at contact {0}")]
    Unbounded(usize),
    /// Number of changes of contacts without a solution.
    #[error("no solution after {0} changes of contacts")]
    NoConvergence(usize),
}

/// Ratio to the largest entry of a row below which a number counts as zero.
const ZERO: f64 = 1e-12;

/// Returns forces f ≥ 0 such that a = A f + b ≥ 0 and f a = 0 for each element. `matrix` holds the
/// rows of A, symmetric and positive semi-definite.
///
/// # Errors
/// As listed at [`LcpError`].
pub fn solve(matrix: &[Vec<f64>], b: &[f64]) -> Result<Vec<f64>, LcpError> {
    let n = b.len();
    let (mut f, mut a) = (vec![0.0; n], b.to_vec());
    let scale = b.iter().fold(0.0f64, |max, x| max.max(x.abs()));
    // Clamped contacts have a force and no acceleration; free ones have no force.
    let (mut clamped, mut free): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for d in 0..n {
        // Increase f[d] until a[d] is zero while the conditions of the other contacts hold.
        let mut changes = 0;
        while a[d] < -ZERO * scale {
            changes += 1;
            if changes > 10 * n + 10 {
                return Err(LcpError::NoConvergence(changes));
            }
            let delta = direction(matrix, &clamped, d)?;
            let da: Vec<f64> = (0..n).map(|i| delta.iter().map(|&(j, df)| matrix[i][j] * df).sum()).collect();
            let (mut step, mut first) =
                if da[d] > ZERO * matrix[d][d] { (-a[d] / da[d], d) } else { (f64::INFINITY, d) };
            for &(i, df) in delta.iter().filter(|(i, df)| *i != d && *df < 0.0) {
                if -f[i] / df < step {
                    (step, first) = (-f[i] / df, i);
                }
            }
            for &i in free.iter().filter(|i| da[**i] < 0.0) {
                if -a[i] / da[i] < step {
                    (step, first) = (-a[i] / da[i], i);
                }
            }
            if step == f64::INFINITY {
                return Err(LcpError::Unbounded(d));
            }
            for &(i, df) in &delta {
                f[i] += step * df;
            }
            for (a, da) in a.iter_mut().zip(&da) {
                *a += step * da;
            }
            if first == d {
                a[d] = 0.0;
                break;
            }
            if let Some(index) = clamped.iter().position(|i| *i == first) {
                clamped.remove(index);
                f[first] = 0.0;
                free.push(first);
            } else {
                free.retain(|i| *i != first);
                a[first] = 0.0;
                clamped.push(first);
            }
        }
        if f[d] > 0.0 { clamped.push(d) } else { free.push(d) }
    }
    Ok(f)
}

/// Returns the changes of all forces when that of `d` grows by one and the accelerations of the
/// clamped contacts stay zero.
fn direction(matrix: &[Vec<f64>], clamped: &[usize], d: usize) -> Result<Vec<(usize, f64)>, LcpError> {
    let m = clamped.len();
    let mut rows: Vec<Vec<f64>> =
        clamped.iter().map(|&i| clamped.iter().map(|&j| matrix[i][j]).chain([-matrix[i][d]]).collect()).collect();
    // Gaussian elimination with partial pivoting.
    for k in 0..m {
        let pivot = (k..m).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).unwrap_or(k);
        rows.swap(k, pivot);
        if rows[k][k].abs() <= ZERO * matrix[clamped[k]][clamped[k]] {
            return Err(LcpError::Singular);
        }
        for i in k + 1..m {
            let factor = rows[i][k] / rows[k][k];
            let (above, below) = rows.split_at_mut(i);
            for (entry, pivot) in below[0].iter_mut().zip(&above[k]).skip(k) {
                *entry -= factor * pivot;
            }
        }
    }
    let mut solution = vec![0.0; m];
    for k in (0..m).rev() {
        let rest: f64 = (k + 1..m).map(|j| rows[k][j] * solution[j]).sum();
        solution[k] = (rows[k][m] - rest) / rows[k][k];
    }
    Ok(clamped.iter().copied().zip(solution).chain([(d, 1.0)]).collect())
}
