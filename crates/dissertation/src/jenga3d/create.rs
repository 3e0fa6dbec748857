//! Creation of blocks (section 4.2.5).

use glam::DVec3;
use teeter_scene::Block as SceneBlock;

use super::block::{Block, CORNERS, EDGE_CORNERS, EDGES, FACE_CORNERS};
use super::constants::Constants;
use super::face::Face;
use super::model::Model;
use super::particle::{Particle, State};
use super::spring::Spring;

/// Appends a block at rest to the lists, raised by `lift` (m): `CreateBlock` of section 4.2.5.
///
/// Each particle has an eighth of the mass, so the radius of gyration is half the edge instead of
/// the 0.29 of a uniform block: three times the moment of inertia about every axis.
pub fn create_block(model: &mut Model, curr: &mut Vec<State>, block: &SceneBlock, lift: f64, constants: &Constants) {
    let (first_particle, first_spring, first_face) = (model.particles.len(), model.springs.len(), model.faces.len());
    let index = model.blocks.len() as u32;
    let (sin, cos) = (libm::sin(block.yaw), libm::cos(block.yaw));
    let centre = DVec3::from(block.pos) + lift * DVec3::Z;
    for corner in 0..CORNERS {
        let side = |axis: usize| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 } * block.size[axis];
        let (x, y, z) = (side(0), side(1), side(2));
        let position = centre + DVec3::new(cos * x - sin * y, sin * x + cos * y, z);
        model.particles.push(Particle { mass: block.mass / CORNERS as f64, block: index });
        curr.push(State { position, ..State::default() });
    }
    let mut pairs: Vec<[usize; 2]> = EDGE_CORNERS.to_vec();
    let others =
        (0..CORNERS).flat_map(|a| (a + 1..CORNERS).map(move |b| [a, b])).filter(|pair| !EDGE_CORNERS.contains(pair));
    pairs.extend(others);
    for (n, [a, b]) in pairs.into_iter().enumerate() {
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
