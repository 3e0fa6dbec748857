//! State that collisions read and write.

use super::constants::Constants;
use super::contact::Contact;
use super::model::Model;
use super::particle::State;
use super::path::Path;
use super::response::{Step, respond};

/// Model, states and contacts of a step while its collisions are resolved.
#[derive(Debug)]
pub struct Field<'a> {
    /// Lists of the scene; collisions enable blocks.
    pub model: &'a mut Model,
    /// Constants.
    pub constants: &'a Constants,
    /// Last valid states.
    pub curr: &'a [State],
    /// States to be made valid.
    pub next: &'a mut [State],
    /// Contacts of the step, for the friction of the next one.
    pub contacts: &'a mut Vec<Contact>,
}

impl Field<'_> {
    /// Path of a particle over the step.
    #[inline]
    pub fn path(&self, particle: usize) -> Path {
        Path::between(self.curr[particle].position, self.next[particle].position)
    }

    /// Resolves a contact. A contact of a disabled block with a large impulse enables it first
    /// (section 4.7).
    pub fn respond(&mut self, contact: Contact) {
        let mut contact = contact;
        for block in contact.blocks {
            let disabled = self.model.blocks.get(block as usize).is_some_and(|b| !b.active);
            if disabled && self.impulse_if_free(&contact) > self.constants.reactivation_impulse {
                self.model.blocks[block as usize].active = true;
            }
        }
        let blocks = &self.model.blocks;
        let moves = |block: u32| blocks[block as usize].active;
        let step = Step { particles: &self.model.particles, curr: self.curr, next: self.next };
        let impulse = respond(&contact, &self.constants.law(), step, moves);
        contact.normal_force = impulse / self.constants.step();
        self.contacts.push(contact);
    }

    /// Impulse of a contact if no block were fixed, N s.
    fn impulse_if_free(&self, contact: &Contact) -> f64 {
        let approach = contact.velocity(self.next).dot(contact.normal);
        -(1.0 + self.constants.restitution) * approach.min(0.0) / contact.inverse_mass(&self.model.particles, |_| true)
    }
}
