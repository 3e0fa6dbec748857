//! Dynamic friction with drag at the contacts of the previous step (sections 4.6 and 5.7.2).

use super::constants::Constants;
use super::contact::Contact;
use super::model::Model;
use super::particle::State;

/// Adds the friction of every contact, equal and opposite on its two sides.
///
/// It opposes the tangential relative velocity with kinetic friction times the normal force (Eq.
/// 2.18), plus a drag force proportional to the velocity. The sum is limited to the force that
/// stops the contact point within `time` (s), because friction cannot reverse the motion.
pub fn add(model: &Model, constants: &Constants, contacts: &[Contact], time: f64, states: &mut [State]) {
    // Static friction is a part of the collision impulses.
    if !constants.friction_enabled || constants.static_friction.is_some() {
        return;
    }
    for contact in contacts {
        let velocity = contact.velocity(states);
        let across = velocity - velocity.dot(contact.normal) * contact.normal;
        let speed = across.length();
        if speed == 0.0 {
            continue;
        }
        let max = speed / (contact.inverse_mass(&model.particles, |_| true) * time);
        let sliding = constants.friction * contact.normal_force; // Eq. 2.18
        let drag = constants.drag * speed;
        let force = -across * ((sliding + drag).min(max) / speed);
        for (p, w) in contact.parts() {
            states[p].force += w * force;
        }
    }
}
