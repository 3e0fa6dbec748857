//! The springs of a block against the plain law of the dissertation, and the fit of a pose.

use glam::{DMat3, DQuat, DVec3};

use super::springs::{SPRINGS, ends, spring};
use super::*;
use crate::simd::lanes::Lanes;
use crate::simd::portable::Plain;

type L = Plain<f64>;

fn lanes(x: DVec3) -> [L; 3] {
    [L::splat(x.x), L::splat(x.y), L::splat(x.z)]
}

fn number(x: L) -> f64 {
    let mut to = [0.0];
    x.store(&mut to, 0);
    to[0]
}

fn vector(x: [L; 3]) -> DVec3 {
    DVec3::new(number(x[0]), number(x[1]), number(x[2]))
}

/// Force on the first of two particles by Eq. 4.1 to 4.3: stiffness times what the spring is too long, less damping times the rate at which
/// it grows, along the spring.
fn plain(k: f64, c: f64, rest: f64, difference: DVec3, rate: DVec3) -> DVec3 {
    let length = difference.length();
    difference / length * (k * (length - rest) + c * rate.dot(difference) / length)
}

const HALF: DVec3 = DVec3::new(0.0234, 0.0077, 0.0052);

#[test]
fn each_pair_of_particles_has_a_spring() {
    let mut pairs: Vec<_> = (0..SPRINGS).map(ends).collect();
    assert_eq!((pairs[0], pairs[27]), ((0, 1, 1), (6, 7, 1)));
    assert!(pairs.iter().all(|&(i, j, kind)| i < j && j < PARTICLES && kind == i ^ j));
    pairs.dedup();
    assert_eq!(pairs.len(), SPRINGS);
    // as in the dissertation: 12 edges, 12 diagonals of faces, 4 of the block
    let along = |n: u32| pairs.iter().filter(|p| p.2.count_ones() == n).count();
    assert_eq!([along(1), along(2), along(3)], [12, 12, 4]);
}

#[test]
fn a_spring_pulls_as_the_dissertation_says_to_first_order_of_its_strain() {
    let (k, h) = (1e6, 1e-5);
    let c = 30.0;
    for (rest, turn) in
        [(DVec3::new(0.02, 0.0, 0.0), 0.0), (DVec3::new(0.01, -0.015, 0.01), 0.3), (DVec3::new(0.0, 0.02, 0.01), -2.0)]
    {
        for strain in [1e-6, -1e-5, 1e-4] {
            let q = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), turn);
            let difference = q * rest * (1.0 + strain);
            let rate = q * DVec3::new(1e-3, -2e-3, 3e-3);
            let (square, length) = (rest.length_squared(), rest.length());
            let before = difference - rate * h;
            let beta = c / (k * h);
            let (stiffness, damping) = (k * (1.0 + beta) / square, k * beta / square);
            let strain_before = 0.5 * (before.length_squared() - square);
            let zero = lanes(DVec3::ZERO);
            let (force, now) = spring(
                &zero,
                &lanes(difference - rest),
                &lanes(rest),
                L::splat(stiffness),
                L::splat(damping),
                L::splat(strain_before),
            );
            let (force, now) = (vector(force), number(now));
            assert!((now - 0.5 * (difference.length_squared() - square)).abs() < 1e-17);
            let expected = plain(k, c, length, difference, rate);
            let scale = k * length * strain.abs() + c * rate.length();
            assert!(
                (force - expected).length() < 3.0 * (strain.abs() + rate.length() * h / length) * scale,
                "{force} for {expected}"
            );
        }
    }
}

/// A body that only turns is not strained, however far: what springs feel is exact for any turn.
#[test]
fn turning_strains_no_spring() {
    let q = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.2);
    for n in 0..SPRINGS {
        let (i, j, _) = ends(n);
        let rest = place(HALF, j) - place(HALF, i);
        let moved = |p: usize| q * place(HALF, p) - place(HALF, p);
        let one = L::splat(1.0);
        let (_, strain) = spring(&lanes(moved(i)), &lanes(moved(j)), &lanes(rest), one, one, L::splat(0.0));
        assert!(number(strain).abs() < 1e-18, "{}", number(strain));
    }
}

#[test]
fn a_pose_is_found_again_from_strained_particles() {
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
fn a_torque_on_the_whole_turns_it_and_strains_nothing() {
    let q = DQuat::from_axis_angle(DVec3::new(0.2, 0.7, -0.4).normalize(), 0.8);
    let axes = DMat3::from_quat(q);
    let edges = [axes.x_axis * (2.0 * HALF.x), axes.y_axis * (2.0 * HALF.y), axes.z_axis * (2.0 * HALF.z)];
    let torque = DVec3::new(1e-3, -2e-3, 5e-4);
    let m = whole_moment(torque, &edges);
    // forces on the particles: f_i = Σ M a_k s_ik / (8 g_k)
    let force = |i: usize| (0..3).map(|k| m * axes.col(k) * (sign(i, k) / (8.0 * HALF[k]))).sum::<DVec3>();
    let total: DVec3 = (0..PARTICLES).map(|i| (axes * place(HALF, i)).cross(force(i))).sum();
    assert!((total - torque).length() < 1e-15 * 1e3 * torque.length());
    // each is across the place of its particle for one and the same turning
    let square = HALF * HALF;
    let moments = PARTICLES as f64 * DVec3::new(square.y + square.z, square.z + square.x, square.x + square.y);
    let turning = crate::body::world_tensor(q, moments.recip()) * torque;
    for i in 0..PARTICLES {
        assert!((force(i) - turning.cross(axes * place(HALF, i))).length() < 1e-12 * force(i).length());
    }
}
