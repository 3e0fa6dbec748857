//! Collision response: momentum, restitution and energy.

mod common;

use common::{cases, vector};
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

/// Consequences of the printed forms of Eq. 2.10, 4.13 and 4.15.
#[test]
fn the_printed_signs_are_wrong() {
    // An elastic collision without an impulse contradicts Eq. 2.11.
    let printed = |e: f64, v: f64| -(1.0 - e) * v;
    assert_eq!(printed(1.0, -1.0), 0.0);
    // Between equal masses the printed impulse is right for a plastic collision only; others keep e
    // v instead of -e v.
    let after = |e: f64| -1.0 + printed(e, -1.0);
    assert_eq!(after(0.0), 0.0);
    assert_eq!(after(0.5), -0.5);
    // A contact at p2: b is p2, so mu_b of Eq. 4.15 is |p2 - p3| / |p2 - p3| = 1 and mu_a is 1; Eq.
    // 4.16 then loads p3 alone.
    let (mu_a, mu_b) = (1.0, 1.0);
    assert_eq!([1.0 - mu_a, (1.0 - mu_b) * mu_a, mu_a * mu_b], [0.0, 0.0, 1.0]);
    let [p1, p2, p3] = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(weights(p2, p1, p2, p3), [0.0, 1.0, 0.0]);
}

/// Masses of single particles, as Eq. 4.13 reads, leave a third of the approach at the middle of a
/// face.
#[test]
fn the_mass_is_that_of_the_point() {
    let third = 1.0f64 / 3.0;
    let j = 1.0 / (1.0 + 1.0f64);
    let approach_left = 1.0 - j * (1.0 + 3.0 * third * third);
    assert!((approach_left - third).abs() < 1e-15);
}
