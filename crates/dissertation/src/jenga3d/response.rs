//! Collision response (section 4.5): an impulse at the contact point, and a correction of the
//! positions.

use super::contact::Contact;
use super::particle::{Particle, State};
use super::static_friction::Coefficients;

/// Law of collisions.
///
/// ```
/// use teeter_dissertation::jenga3d::Constants;
///
/// assert_eq!(Constants::default().law().restitution, 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Ratio of the normal speeds after and before, 0 to 1.
    pub restitution: f64,
    /// Friction of the impulse, where static friction is modelled.
    pub friction: Option<Coefficients>,
}

/// Particles and their states over one step.
///
/// ```
/// use teeter_dissertation::jenga3d::particle::{Particle, State};
/// use teeter_dissertation::jenga3d::response::Step;
///
/// let (curr, mut next) = ([State::default()], [State::default()]);
/// let step = Step { particles: &[Particle { mass: 1.0, block: 0 }], curr: &curr, next: &mut next };
/// assert_eq!(step.particles.len(), step.next.len());
/// ```
#[derive(Debug)]
pub struct Step<'a> {
    /// Particles.
    pub particles: &'a [Particle],
    /// States at the start of the step.
    pub curr: &'a [State],
    /// States at the end of the step.
    pub next: &'a mut [State],
}

/// Applies the impulse of a contact to the next states and returns its normal component, N s.
/// Blocks for which `moves` is false are fixed.
///
/// Eq. 2.9 gives each side its share of j along the normal. Eq. 2.11 changes the normal relative
/// velocity from v to -e v, so j = -(1 + e) v / (1/Ma + 1/Mb). Eq. 2.10 and 4.13 have the factor
/// (1 - e) in print, which gives an elastic collision no impulse. The inverse masses are those of
/// the contact point, Σ w²/m; with those of single particles Eq. 2.11 would not hold.
///
/// Velocities alone would leave the blocks inside each other, so the same law applies to the
/// displacements of the particles over the step.
pub fn respond(contact: &Contact, law: &Law, step: Step, moves: impl Fn(u32) -> bool) -> f64 {
    let Step { particles, curr, next } = step;
    let inverse_mass = contact.inverse_mass(particles, &moves);
    if inverse_mass == 0.0 {
        return 0.0;
    }
    let velocity = contact.velocity(next);
    let displacement = contact.relative(|p| next[p].position - curr[p].position);
    let reverse = |along: f64| -(1.0 + law.restitution) * along.min(0.0) / inverse_mass; // Eq. 4.13
    let along = |vector: glam::DVec3| vector.dot(contact.normal); // Eq. 2.8
    let (impulse, shift) = (reverse(along(velocity)), reverse(along(displacement)));
    let (mut total_impulse, mut total_shift) = (impulse * contact.normal, shift * contact.normal);
    if let Some(friction) = law.friction {
        let across = |vector: glam::DVec3| vector - along(vector) * contact.normal;
        total_impulse += friction.impulse(across(velocity), impulse, inverse_mass);
        total_shift += friction.impulse(across(displacement), shift, inverse_mass);
    }
    for (p, w) in contact.parts() {
        if moves(particles[p].block) {
            let share = w / particles[p].mass;
            next[p].velocity += total_impulse * share; // Eq. 2.9
            next[p].position += total_shift * share;
        }
    }
    impulse
}
