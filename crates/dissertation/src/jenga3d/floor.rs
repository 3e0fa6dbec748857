//! Floor, z = 0: a plane that only particles collide with.

use glam::DVec3;

use super::contact::{Contact, FLOOR, Kind};
use super::particle::State;

/// Returns the contact of a particle whose next state is below the floor.
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
