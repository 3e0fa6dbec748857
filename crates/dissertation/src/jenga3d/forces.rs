//! Forces on the particles (section 4.3.1, appendix 2.2).

use glam::DVec3;

use super::block::SPRINGS;
use super::constants::Constants;
use super::contact::Contact;
use super::friction;
use super::hand::UserForce;
use super::model::Model;
use super::options::Disabling;
use super::particle::State;
use super::spring_lanes::{self, Present};

/// Inputs of the forces of a step, besides model, constants and states.
///
/// ```
/// use teeter_dissertation::jenga3d::forces::{Sources, compute_forces};
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let mut block = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// let sources = Sources { user: None, contacts: &[], time: block.constants.force_step() };
/// compute_forces(&block.model, &block.constants, &sources, &mut block.curr);
/// let weight: f64 = block.curr.iter().map(|state| -state.force.z).sum();
/// assert!((weight - 0.0196 * 9.81).abs() < 1e-12);
/// ```
#[derive(Debug)]
pub struct Sources<'a> {
    /// Force of the hand, if any.
    pub user: Option<UserForce>,
    /// Contacts of the previous step.
    pub contacts: &'a [Contact],
    /// Time between two computations of forces, s.
    pub time: f64,
}

/// Writes the force on every particle: hand, gravity, springs, and friction at the contacts of the
/// previous step.
pub fn compute_forces(model: &Model, constants: &Constants, sources: &Sources, states: &mut [State]) {
    let gravity = -constants.gravity * DVec3::Z;
    for (state, particle) in states.iter_mut().zip(&model.particles) {
        state.force = particle.mass * gravity;
    }
    if let Some(user) = sources.user {
        user.add(model, states);
    }
    // Blocks that stay disabled take no step, so their forces are never read. Appendix 2.4 enables
    // all blocks after this.
    let moving = model.blocks.iter().filter(|block| block.active || constants.disabling != Disabling::Rigid);
    let present = Present::of(constants.springs);
    for block in moving {
        spring_lanes::add_forces(&model.springs[block.springs as usize..][..SPRINGS], &present, states);
    }
    friction::add(model, constants, sources.contacts, sources.time, states);
}
