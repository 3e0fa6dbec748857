//! Force law of the springs within a block.

#[cfg(test)]
mod tests;

use crate::simd::lanes::Lanes;

/// Force and strain of the spring between two particles with displacements `a` and `b` (m), whose
/// rest positions are `rest` (m) apart. Returns the force on the first particle and the strain
/// (m²), which the next substep passes as `before`.
///
/// The strain is (L² − L₀²) / 2 = (rest + d / 2) · d with d = b − a: it needs no root, has no
/// cancellation and is exact for any rotation. The force acts along the spring and is its length
/// times (stiffness · strain − damping · before).
///
/// With stiffness k (1 + β) / L₀², damping k β / L₀² and β = c / (k h), the force equals Eq. 4.1 to
/// 4.3 of the dissertation to first order of the strain.
#[inline(always)]
pub fn spring<L: Lanes>([a, b]: [&[L; 3]; 2], rest: &[L; 3], (stiffness, damping): (L, L), before: L) -> ([L; 3], L) {
    let half = L::splat_f64(0.5);
    let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let strain = (rest[0] + half * d[0]) * d[0] + (rest[1] + half * d[1]) * d[1] + (rest[2] + half * d[2]) * d[2];
    let tension = stiffness * strain - damping * before;
    ([(rest[0] + d[0]) * tension, (rest[1] + d[1]) * tension, (rest[2] + d[2]) * tension], strain)
}
