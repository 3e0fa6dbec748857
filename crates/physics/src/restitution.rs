//! Coefficient of restitution of the contact law, in closed form.

/// Range of damping ratios in which the step is stable with heavy neighbours.
const DAMPING_RANGE: (f64, f64) = (0.25, 0.45);

/// Coefficient of restitution of a flat impact at damping ratio `zeta`.
///
/// A spring and a damper without tension: e = exp(-(b/w) (pi - atan(2 b w / (w² - b²)))), Schwager
/// and Pöschel, Granular Matter 9 (2007) 465. The Maxwell element cannot relax during an impact and
/// doubles the stiffness, hence b = zeta / sqrt 2.
pub fn restitution(zeta: f64) -> f64 {
    let b = zeta / std::f64::consts::SQRT_2;
    let w = (1.0 - b * b).sqrt();
    libm::exp(-b / w * (std::f64::consts::PI - libm::atan(2.0 * b * w / (w * w - b * b))))
}

/// Minimum and maximum coefficient of restitution that the contact law can have.
pub fn restitution_range() -> (f64, f64) {
    (restitution(DAMPING_RANGE.1), restitution(DAMPING_RANGE.0))
}

/// Damping ratio of a coefficient of restitution, clamped to those of stable damping ratios: 0.43
/// to 0.61.
pub fn damping_ratio(e: f64) -> f64 {
    let (mut low, mut high) = DAMPING_RANGE;
    if e >= restitution(low) {
        return low;
    }
    if e <= restitution(high) {
        return high;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if restitution(middle) > e { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
