//! The floor, z = 0: a plane that only particles can meet.

use glam::DVec3;

use super::contact::{Contact, FLOOR, Kind};
use super::particle::State;

/// The contact of a particle that would be below the floor in its next state.
pub fn contact(particle: u32, block: u32, next: &State) -> Option<Contact> {
    (next.position.z < 0.0).then_some(Contact {
        kind: Kind::ParticleFloor,
        blocks: [block, FLOOR],
        particles: [particle, 0, 0, 0],
        weights: [1.0, 0.0, 0.0, 0.0],
        normal: DVec3::Z,
        normal_force: 0.0,
    })
}
