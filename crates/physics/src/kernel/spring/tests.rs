//! Spring law compared with that of the dissertation.

use glam::{DQuat, DVec3};

use super::spring;
use crate::lattice::affine::rest_position;
use crate::lattice::springs::{SPRINGS, ends};
use crate::simd::lanes::Lanes;
use crate::simd::portable::Plain;

type L = Plain<f64>;

fn splat3(x: DVec3) -> [L; 3] {
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

/// Force on the first of two particles by Eq. 4.1 to 4.3, along the spring: stiffness times
/// elongation plus damping times its rate.
fn reference_force(k: f64, c: f64, rest: f64, difference: DVec3, rate: DVec3) -> DVec3 {
    let length = difference.length();
    difference / length * (k * (length - rest) + c * rate.dot(difference) / length)
}

const HALF: DVec3 = DVec3::new(0.0234, 0.0077, 0.0052);

#[test]
fn a_spring_has_the_force_of_the_dissertation_to_first_order_of_its_strain() {
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
            let zero = splat3(DVec3::ZERO);
            let (force, now) = spring(
                [&zero, &splat3(difference - rest)],
                &splat3(rest),
                (L::splat(stiffness), L::splat(damping)),
                L::splat(strain_before),
            );
            let (force, now) = (vector(force), number(now));
            assert!((now - 0.5 * (difference.length_squared() - square)).abs() < 1e-17);
            let expected = reference_force(k, c, length, difference, rate);
            let scale = k * length * strain.abs() + c * rate.length();
            assert!(
                (force - expected).length() < 3.0 * (strain.abs() + rate.length() * h / length) * scale,
                "{force} for {expected}"
            );
        }
    }
}

/// The strain is exact for any rotation: a rotated body is not strained.
#[test]
fn rotation_strains_no_spring() {
    let q = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.2);
    for n in 0..SPRINGS {
        let (i, j, _) = ends(n);
        let rest = rest_position(HALF, j) - rest_position(HALF, i);
        let moved = |p: usize| q * rest_position(HALF, p) - rest_position(HALF, p);
        let one = L::splat(1.0);
        let (_, strain) = spring([&splat3(moved(i)), &splat3(moved(j))], &splat3(rest), (one, one), L::splat(0.0));
        assert!(number(strain).abs() < 1e-18, "{}", number(strain));
    }
}
