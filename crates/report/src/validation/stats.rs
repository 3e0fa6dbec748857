//! Sums over measurements.

/// Mean; 0 of nothing.
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Largest; 0 of nothing.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The `q`-quantile; 0 of nothing.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    crate::score::quantile(&sorted, q).unwrap_or(0.0)
}

/// Pearson's correlation of pairs; 0 where there is none.
pub fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (mx, my) = (mean(&x), mean(&y));
    let sum = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|&(x, y)| f(x - mx, y - my)).sum::<f64>();
    let spread = (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt();
    if spread > 0.0 { sum(&|x, y| x * y) / spread } else { 0.0 }
}

/// Share of the items that are so, in per cent.
pub fn percent<T>(items: &[T], so: impl Fn(&T) -> bool) -> f64 {
    if items.is_empty() { 0.0 } else { 100.0 * items.iter().filter(|i| so(i)).count() as f64 / items.len() as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correlation_knows_lines_and_noise() {
        assert!((correlation(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]) - 1.0).abs() < 1e-12);
        assert!((correlation(&[(0.0, 2.0), (1.0, 0.0)]) + 1.0).abs() < 1e-12);
        assert_eq!(correlation(&[(0.0, 1.0), (1.0, -1.0), (2.0, 1.0), (1.0, 3.0)]), 0.0);
        assert_eq!(correlation(&[]), 0.0);
    }

    #[test]
    fn shares_and_quantiles() {
        assert_eq!(percent(&[1, 2, 3, 4], |x| *x > 3), 25.0);
        assert_eq!(quantile(&[3.0, 1.0, 2.0], 0.5), 2.0);
        assert_eq!((mean(&[]), largest(&[-1.0])), (0.0, 0.0));
    }
}
