//! Springs of a block, the fit of its pose, and the moment of a torque.

use glam::{DMat3, DQuat, DVec3};

use super::affine::{PARTICLES, nearest_rotation, rest_position, sign, torque_moment};
use super::springs::{SPRINGS, ends};

const HALF: DVec3 = DVec3::new(0.0234, 0.0077, 0.0052);

#[test]
fn each_pair_of_particles_has_a_spring() {
    let mut pairs: Vec<_> = (0..SPRINGS).map(ends).collect();
    assert_eq!((pairs[0], pairs[27]), ((0, 1, 1), (6, 7, 1)));
    assert!(pairs.iter().all(|&(i, j, kind)| i < j && j < PARTICLES && kind == i ^ j));
    pairs.dedup();
    assert_eq!(pairs.len(), SPRINGS);
    // As in the dissertation: 12 edges, 12 diagonals of faces, 4 of the block.
    let along = |n: u32| pairs.iter().filter(|p| p.2.count_ones() == n).count();
    assert_eq!([along(1), along(2), along(3)], [12, 12, 4]);
}

#[test]
fn a_pose_is_recovered_from_strained_particles() {
    let q = DQuat::from_axis_angle(DVec3::new(0.2, 0.7, -0.4).normalize(), 0.05);
    for strain in [0.0, 1e-4, 0.1, 0.4] {
        let s = DMat3::from_cols(
            DVec3::new(1.0 - strain, 0.2 * strain, 0.0),
            DVec3::new(0.2 * strain, 1.0 + 0.5 * strain, 0.1 * strain),
            DVec3::new(0.0, 0.1 * strain, 1.0 + strain),
        );
        let found = nearest_rotation(DMat3::from_quat(q) * s, DQuat::IDENTITY);
        let off = 2.0 * (found * q.conjugate()).xyz().length();
        assert!(off < 1e-12 + 0.05 * (strain * strain) * (strain * strain), "{off} rad at a strain of {strain}");
    }
}

#[test]
fn a_torque_rotates_a_block_and_strains_nothing() {
    let q = DQuat::from_axis_angle(DVec3::new(0.2, 0.7, -0.4).normalize(), 0.8);
    let axes = DMat3::from_quat(q);
    let edges = [axes.x_axis * (2.0 * HALF.x), axes.y_axis * (2.0 * HALF.y), axes.z_axis * (2.0 * HALF.z)];
    let torque = DVec3::new(1e-3, -2e-3, 5e-4);
    let m = torque_moment(torque, &edges);
    // Forces on the particles: f_i = Σ M a_k s_ik / (8 g_k).
    let force = |i: usize| (0..3).map(|k| m * axes.col(k) * (sign(i, k) / (8.0 * HALF[k]))).sum::<DVec3>();
    let total: DVec3 = (0..PARTICLES).map(|i| (axes * rest_position(HALF, i)).cross(force(i))).sum();
    assert!((total - torque).length() < 1e-15 * 1e3 * torque.length());
    // Each is the acceleration of its particle in one common rotation.
    let square = HALF * HALF;
    let moments = PARTICLES as f64 * DVec3::new(square.y + square.z, square.z + square.x, square.x + square.y);
    let rotation = crate::body::world_tensor(q, moments.recip()) * torque;
    for i in 0..PARTICLES {
        assert!((force(i) - rotation.cross(axes * rest_position(HALF, i))).length() < 1e-12 * force(i).length());
    }
}
