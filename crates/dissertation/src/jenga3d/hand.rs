//! Hand of the player: force, velocity and the hybrid of both (sections 4.8 and 5.6).

use glam::DVec3;

use super::block::CORNERS;
use super::constants::Constants;
use super::model::Model;
use super::options::HandMode;
use super::particle::State;
use super::pick::Ray;

/// Hand on a block.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::{Constants, Hand, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// let target = simulator.centres()[0] + 0.1 * DVec3::Z;
/// for _ in 0..60 {
///     simulator.frame(Some(&Hand { block: 0, target }));
/// }
/// assert!(simulator.centres()[0].distance(target) < 2e-3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// Index of the block.
    pub block: u32,
    /// Target position of its centre, m.
    pub target: DVec3,
}

/// Force on a block, shared equally by its particles.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::hand::UserForce;
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let mut block = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// UserForce { block: 0, force: 8.0 * DVec3::X }.add(&block.model, &mut block.curr);
/// assert_eq!(block.curr[0].force, DVec3::X);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UserForce {
    /// Index of the block.
    pub block: u32,
    /// Total force, N.
    pub force: DVec3,
}

impl UserForce {
    /// Adds the force to the particles of its block.
    pub fn add(&self, model: &Model, states: &mut [State]) {
        for p in model.blocks[self.block as usize].corners() {
            states[p].force += self.force / CORNERS as f64;
        }
    }
}

impl Hand {
    /// Applies the hand: writes the velocity of its block, or returns the force for the step.
    /// `touching` is true when the block touches anything.
    pub fn act(&self, model: &Model, constants: &Constants, touching: bool, states: &mut [State]) -> Option<UserForce> {
        let block = &model.blocks[self.block as usize];
        let offset = self.target - block.centre(states);
        let by_force = match constants.hand {
            HandMode::Force => true,
            HandMode::Velocity => false,
            HandMode::Hybrid => touching,
        };
        if by_force {
            return Some(UserForce { block: self.block, force: constants.hand_stiffness * offset });
        }
        for p in block.corners() {
            states[p].velocity = constants.hand_rate * offset;
        }
        None
    }
}

/// Target of a block dragged in the plane through its centre parallel to the screen, m; `None` for
/// a ray parallel to that plane.
pub fn drag_in_plane(ray: &Ray, towards_viewer: DVec3, centre: DVec3) -> Option<DVec3> {
    let along = ray.direction.dot(towards_viewer);
    let t = (centre - ray.origin).dot(towards_viewer) / along;
    t.is_finite().then(|| ray.origin + t * ray.direction)
}

/// Target of a block dragged along the line of sight by `pull` (m) towards the viewer, m.
pub fn drag_in_depth(towards_viewer: DVec3, centre: DVec3, pull: f64) -> DVec3 {
    centre + pull * towards_viewer
}
