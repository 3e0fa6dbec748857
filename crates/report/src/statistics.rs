//! Statistics of measured values.

/// Mean; 0 for no values.
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Maximum of values and 0.
pub fn max(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Minimum of values; infinite for no values.
pub fn min(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// `q`-quantile of sorted values, interpolated between neighbours; none for no values.
pub fn sorted_quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let x = q * (sorted.len().checked_sub(1)?) as f64;
    let i = x as usize;
    let next = sorted.get(i + 1).unwrap_or(&sorted[i]);
    Some(sorted[i] + (x - i as f64) * (next - sorted[i]))
}

/// `q`-quantile; 0 for no values.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted_quantile(&sorted, q).unwrap_or(0.0)
}

/// Pearson's correlation of pairs; 0 where one of the two is constant.
pub fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (mx, my) = (mean(&x), mean(&y));
    let sum = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|&(x, y)| f(x - mx, y - my)).sum::<f64>();
    let norm = (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt();
    if norm > 0.0 { sum(&|x, y| x * y) / norm } else { 0.0 }
}

/// Share of the items for which `predicate` is true, per cent; 0 for no items.
pub fn percent<T>(items: &[T], predicate: impl Fn(&T) -> bool) -> f64 {
    let count = items.iter().filter(|item| predicate(item)).count();
    if items.is_empty() { 0.0 } else { 100.0 * count as f64 / items.len() as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correlation_of_lines_is_one_and_of_noise_zero() {
        assert!((correlation(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]) - 1.0).abs() < 1e-12);
        assert!((correlation(&[(0.0, 2.0), (1.0, 0.0)]) + 1.0).abs() < 1e-12);
        assert_eq!(correlation(&[(0.0, 1.0), (1.0, -1.0), (2.0, 1.0), (1.0, 3.0)]), 0.0);
        assert_eq!(correlation(&[]), 0.0);
    }

    #[test]
    fn shares_and_extremes() {
        assert_eq!(percent(&[1, 2, 3, 4], |x| *x > 3), 25.0);
        assert_eq!(quantile(&[3.0, 1.0, 2.0], 0.5), 2.0);
        assert_eq!((mean(&[]), max(&[-1.0]), min(&[])), (0.0, 0.0, f64::INFINITY));
    }

    #[test]
    fn quantiles_lie_between_neighbours() {
        assert_eq!(sorted_quantile(&[], 0.5), None);
        assert_eq!(sorted_quantile(&[3.0], 0.95), Some(3.0));
        assert_eq!(sorted_quantile(&[1.0, 2.0, 4.0, 8.0], 0.5), Some(3.0));
        assert_eq!(sorted_quantile(&[0.0, 10.0], 0.95), Some(9.5));
    }
}
