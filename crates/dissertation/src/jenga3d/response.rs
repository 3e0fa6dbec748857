//! What a collision does (section 4.5): an impulse at the contact point, and a way back for the positions.

use super::contact::Contact;
use super::particle::{Particle, State};
use super::static_friction::Coefficients;

/// How a blow goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Ratio of the speeds along the normal after and before, 0 to 1.
    pub restitution: f64,
    /// Friction within the blow, where static friction is modelled.
    pub friction: Option<Coefficients>,
}

/// Applies the impulse of a contact to the next states, and gives its part along the normal, N s. Blocks for which `moves` is false stay as
/// they are.
///
/// Eq. 2.9 gives each side its share of j along the normal. That the relative velocity along the normal turns from v to -e v (Eq. 2.11)
/// makes j = -(1 + e) v / (1/Ma + 1/Mb): Eq. 2.10 and 4.13 are printed with 1 - e, with which an elastic collision would have no impulse.
/// The inverse masses are those of the point, Σ w²/m, not those of single particles: with these Eq. 2.11 would not hold.
///
/// Velocities alone would leave the blocks inside each other, so the ways of the particles over the step are turned back by the same law:
/// what came nearer along the normal goes away by e times as much from where it was at the start of the step.
pub fn respond(
    contact: &Contact,
    law: &Law,
    particles: &[Particle],
    curr: &[State],
    next: &mut [State],
    moves: impl Fn(u32) -> bool,
) -> f64 {
    let inverse_mass = contact.inverse_mass(particles, &moves);
    if inverse_mass == 0.0 {
        return 0.0;
    }
    let velocity = contact.velocity(next);
    let way = contact.relative(|p| next[p].position - curr[p].position);
    let turn = |along: f64| -(1.0 + law.restitution) * along.min(0.0) / inverse_mass; // Eq. 4.13
    let along = |vector: glam::DVec3| vector.dot(contact.normal); // Eq. 2.8
    let (impulse, shift) = (turn(along(velocity)), turn(along(way)));
    let (mut whole_impulse, mut whole_shift) = (impulse * contact.normal, shift * contact.normal);
    if let Some(friction) = law.friction {
        let across = |vector: glam::DVec3| vector - along(vector) * contact.normal;
        whole_impulse += friction.impulse(across(velocity), impulse, inverse_mass);
        whole_shift += friction.impulse(across(way), shift, inverse_mass);
    }
    for (p, w) in contact.parts() {
        if moves(particles[p].block) {
            let share = w / particles[p].mass;
            next[p].velocity += whole_impulse * share; // Eq. 2.9
            next[p].position += whole_shift * share;
        }
    }
    impulse
}
