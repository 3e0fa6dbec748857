//! Rigid pose of a block of eight particles by least squares.

use glam::{DMat3, DQuat, DVec3};

/// Number of particles of a block.
const CORNERS: usize = 8;
/// Maximum number of sweeps of Jacobi's method. It converges quadratically; five suffice for four
/// rows.
const ROUNDS: usize = 12;

/// Returns the position (m) and orientation q of the box that minimise Σ |at_i - position - q
/// r_i|².
///
/// r_i is a corner of the box with edges 2 `half` (m); bits 0, 1 and 2 of i are its sides. The
/// position is the mean, and q the eigenvector of the largest eigenvalue of a symmetric matrix of
/// four rows (Horn, Closed-form solution of absolute orientation using unit quaternions, 1987). q
/// is a rotation even for mirrored particles.
pub fn pose(at: &[DVec3; CORNERS], half: DVec3) -> (DVec3, DQuat) {
    let centre = at.iter().sum::<DVec3>() / CORNERS as f64;
    let mut s = DMat3::ZERO; // Σ (at_i - centre) r_i^T
    for (i, p) in at.iter().enumerate() {
        let r = corner(i, half);
        s += DMat3::from_cols((*p - centre) * r.x, (*p - centre) * r.y, (*p - centre) * r.z);
    }
    (centre, rotation(s))
}

/// Corner `i` of a box about the origin, m.
pub fn corner(i: usize, half: DVec3) -> DVec3 {
    let side = |axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
    half * DVec3::new(side(0), side(1), side(2))
}

/// Returns the rotation R that maximises the trace of Rᵀ S.
fn rotation(s: DMat3) -> DQuat {
    let [x, y, z] = [s.x_axis, s.y_axis, s.z_axis];
    // Horn's N, for q = (w, x, y, z): qᵀ N q is the trace of Rᵀ S. His S_ab is the sum of r_a p_b,
    // here column a, row b.
    let mut n = [
        [x.x + y.y + z.z, y.z - z.y, z.x - x.z, x.y - y.x],
        [y.z - z.y, x.x - y.y - z.z, x.y + y.x, z.x + x.z],
        [z.x - x.z, x.y + y.x, -x.x + y.y - z.z, y.z + z.y],
        [x.y - y.x, z.x + x.z, y.z + z.y, -x.x - y.y + z.z],
    ];
    let vectors = diagonalise(&mut n);
    let best = (1..4).fold(0, |best, k| if n[k][k] > n[best][best] { k } else { best });
    let [w, x, y, z] = vectors.map(|row| row[best]);
    DQuat::from_xyzw(x, y, z, w).normalize()
}

/// Diagonalises a symmetric matrix by Jacobi rotations and returns its eigenvectors as columns.
fn diagonalise(a: &mut [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut v = [[0.0; 4]; 4];
    for (k, row) in v.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    let size = a.iter().flatten().fold(0.0, |max: f64, x| max.max(x.abs()));
    for _ in 0..ROUNDS {
        let mut changed = false;
        for p in 0..3 {
            for q in p + 1..4 {
                if a[p][q].abs() <= 1e-17 * size {
                    continue;
                }
                changed = true;
                // Tangent of the smaller angle that makes a[p][q] zero.
                let slope = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
                let t = if slope < 0.0 { -1.0 } else { 1.0 } / (slope.abs() + (slope * slope + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in a.iter_mut().chain(v.iter_mut()) {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                let (old_p, old_q) = (a[p], a[q]);
                a[p] = std::array::from_fn(|k| c * old_p[k] - s * old_q[k]);
                a[q] = std::array::from_fn(|k| s * old_p[k] + c * old_q[k]);
            }
        }
        if !changed {
            break;
        }
    }
    v
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;

    const HALF: DVec3 = DVec3::new(0.0405, 0.0134, 0.009);

    fn corners(map: impl Fn(DVec3) -> DVec3) -> [DVec3; 8] {
        std::array::from_fn(|i| map(corner(i, HALF)))
    }

    fn sum_of_squares(at: &[DVec3; 8], centre: DVec3, turn: DQuat) -> f64 {
        at.iter().enumerate().map(|(i, p)| p.distance_squared(centre + turn * corner(i, HALF))).sum()
    }

    fn orientations() -> impl Strategy<Value = DQuat> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64]
            .prop_filter("a direction", |q| q.iter().map(|x| x * x).sum::<f64>() > 0.01)
            .prop_map(|q| DQuat::from_array(q).normalize())
    }

    /// Shear in a plane rotates by atan2(b - c, a + d), where [[a, c], [b, d]] is Σ p rᵀ in that
    /// plane.
    #[test]
    fn shear_in_a_plane_rotates_by_its_closed_form() {
        let shear = 0.3;
        let (_, q) = pose(&corners(|r| r + DVec3::new(shear * r.z, 0.0, 0.0)), HALF);
        // The diagonal of Σ p rᵀ is 8 hx² and 8 hz², the off-diagonal term 8 s hz²: a rotation
        // about y.
        let angle = DVec2::new(HALF.x * HALF.x + HALF.z * HALF.z, shear * HALF.z * HALF.z).to_angle();
        let expected = DQuat::from_rotation_y(angle);
        assert!(q.dot(expected).abs() > 1.0 - 1e-14, "{q} {expected}");
    }

    /// The rotation nearest to a reflection across the shortest axis is the identity.
    #[test]
    fn a_mirrored_block_has_a_rotation() {
        let (_, q) = pose(&corners(|r| DVec3::new(r.x, r.y, -r.z)), HALF);
        assert!(q.dot(DQuat::IDENTITY).abs() > 1.0 - 1e-14, "{q}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2_000) })]

        /// Scaling along the axes of a block does not change its pose.
        #[test]
        fn scaling_keeps_the_rigid_motion(turn in orientations(), centre in [-1.0..1.0, -1.0..1.0, 0.0..1.0f64], stretch in [0.5..2.0, 0.5..2.0, 0.5..2.0f64]) {
            let (centre, stretch) = (DVec3::from(centre), DVec3::from(stretch));
            let (found, q) = pose(&corners(|r| centre + turn * (stretch * r)), HALF);
            prop_assert!(found.distance(centre) < 1e-12);
            prop_assert!(q.dot(turn).abs() > 1.0 - 1e-12, "{} {}", q, turn);
        }

        /// No other orientation has a smaller sum of squares, for any particles.
        #[test]
        fn no_other_orientation_fits_better(turn in orientations(), off in prop::collection::vec([-0.01..0.01, -0.01..0.01, -0.01..0.01f64], 8), by in orientations()) {
            let mut at = corners(|r| turn * r);
            for (p, off) in at.iter_mut().zip(off) {
                *p += DVec3::from(off);
            }
            let (centre, q) = pose(&at, HALF);
            let min = sum_of_squares(&at, centre, q);
            prop_assert!(min <= sum_of_squares(&at, centre, by) + 1e-15);
            let near = q * DQuat::IDENTITY.slerp(by, 1e-3);
            prop_assert!(min <= sum_of_squares(&at, centre, near) + 1e-15);
        }
    }
}
