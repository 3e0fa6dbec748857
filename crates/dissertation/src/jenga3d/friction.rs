//! Dynamic friction with drag from the contacts of the last step (sections 4.6 and 5.7.2).

use super::constants::Constants;
use super::forces::Sources;
use super::model::Model;
use super::particle::State;

/// Adds the friction of every contact, equal and opposite on its two sides.
///
/// It acts against the relative velocity across the normal with kinetic friction times the normal force (Eq. 2.18). To that comes the drag,
/// a force per velocity. Together they never exceed what stops the contact point within `sources.time`: more would turn the motion round,
/// which friction cannot.
pub fn add(model: &Model, constants: &Constants, sources: &Sources, states: &mut [State]) {
    // Static friction is a part of the blows themselves.
    if !constants.friction_enabled || constants.static_friction.is_some() {
        return;
    }
    for contact in sources.contacts {
        let velocity = contact.velocity(states);
        let across = velocity - velocity.dot(contact.normal) * contact.normal;
        let speed = across.length();
        if speed == 0.0 {
            continue;
        }
        let most = speed / (contact.inverse_mass(&model.particles, |_| true) * sources.time);
        let sliding = constants.friction * contact.normal_force; // Eq. 2.18
        let drag = constants.drag * speed;
        let force = -across * ((sliding + drag).min(most) / speed);
        for (p, w) in contact.parts() {
            states[p].force += w * force;
        }
    }
}
