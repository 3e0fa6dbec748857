//! Affine part of vectors at the particles of a block, and its rotation.

use glam::{DMat3, DQuat, DVec3};

use crate::body::rotated;

/// Particles of a block.
pub const PARTICLES: usize = 8;
/// Iterations of [`nearest_rotation`]. Each multiplies the error by about the strain. The result
/// need not be exact, for the particles keep their positions whatever the pose.
const FIT_ITERATIONS: usize = 4;

/// Sign of particle `i` along axis `k`.
#[inline(always)]
pub const fn sign(i: usize, k: usize) -> f64 {
    if i >> k & 1 == 1 { 1.0 } else { -1.0 }
}

/// Rest position of particle `i` in the body's frame, m; `half` are the distances of the particles
/// from the centre.
pub fn rest_position(half: DVec3, i: usize) -> DVec3 {
    half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2))
}

/// Gradient of the affine part of vectors at the particles: their change along each axis, as
/// columns.
pub fn gradient(x: &[DVec3; PARTICLES], half: DVec3) -> DMat3 {
    let mut columns = [DVec3::ZERO; 3];
    for (i, x) in x.iter().enumerate() {
        for (k, column) in columns.iter_mut().enumerate() {
            *column += *x * sign(i, k);
        }
    }
    let [x, y, z] = columns;
    DMat3::from_cols(x / (8.0 * half.x), y / (8.0 * half.y), z / (8.0 * half.z))
}

/// Mean of vectors at the particles.
pub fn mean(x: &[DVec3; PARTICLES]) -> DVec3 {
    x.iter().sum::<DVec3>() / PARTICLES as f64
}

/// Rotation nearest to `f`, iterated from a rotation that is already near.
///
/// After Müller, Bender, Chentanez and Macklin, A robust method to extract the rotational part of
/// deformations (2016), with a step that is exact where nothing is strained.
pub fn nearest_rotation(f: DMat3, start: DQuat) -> DQuat {
    let mut q = start;
    for _ in 0..FIT_ITERATIONS {
        let r = DMat3::from_quat(q);
        let cross = r.x_axis.cross(f.x_axis) + r.y_axis.cross(f.y_axis) + r.z_axis.cross(f.z_axis);
        let along = r.x_axis.dot(f.x_axis) + r.y_axis.dot(f.y_axis) + r.z_axis.dot(f.z_axis);
        // A block crushed to nothing has no rotation: the bound keeps the step finite.
        q = rotated(q, cross * (1.5 / along.abs().max(0.5)));
    }
    q
}

/// Moment M = Σ f ⊗ l of the forces by which a torque (N m) rotates a block as a whole: each
/// particle gets the acceleration of a rigid rotation. `edges` join the particles along the block's
/// axes, in the world, m.
pub fn torque_moment(torque: DVec3, edges: &[DVec3; 3]) -> DMat3 {
    let squares = edges.map(|e| e.length_squared());
    let total: f64 = squares.iter().sum();
    let rotation: DVec3 = (0..3).map(|k| edges[k] * (edges[k].dot(torque) / (squares[k] * (total - squares[k])))).sum();
    edges.iter().map(|&e| outer(rotation.cross(e), e)).fold(DMat3::ZERO, |sum, m| sum + m)
}

/// Outer product a ⊗ b.
pub fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
