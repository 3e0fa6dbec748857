//! Requirements about blocks inside each other.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;
use teeter_scene::Block;

use super::subject::{Answer, Subject, full_tower, scene};
use crate::dissertation::backend::Grasp;
use crate::dissertation::length::mm;
use crate::dissertation::overlap::max_depth;
use crate::error::Error;

/// Block thrown at another that stands on the floor.
struct Throw {
    /// Initial position from the centre of the other, m.
    from: DVec3,
    /// Direction of flight.
    direction: DVec3,
    /// Rotation about the vertical, rad.
    yaw: f64,
}

/// Throws: face on face along it and across, end on end, side on side, and an edge on a side.
const THROWS: [Throw; 5] = [
    Throw { from: DVec3::new(0.0, 0.0, 0.2), direction: DVec3::NEG_Z, yaw: 0.0 },
    Throw { from: DVec3::new(0.006, 0.0, 0.2), direction: DVec3::NEG_Z, yaw: FRAC_PI_2 },
    Throw { from: DVec3::new(-0.3, 0.0, 0.0), direction: DVec3::X, yaw: 0.0 },
    Throw { from: DVec3::new(0.0, -0.2, 0.0), direction: DVec3::Y, yaw: 0.0 },
    Throw { from: DVec3::new(0.0, -0.2, 0.0), direction: DVec3::Y, yaw: FRAC_PI_4 },
];
/// Speeds of the throws, m/s: 3 and 17 cm a frame, so that the ends of frames alone could miss a
/// collision.
const SPEEDS: [f64; 2] = [2.0, 10.0];
/// Distance from the line of flight within which neither block has made room, m: half of the
/// thickness of a block.
const SAME_LINE: f64 = 9e-3;
/// Displacement of the hand in a frame as it drives a block into a tower, m: half of the thickness
/// of a block.
const HAND_STEP: f64 = 9e-3;

/// 2.7: blocks thrown at each other keep their order, and a hand pushes a block against a tower,
/// not into it.
pub fn no_passing(subject: &Subject) -> Result<Answer, Error> {
    let mut through = 0;
    for throw in &THROWS {
        for speed in SPEEDS {
            through += u32::from(passes(subject, throw, speed)?);
        }
    }
    let depth = driven_depth(subject)?;
    let (throws, depth_mm) = (THROWS.len() * SPEEDS.len(), mm(depth));
    let evidence = format!(
        "of {throws} throws at up to 10 m/s {through} go through; a hand drives a block {depth_mm} \
         mm into others of a tower"
    );
    Ok(Answer::new(through == 0 && depth < 4.5e-3, evidence))
}

/// Returns true if a block thrown at a speed (m/s) gets behind the other on its line of flight.
fn passes(subject: &Subject, throw: &Throw, speed: f64) -> Result<bool, Error> {
    let mut two = scene("column")?;
    two.blocks.truncate(2);
    two.blocks[1].pos = (DVec3::from(two.blocks[0].pos) + throw.from).to_array();
    two.blocks[1].yaw = throw.yaw;
    let mut tower = subject.build(&two)?;
    tower.set_velocity(1, speed * throw.direction);
    Ok((0..60).any(|_| {
        tower.step(None);
        let apart = tower.centre(1) - tower.centre(0);
        let along = apart.dot(throw.direction);
        along > 0.0 && (apart - along * throw.direction).length() < SAME_LINE
    }))
}

/// Maximum depth of a block that a hand drives into the side of a tower, m.
fn driven_depth(subject: &Subject) -> Result<f64, Error> {
    let mut six = full_tower(6)?;
    let block = six.blocks.len() as u32;
    let pos = [0.0, -0.12, 0.5 * six.blocks[0].size[2]];
    six.blocks.push(Block { id: block, pos, yaw: 0.0, ..six.blocks[0].clone() });
    let mut tower = subject.build(&six)?;
    tower.rest(30);
    let mut depth = 0.0f64;
    let from = DVec3::new(0.0, -0.12, 0.063);
    for frame in 0..90u32 {
        // Half a second to lift the block, then forward.
        let forward = HAND_STEP * f64::from(frame.saturating_sub(30));
        tower.step(Some(&Grasp { block, target: from + forward.min(0.3) * DVec3::Y, carried: true }));
        depth = depth.max(max_depth(&tower));
    }
    Ok(depth)
}

/// 2.8: blocks at rest are hardly inside others.
pub fn no_embedding(subject: &Subject) -> Result<Answer, Error> {
    let mut full = subject.build_rows(18)?;
    full.rest(60);
    let depth = subject.moves.max_depth.max(max_depth(&full));
    Ok(Answer::new(depth < 2e-4, format!("{} mm at most, after any move and in a full tower", mm(depth))))
}
