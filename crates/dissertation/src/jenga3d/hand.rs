//! The player's hand: both ways of moving a block and the hybrid of them (sections 4.8 and 5.6).

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::block::CORNERS;
use super::constants::Constants;
use super::model::Model;
use super::particle::State;
use super::pick::Ray;

/// How the hand moves a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandMode {
    /// By a force in proportion to the distance: right against a tower, and in the air a spring on which the block swings.
    Force,
    /// By writing the velocity: smooth in the air, and stronger than any tower.
    Velocity,
    /// By force while the block touches anything, by velocity in the air.
    Hybrid,
}

/// A hand on a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// Index of the block.
    pub block: u32,
    /// Where its centre is wanted, m.
    pub target: DVec3,
}

/// A force on a block, N, shared evenly by its particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UserForce {
    /// Index of the block.
    pub block: u32,
    /// The whole force, N.
    pub force: DVec3,
}

impl UserForce {
    /// Adds it to the particles of its block.
    pub fn add(&self, model: &Model, states: &mut [State]) {
        for p in model.blocks[self.block as usize].corners() {
            states[p].force += self.force / CORNERS as f64;
        }
    }
}

impl Hand {
    /// Acts on a block: writes its velocity, or gives the force for the step. `touching` is whether the block touches anything.
    pub fn act(&self, model: &Model, constants: &Constants, touching: bool, states: &mut [State]) -> Option<UserForce> {
        let block = &model.blocks[self.block as usize];
        let way = self.target - block.centre(states);
        let by_force = match constants.hand {
            HandMode::Force => true,
            HandMode::Velocity => false,
            HandMode::Hybrid => touching,
        };
        if by_force {
            return Some(UserForce { block: self.block, force: constants.hand_stiffness * way });
        }
        for p in block.corners() {
            states[p].velocity = constants.hand_rate * way;
        }
        None
    }
}

/// Where the mouse drags a block that is moved in a plane through its centre, parallel to the screen; none where the ray runs along it.
pub fn drag_in_plane(ray: &Ray, towards_viewer: DVec3, centre: DVec3) -> Option<DVec3> {
    let along = ray.direction.dot(towards_viewer);
    let t = (centre - ray.origin).dot(towards_viewer) / along;
    t.is_finite().then(|| ray.origin + t * ray.direction)
}

/// Where the mouse drags a block that is moved along the line of sight, by `pull` (m) towards the viewer.
pub fn drag_in_depth(towards_viewer: DVec3, centre: DVec3, pull: f64) -> DVec3 {
    centre + pull * towards_viewer
}
