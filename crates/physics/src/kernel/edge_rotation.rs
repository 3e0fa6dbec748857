//! Common rotation of the three edges of a block of particles.

use crate::constants::MIN_STRETCH;
use crate::kernel::vector::{cross, dot, into_frame, out_of_frame};
use crate::simd::lanes::Lanes;

/// Inertia of the edges of a strained block: J = Σ |e|² 1 - e eᵀ, which is symmetric.
#[derive(Debug, Clone, Copy)]
pub struct EdgeInertia<L> {
    /// Cofactors of J along its diagonal, and off it: yz, zx, xy; over the determinant.
    diagonal: [L; 3],
    crossed: [L; 3],
}

impl<L: Lanes> EdgeInertia<L> {
    /// Inertia of edges. That of a block that is crushed to a line has no inverse: its determinant
    /// counts as a part of that at rest.
    #[inline(always)]
    pub fn new(edge: &[[L; 3]; 3], rest: &[[L; 3]; 3]) -> Self {
        let of = |e: &[[L; 3]; 3], i: usize, j: usize| e[0][i] * e[0][j] + e[1][i] * e[1][j] + e[2][i] * e[2][j];
        let [x, y, z] = [of(edge, 0, 0), of(edge, 1, 1), of(edge, 2, 2)];
        let (xx, yy, zz) = (y + z, z + x, x + y);
        let [yz, zx, xy] = [of(edge, 1, 2), of(edge, 2, 0), of(edge, 0, 1)];
        let diagonal = [yy * zz - yz * yz, zz * xx - zx * zx, xx * yy - xy * xy];
        let crossed = [zx * xy + yz * xx, xy * yz + zx * yy, yz * zx + xy * zz];
        let determinant = xx * diagonal[0] - xy * crossed[2] - zx * crossed[1];
        let [x, y, z] = [dot(&rest[0], &rest[0]), dot(&rest[1], &rest[1]), dot(&rest[2], &rest[2])];
        let min = (y + z) * (z + x) * (x + y) * L::splat_f64(MIN_STRETCH.x * MIN_STRETCH.x * MIN_STRETCH.x);
        let inv = L::splat_f64(1.0) / L::select(determinant.less_than(min), min, determinant);
        Self { diagonal: diagonal.map(|c| c * inv), crossed: crossed.map(|c| c * inv) }
    }

    /// Common rotation β of changes x of the edges e, which solves Σ e × x = Σ e × (β × e).
    #[inline(always)]
    pub fn common_rotation(&self, edge: &[[L; 3]; 3], change: &[[L; 3]; 3]) -> [L; 3] {
        let [x, y, z] = torque_of(edge, change);
        let ([xx, yy, zz], [yz, zx, xy]) = (self.diagonal, self.crossed);
        [xx * x + xy * y + zx * z, xy * x + yy * y + yz * z, zx * x + yz * y + zz * z]
    }
}

/// Σ e × x of changes x of the edges e.
#[inline(always)]
fn torque_of<L: Lanes>(edge: &[[L; 3]; 3], change: &[[L; 3]; 3]) -> [L; 3] {
    let (x, y, z) = (cross(&edge[0], &change[0]), cross(&edge[1], &change[1]), cross(&edge[2], &change[2]));
    [x[0] + y[0] + z[0], x[1] + y[1] + z[1], x[2] + y[2] + z[2]]
}

/// Common rotation of changes of edges that are at right angles, see
/// [`EdgeInertia::common_rotation`]; `inv` is 1 / (|e_k|² Σ |e_j|²) with the sum over the two other
/// edges.
#[inline(always)]
pub fn common_rotation<L: Lanes>(edge: &[[L; 3]; 3], inv: &[L; 3], change: &[[L; 3]; 3]) -> [L; 3] {
    let [x, y, z] = into_frame(edge, &torque_of(edge, change));
    out_of_frame(edge, &[x * inv[0], y * inv[1], z * inv[2]])
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::simd::portable::Plain;

    type Scalar = Plain<f64>;

    fn lanes(m: DMat3) -> [[Scalar; 3]; 3] {
        [m.x_axis, m.y_axis, m.z_axis].map(|v| v.to_array().map(Scalar::splat))
    }

    fn vector(x: [Scalar; 3]) -> DVec3 {
        DVec3::from_array(x.map(Lanes::first))
    }

    fn torque(edges: DMat3, change: DMat3) -> DVec3 {
        (0..3).map(|k| edges.col(k).cross(change.col(k))).sum()
    }

    fn rotated(edges: DMat3, rotation: DVec3) -> DMat3 {
        let of = |k| rotation.cross(edges.col(k));
        DMat3::from_cols(of(0), of(1), of(2))
    }

    proptest! {
        /// A rotation is found whatever the strain, and what remains of any change has no torque.
        #[test]
        fn edges_at_any_angle_have_the_rotation_that_leaves_no_torque(
            lengths in prop::array::uniform3(0.01..0.5f64),
            shear in prop::array::uniform9(-0.2..0.2f64),
            change in prop::array::uniform9(-1.0..1.0f64),
            rotation in prop::array::uniform3(-80.0..80.0f64),
        ) {
            let rest = DMat3::from_diagonal(lengths.into());
            let edges = (DMat3::IDENTITY + DMat3::from_cols_array(&shear)) * rest;
            let inertia = EdgeInertia::new(&lanes(edges), &lanes(rest));
            let rotation = DVec3::from_array(rotation);
            let found = vector(inertia.common_rotation(&lanes(edges), &lanes(rotated(edges, rotation))));
            prop_assert!((found - rotation).length() < 1e-9 * rotation.length(), "{found} of {rotation}");
            let change = DMat3::from_cols_array(&change);
            let found = vector(inertia.common_rotation(&lanes(edges), &lanes(change)));
            let left = torque(edges, rotated(edges, found)) - torque(edges, change);
            prop_assert!(left.length() < 1e-9, "{found}");
            // Both forms agree where nothing is strained.
            let square = |k: usize| lengths[k % 3] * lengths[k % 3];
            let inv = [0, 1, 2].map(|k| Scalar::splat(1.0 / (square(k) * (square(k + 1) + square(k + 2)))));
            let found = vector(EdgeInertia::new(&lanes(rest), &lanes(rest)).common_rotation(&lanes(rest), &lanes(change)));
            let other = vector(common_rotation(&lanes(rest), &inv, &lanes(change)));
            prop_assert!((found - other).length() < 1e-9 * (1.0 + other.length()), "{found} {other}");
        }
    }
}
