//! Rows of dominoes and of bricks.

use glam::{DQuat, DVec3};

use super::setting::scene_of;
use crate::scene::{Block, Scene};

/// Thickness, width and height of a domino, m.
const DOMINO: [f64; 3] = [0.0075, 0.024, 0.048];
/// Mass of a domino, kg: that of melamine.
const DOMINO_MASS: f64 = 0.013;
/// Distance of adjacent dominoes, m: half their height.
const DOMINO_PITCH: f64 = 0.024;
/// Angle of the first domino, degrees. It balances on its edge at atan(7.5 / 48), 8.88 degrees.
const DOMINO_LEAN: f64 = 12.0;

/// Length, width and height of a brick, m.
const BRICK: [f64; 3] = [0.215, 0.1025, 0.065];
/// Mass of a brick, kg.
const BRICK_MASS: f64 = 2.3;
/// Gap between the bricks of a course, m.
const JOINT: f64 = 0.001;

/// Twenty dominoes along x, of which the first leans towards the others.
pub fn dominoes() -> Scene {
    let upright =
        |id: u32| Block::new(id, DOMINO, DOMINO_MASS, [DOMINO_PITCH * (f64::from(id) - 9.5), 0.0, 0.5 * DOMINO[2]]);
    let mut blocks: Vec<Block> = (0..20).map(upright).collect();
    // Turned about the lower edge on the side of the others, which stays on the floor.
    let (sin, cos) = libm::sincos(0.5 * f64::to_radians(DOMINO_LEAN));
    let turn = DQuat::from_array([0.0, sin, 0.0, cos]);
    let first = &mut blocks[0];
    let edge = DVec3::from_array(first.pos) + DVec3::new(0.5 * DOMINO[0], 0.0, -0.5 * DOMINO[2]);
    first.pos = (edge + turn * (DVec3::from_array(first.pos) - edge)).to_array();
    first.orientation = Some(turn.to_array());
    scene_of(blocks)
}

/// Six courses of five bricks in running bond: every other course has half bricks at its ends.
pub fn wall() -> Scene {
    let pitch = BRICK[0] + JOINT;
    let half = 0.5 * (BRICK[0] - JOINT);
    let mut blocks = Vec::new();
    for course in 0..6 {
        let z = BRICK[2] * (f64::from(course) + 0.5);
        let mut brick = |length: f64, x: f64| {
            let mass = BRICK_MASS * length / BRICK[0];
            blocks.push(Block::new(blocks.len() as u32, [length, BRICK[1], BRICK[2]], mass, [x, 0.0, z]));
        };
        if course % 2 == 0 {
            (0..5).for_each(|i| brick(BRICK[0], pitch * (f64::from(i) - 2.0)));
        } else {
            let end = 2.0 * pitch + 0.5 * (BRICK[0] - half);
            brick(half, -end);
            (0..4).for_each(|i| brick(BRICK[0], pitch * (f64::from(i) - 1.5)));
            brick(half, end);
        }
    }
    Scene { friction: 0.6, ..scene_of(blocks) }
}
