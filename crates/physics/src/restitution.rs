//! Restitution: damping of contacts, and the part of their force that is left as bodies part.
//!
//! Down to a restitution of 0.43 the damping decides. Below that it would shorten the substep, so
//! the springs of bodies that part give back only a part of their force.

/// Range of damping ratios. The upper end bounds the substep.
const DAMPING_RANGE: (f64, f64) = (0.02, 0.45);
/// Smallest damping ratio for which the substep is chosen: contacts with less are integrated by the
/// same, or their impacts would scatter more.
pub const STEP_DAMPING: f64 = 0.25;
/// Substep over the inverse angular frequency of a nominal block that hits the floor flat.
const SUBSTEP: f64 = 0.48;

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

/// Coefficients of restitution that contacts can have, the smallest and the largest.
pub fn restitution_range() -> (f64, f64) {
    (0.0, restitution(DAMPING_RANGE.0))
}

/// Damping of contacts, and what is left of their force where bodies part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Damping ratio.
    pub zeta: f64,
    /// Part of the force of the springs that is left where bodies part.
    pub recovery: f64,
    /// Part of the damping that holds parting bodies back. Without it the substep in which they
    /// turn gives them a sixth of their speed.
    pub adhesion: f64,
}

impl Impact {
    /// Impact with a coefficient of restitution, or the nearest that contacts can have.
    pub fn new(e: f64) -> Self {
        let (low, high) = DAMPING_RANGE;
        let damped = |zeta| Self { zeta, recovery: 1.0, adhesion: 0.0 };
        if e >= restitution(high) {
            let zeta = bisect(|zeta| restitution(zeta) > e, DAMPING_RANGE);
            return damped(if e >= restitution(low) { low } else { zeta });
        }
        let parting = |recovery| Self { recovery, ..damped(high) };
        if e >= parting(0.0).mean_restitution() {
            return parting(bisect(|recovery| parting(recovery).mean_restitution() < e, (0.0, 1.0)));
        }
        let adhesive = |adhesion| Self { adhesion, ..parting(0.0) };
        adhesive(bisect(|adhesion| adhesive(adhesion).mean_restitution() > e, (0.0, 1.0)))
    }

    /// Returns true if springs keep all of their force where bodies part.
    pub fn recovers(&self) -> bool {
        self.recovery == 1.0
    }

    /// Mean restitution of impacts in substeps, over the phases at which they begin.
    fn mean_restitution(&self) -> f64 {
        const PHASES: u32 = 16;
        (0..PHASES).map(|phase| self.bounce(f64::from(phase) / f64::from(PHASES))).sum::<f64>() / f64::from(PHASES)
    }

    /// Restitution of a flat impact in substeps that begins at a phase of one, as the inner loop
    /// integrates it.
    fn bounce(&self, phase: f64) -> f64 {
        let damping = self.zeta * std::f64::consts::SQRT_2 * SUBSTEP;
        let (mut gap, mut v) = (phase * SUBSTEP, -SUBSTEP);
        for _ in 0..200 {
            gap += v;
            if gap >= 0.0 && v >= 0.0 {
                break;
            }
            let spring = SUBSTEP * SUBSTEP * gap.min(0.0);
            let force = if gap >= 0.0 {
                0.0
            } else if v > 0.0 {
                let held = self.recovery * spring + damping * v;
                if held > 0.0 { self.adhesion * held } else { held }
            } else {
                (spring + damping * v).min(0.0)
            };
            v -= force;
        }
        v / SUBSTEP
    }
}

/// Number in a range up to which a condition holds.
fn bisect(holds: impl Fn(f64) -> bool, (mut low, mut high): (f64, f64)) -> f64 {
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
