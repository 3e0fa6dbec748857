//! Creation of blocks (section 4.2.5).

use glam::{DQuat, DVec3};
use teeter_scene::Block as SceneBlock;

use super::block::{Block, CORNERS, EDGES, FACE_CORNERS, SPRING_CORNERS};
use super::constants::Constants;
use super::face::Face;
use super::model::Model;
use super::particle::{Particle, State};
use super::spring::Spring;

/// Appends a block to the lists, raised by `lift` (m): `CreateBlock` of section 4.2.5.
///
/// Each particle has an eighth of the mass, so the radius of gyration is half the edge instead of
/// the 0.29 of a uniform block: three times the moment of inertia about every axis.
pub fn create_block(model: &mut Model, curr: &mut Vec<State>, block: &SceneBlock, lift: f64, constants: &Constants) {
    let (first_particle, first_spring, first_face) = (model.particles.len(), model.springs.len(), model.faces.len());
    let index = model.blocks.len() as u32;
    let (sin, cos) = (libm::sin(block.yaw), libm::cos(block.yaw));
    let centre = DVec3::from(block.pos) + lift * DVec3::Z;
    let orientation = block.orientation.map(|_| DQuat::from_array(block.rotation()));
    for corner in 0..CORNERS {
        let side = |axis: usize| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 } * block.size[axis];
        let (x, y, z) = (side(0), side(1), side(2));
        let arm = match orientation {
            Some(q) => q * DVec3::new(x, y, z),
            None => DVec3::new(cos * x - sin * y, sin * x + cos * y, z),
        };
        let velocity = DVec3::from(block.velocity) + DVec3::from(block.spin).cross(arm); // Eq. 2.5
        model.particles.push(Particle { mass: block.mass / CORNERS as f64, block: index });
        curr.push(State { position: centre + arm, velocity, force: DVec3::ZERO });
    }
    for (n, [a, b]) in SPRING_CORNERS.into_iter().enumerate() {
        let (p1, p2) = (first_particle + a, first_particle + b);
        model.springs.push(Spring {
            p1: p1 as u32,
            p2: p2 as u32,
            rest_length: curr[p1].position.distance(curr[p2].position),
            stiffness: constants.stiffness,
            damping: constants.damping,
            edge: n < EDGES,
        });
    }
    for corners in FACE_CORNERS {
        let [p1, p2, p3] = corners.map(|c| (first_particle + c) as u32);
        model.faces.push(Face { p1, p2, p3 });
    }
    model.blocks.push(Block {
        particles: first_particle as u32,
        springs: first_spring as u32,
        faces: first_face as u32,
        active: true,
    });
}
