//! Symmetric positive definite systems of linear equations.

/// Returns the solution of a symmetric positive definite system, by a Cholesky factorisation in
/// place; none where the matrix is not positive definite. The matrix is dense, row by row.
pub fn solve(mut matrix: Vec<f64>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for j in 0..n {
        let (done, rest) = matrix.split_at_mut((j + 1) * n);
        let pivot_row = &mut done[j * n..];
        let square = pivot_row[j] - pivot_row[..j].iter().map(|x| x * x).sum::<f64>();
        if square.is_nan() || square <= 0.0 {
            return None;
        }
        let pivot = square.sqrt();
        pivot_row[j] = pivot;
        for row in rest.chunks_exact_mut(n) {
            let sum: f64 = row[..j].iter().zip(&pivot_row[..j]).map(|(a, b)| a * b).sum();
            row[j] = (row[j] - sum) / pivot;
        }
    }
    for i in 0..n {
        let sum: f64 = (0..i).map(|j| matrix[i * n + j] * right[j]).sum();
        right[i] = (right[i] - sum) / matrix[i * n + i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|j| matrix[j * n + i] * right[j]).sum();
        right[i] = (right[i] - sum) / matrix[i * n + i];
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_positive_definite_system_is_solved_and_another_is_not() {
        let x = solve(vec![4.0, 2.0, 0.0, 2.0, 5.0, 1.0, 0.0, 1.0, 3.0], vec![8.0, 15.0, 11.0]).unwrap();
        for (x, expected) in x.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - expected).abs() < 1e-12);
        }
        assert!(solve(vec![1.0, 2.0, 2.0, 1.0], vec![1.0, 1.0]).is_none());
    }
}
