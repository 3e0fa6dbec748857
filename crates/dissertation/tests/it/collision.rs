//! Collision response: momentum, restitution and energy.

use crate::common::{cases, vector};
use glam::DVec3;
use proptest::prelude::*;
use teeter_dissertation::jenga3d::contact::{Contact, Kind};
use teeter_dissertation::jenga3d::particle::{Particle, State};
use teeter_dissertation::jenga3d::point_face::weights;
use teeter_dissertation::jenga3d::response::{Law, Step, respond};
use teeter_dissertation::jenga3d::static_friction::Coefficients;

/// Contact of four particles with the weights of a point and a face, or of two edges.
fn contact(normal: DVec3, share: [f64; 2], edges: bool) -> Contact {
    let [s, t] = share;
    let weights = if edges { [1.0 - s, s, t - 1.0, -t] } else { [1.0, -s * t, -s * (1.0 - t), s - 1.0] };
    let kind = if edges { Kind::EdgeEdge(0, 1) } else { Kind::ParticleFace(0, 0) };
    Contact { kind, blocks: [0, 1], particles: [0, 1, 2, 3], weights, normal, normal_force: 0.0 }
}

fn energy(particles: &[Particle], states: &[State]) -> f64 {
    particles.iter().zip(states).map(|(p, s)| 0.5 * p.mass * s.velocity.length_squared()).sum()
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn an_impulse_conserves_momentum_and_adds_no_energy(
        masses in [0.1..10.0, 0.1..10.0, 0.1..10.0, 0.1..10.0f64], velocities in [vector(), vector(), vector(), vector()],
        share in [0.0..1.0, 0.0..1.0f64], edges: bool, normal in vector(), e in 0.0..=1.0f64, rough: bool,
    ) {
        prop_assume!(normal.length() > 0.1);
        let contact = contact(normal.normalize(), share, edges);
        let particles = masses.map(|mass| Particle { mass, block: 0 });
        let curr = [State::default(); 4];
        let mut next = curr;
        for (state, velocity) in next.iter_mut().zip(velocities) {
            state.velocity = velocity;
            state.position = velocity;
        }
        let before = next;
        let law = Law { restitution: e, friction: rough.then_some(Coefficients { static_friction: 0.5, kinetic_friction: 0.3 }) };
        let step = Step { particles: &particles, curr: &curr, next: &mut next };
        let impulse = respond(&contact, &law, step, |_| true);

        let momentum = |states: &[State]| particles.iter().zip(states).map(|(p, s)| p.mass * s.velocity).sum::<DVec3>();
        prop_assert!(momentum(&next).distance(momentum(&before)) < 1e-12);
        prop_assert!(energy(&particles, &next) <= energy(&particles, &before) * (1.0 + 1e-14));
        let along = |states: &[State]| contact.velocity(states).dot(contact.normal);
        let expected = if along(&before) < 0.0 { -e * along(&before) } else { along(&before) };
        prop_assert!((along(&next) - expected).abs() < 1e-12, "{} became {}", along(&before), along(&next));
        prop_assert!(impulse >= 0.0);
        // In flight, positions change as velocities do.
        for (state, start) in next.iter().zip(curr) {
            prop_assert!((state.position - start.position).distance(state.velocity) < 1e-12);
        }
    }

    /// The impulses on the two sides act at one point, so they have no moment.
    #[test]
    fn weights_reproduce_the_point(corners in [vector(), vector(), vector()], share in [0.0..1.0, 0.0..1.0f64]) {
        let [p1, p2, p3] = corners;
        let (s, t) = (share[0].min(share[1]), share[0].max(share[1]));
        prop_assume!((p2 - p1).cross(p3 - p1).length() > 0.01);
        let found = weights(p1 * s + p2 * (t - s) + p3 * (1.0 - t), p1, p2, p3);
        for (found, expected) in found.into_iter().zip([s, t - s, 1.0 - t]) {
            prop_assert!((found - expected).abs() < 1e-10);
        }
    }
}

/// Point that meets the middle of a face.
fn at_the_middle_of_a_face() -> Contact {
    let third = 1.0 / 3.0;
    Contact {
        kind: Kind::ParticleFace(0, 0),
        blocks: [0, 1],
        particles: [0, 1, 2, 3],
        weights: [1.0, -third, -third, -third],
        normal: DVec3::Z,
        normal_force: 0.0,
    }
}

/// Impulse on a point that meets the middle of a face, both of unit masses, at unit speed along z,
/// and its speed afterwards.
fn middle_of_a_face(restitution: f64) -> (f64, f64) {
    let contact = at_the_middle_of_a_face();
    let particles = [Particle { mass: 1.0, block: 0 }; 4];
    let curr = [State::default(); 4];
    let mut next = curr;
    next[0].velocity = -DVec3::Z;
    let law = Law { restitution, friction: None };
    let impulse = respond(&contact, &law, Step { particles: &particles, curr: &curr, next: &mut next }, |_| true);
    (impulse, contact.velocity(&next).z)
}

/// Eq. 2.10 and 4.13 have the factor 1 - e in print, by which an elastic collision would have no
/// impulse, and only a plastic one would satisfy Eq. 2.11.
#[test]
fn the_impulse_grows_with_restitution() {
    for e in [0.0, 0.25, 0.5, 1.0] {
        let (impulse, after) = middle_of_a_face(e);
        // The inverse mass is 1 + 3 / 9.
        let plastic = 1.0 / (4.0 / 3.0);
        assert!((impulse - (1.0 + e) * plastic).abs() < 1e-14, "{e}: {impulse}");
        assert!((after - e).abs() < 1e-14, "{e}: {after}");
        let printed = (1.0 - e) * plastic;
        assert!(e == 0.0 || (impulse - printed).abs() > 0.1, "{e}");
    }
}

/// A contact at p2 loads p2 alone. Eq. 4.15 measures mu_b from p3 in print, by which Eq. 4.16 would
/// load p3.
#[test]
fn a_contact_at_a_corner_loads_that_corner() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let [p1, p2, p3] = corners;
    for (n, corner) in corners.into_iter().enumerate() {
        let mut expected = [0.0; 3];
        expected[n] = 1.0;
        assert_eq!(weights(corner, p1, p2, p3), expected);
    }
    assert_eq!(weights(0.25 * p2 + 0.5 * p3, p1, p2, p3), [0.25, 0.25, 0.5]);
}

/// With the masses of single particles, as Eq. 4.13 reads, a third of the approach would remain at
/// the middle of a face: the mass is that of the contact point.
#[test]
fn the_mass_is_that_of_the_point() {
    let (impulse, after) = middle_of_a_face(0.0);
    assert!((impulse - 0.75).abs() < 1e-15 && after.abs() < 1e-15, "{impulse} {after}");
    let single = 1.0 / (1.0 + 1.0);
    let left = 1.0 - single * (1.0 + 3.0 / 9.0);
    assert!((left - 1.0 / 3.0f64).abs() < 1e-15 && (after + 1.0 - left).abs() > 0.5);
}

/// Displacements over the step are reversed by the law of the velocities, wherever the blocks are.
#[test]
fn a_displacement_is_reversed_as_a_velocity_is() {
    let contact = at_the_middle_of_a_face();
    let particles = [Particle { mass: 1.0, block: 0 }; 4];
    let at = |z: f64| State { position: DVec3::new(0.5, 0.25, z), ..State::default() };
    let curr = [at(3.5), at(3.0), at(3.0), at(3.0)];
    for restitution in [0.0, 0.5, 1.0] {
        let mut next = curr;
        next[0].position.z -= 1.0;
        let law = Law { restitution, friction: None };
        respond(&contact, &law, Step { particles: &particles, curr: &curr, next: &mut next }, |_| true);
        let after = contact.relative(|p| next[p].position - curr[p].position);
        assert!(after.distance(restitution * DVec3::Z) < 1e-14, "{restitution}: {after}");
    }
}
