//! The forces on the particles (section 4.3.1, appendix 2.2).

use glam::DVec3;

use super::block::SPRINGS;
use super::constants::Constants;
use super::contact::Contact;
use super::disable::Disabling;
use super::friction;
use super::hand::UserForce;
use super::model::Model;
use super::particle::State;

/// What the forces of a step follow from, besides the states.
#[derive(Debug)]
pub struct Sources<'a> {
    /// The hand's force, if it gives one.
    pub user: Option<UserForce>,
    /// Contacts of the last step.
    pub contacts: &'a [Contact],
    /// Time between two computations of forces, s.
    pub time: f64,
}

/// Writes the force on every particle: the user's, gravity, springs, and friction from the contacts of the last step.
pub fn compute_forces(model: &Model, constants: &Constants, sources: &Sources, states: &mut [State]) {
    let gravity = -constants.gravity * DVec3::Z;
    for (state, particle) in states.iter_mut().zip(&model.particles) {
        state.force = particle.mass * gravity;
    }
    if let Some(user) = sources.user {
        user.add(model, states);
    }
    // Disabled blocks take no step where they stay disabled, so nobody reads their forces; appendix 2.4 enables all after this.
    let moving = model.blocks.iter().filter(|block| block.active || constants.disabling != Disabling::Rigid);
    for spring in moving.flat_map(|block| &model.springs[block.springs as usize..][..SPRINGS]) {
        let (p1, p2) = (spring.p1 as usize, spring.p2 as usize);
        let force = spring.force(&states[p1], &states[p2]);
        states[p2].force += force; // Eq. 4.2b
        states[p1].force -= force; // Eq. 4.2b
    }
    friction::add(model, constants, sources, states);
}
