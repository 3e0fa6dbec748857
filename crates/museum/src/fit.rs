//! The pose of a block of eight particles: the rigid motion that brings its corners nearest to them.

use glam::{DMat3, DQuat, DVec3};

/// Particles of a block.
const CORNERS: usize = 8;
/// Rounds of Jacobi's method at most; it converges quadratically, and five are enough for a matrix of four rows.
const ROUNDS: usize = 12;

/// Centre (m) and turn for which Σ |at_i - centre - turn r_i|² is least, where r_i is the corner of a box with edges 2 `half` (m); bits 0, 1
/// and 2 of i say on which side it is.
///
/// The centre is the mean; the turn is the eigenvector of the greatest eigenvalue of a symmetric matrix of four rows (Horn, Closed-form
/// solution of absolute orientation using unit quaternions, 1987). It is a rotation even where the particles are inside out.
pub fn pose(at: &[DVec3; CORNERS], half: DVec3) -> (DVec3, DQuat) {
    let centre = at.iter().sum::<DVec3>() / CORNERS as f64;
    let mut s = DMat3::ZERO; // Σ (at_i - centre) r_i^T
    for (i, p) in at.iter().enumerate() {
        let r = corner(i, half);
        s += DMat3::from_cols((*p - centre) * r.x, (*p - centre) * r.y, (*p - centre) * r.z);
    }
    (centre, turn(s))
}

/// Corner `i` of a box about the origin.
pub fn corner(i: usize, half: DVec3) -> DVec3 {
    let side = |axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
    half * DVec3::new(side(0), side(1), side(2))
}

/// The rotation R for which the trace of Rᵀ S is greatest.
fn turn(s: DMat3) -> DQuat {
    let [x, y, z] = [s.x_axis, s.y_axis, s.z_axis];
    // Horn's N, for q = (w, x, y, z): qᵀ N q is the trace of Rᵀ S. His S_ab is the sum of r_a p_b, here column a, row b.
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

/// Makes a symmetric matrix diagonal by Jacobi's rotations, and gives its eigenvectors as columns.
fn diagonalise(a: &mut [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut v = [[0.0; 4]; 4];
    for (k, row) in v.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    let size = a.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    for _ in 0..ROUNDS {
        let mut changed = false;
        for p in 0..3 {
            for q in p + 1..4 {
                if a[p][q].abs() <= 1e-17 * size {
                    continue;
                }
                changed = true;
                // tan of the angle that makes a[p][q] zero, the smaller of the two.
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

    fn turns() -> impl Strategy<Value = DQuat> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64]
            .prop_filter("a direction", |q| q.iter().map(|x| x * x).sum::<f64>() > 0.01)
            .prop_map(|q| DQuat::from_array(q).normalize())
    }

    /// A block that has sheared in one plane has turned by atan2(b - c, a + d), where [[a, c], [b, d]] is Σ p rᵀ in that plane.
    #[test]
    fn shear_in_a_plane() {
        let shear = 0.3;
        let (_, q) = pose(&corners(|r| r + DVec3::new(shear * r.z, 0.0, 0.0)), HALF);
        // Σ p rᵀ has on its diagonal 8 hx² and 8 hz², and beside it 8 s hz²: a turn about y from z to x.
        let angle = DVec2::new(HALF.x * HALF.x + HALF.z * HALF.z, shear * HALF.z * HALF.z).to_angle();
        let expected = DQuat::from_rotation_y(angle);
        assert!(q.dot(expected).abs() > 1.0 - 1e-14, "{q} {expected}");
    }

    /// What is turned inside out still gets a rotation: the nearest to a reflection across the shortest axis is none at all.
    #[test]
    fn a_block_inside_out() {
        let (_, q) = pose(&corners(|r| DVec3::new(r.x, r.y, -r.z)), HALF);
        assert!(q.dot(DQuat::IDENTITY).abs() > 1.0 - 1e-14, "{q}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2_000) })]

        /// A block that has moved as a whole, whatever it is stretched by along its own axes, has that motion.
        #[test]
        fn rigid_motion_and_stretch(turn in turns(), centre in [-1.0..1.0, -1.0..1.0, 0.0..1.0f64], stretch in [0.5..2.0, 0.5..2.0, 0.5..2.0f64]) {
            let (centre, stretch) = (DVec3::from(centre), DVec3::from(stretch));
            let (found, q) = pose(&corners(|r| centre + turn * (stretch * r)), HALF);
            prop_assert!(found.distance(centre) < 1e-12);
            prop_assert!(q.dot(turn).abs() > 1.0 - 1e-12, "{} {}", q, turn);
        }

        /// Nothing near it fits better, however the particles lie.
        #[test]
        fn no_other_turn_fits_better(turn in turns(), off in prop::collection::vec([-0.01..0.01, -0.01..0.01, -0.01..0.01f64], 8), by in turns()) {
            let mut at = corners(|r| turn * r);
            for (p, off) in at.iter_mut().zip(off) {
                *p += DVec3::from(off);
            }
            let (centre, q) = pose(&at, HALF);
            let least = sum_of_squares(&at, centre, q);
            prop_assert!(least <= sum_of_squares(&at, centre, by) + 1e-15);
            let near = q * DQuat::IDENTITY.slerp(by, 1e-3);
            prop_assert!(least <= sum_of_squares(&at, centre, near) + 1e-15);
        }
    }
}
