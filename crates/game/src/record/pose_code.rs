//! Poses of a record, rounded: what is shown where the engine of the record is missing, and by
//! which a block that diverges is found.

use glam::{DQuat, DVec3};
use teeter_physics::{BodyId, POSE_STRIDE};
use teeter_scene::Scene;

use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;

/// Parts of a metre, and of a quaternion's components, that poses are rounded to.
const POSITION_PARTS: f64 = 2e4;
const ROTATION_PARTS: f64 = 2e3;
/// Difference from which a rounded pose is stored again, in parts: less than one would alternate.
const CHANGED: f64 = 0.8;
/// Largest rounded number: beyond it a position is of no more use.
const MAX_ROUNDED: f64 = 1e12;

/// Pose in parts: position, then orientation x, y, z, w.
pub type RoundedPose = [i64; POSE_STRIDE];

/// A block that moved since the sample before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PoseChange {
    /// The block.
    pub body: BodyId,
    /// Its pose.
    pub pose: RoundedPose,
}

/// Rounds a pose of seven numbers.
pub fn rounded(pose: &[f64]) -> RoundedPose {
    std::array::from_fn(|k| {
        let parts = if k < 3 { POSITION_PARTS } else { ROTATION_PARTS };
        (pose[k] * parts).round().clamp(-MAX_ROUNDED, MAX_ROUNDED) as i64
    })
}

/// Returns true if a pose of seven numbers is no more that of a rounded one.
pub fn has_changed(pose: &[f64], before: &RoundedPose) -> bool {
    let parts = |k: usize| if k < 3 { POSITION_PARTS } else { ROTATION_PARTS };
    (0..POSE_STRIDE).any(|k| (pose[k] * parts(k) - before[k] as f64).abs() > CHANGED)
}

/// Poses of a scene's blocks as they are described.
pub fn of_scene(scene: &Scene) -> Vec<RoundedPose> {
    let pose = |block: &teeter_scene::Block| {
        let ([x, y, z], [a, b, c, d]) = (block.pos, block.rotation());
        rounded(&[x, y, z, a, b, c, d])
    };
    scene.blocks.iter().map(pose).collect()
}

/// Position of a rounded pose, m.
pub fn position(pose: &RoundedPose) -> DVec3 {
    DVec3::new(pose[0] as f64, pose[1] as f64, pose[2] as f64) / POSITION_PARTS
}

/// Orientation of a rounded pose.
pub fn orientation(pose: &RoundedPose) -> DQuat {
    let [x, y, z, w] = [3, 4, 5, 6].map(|k| pose[k] as f64);
    let length = (x * x + y * y + z * z + w * w).sqrt();
    if length > 0.0 { DQuat::from_xyzw(x, y, z, w) / length } else { DQuat::IDENTITY }
}

/// Writes the changes from one sample to the next, and applies them to `poses`.
pub fn write(writer: &mut Writer, poses: &mut [RoundedPose], changes: &[PoseChange]) {
    writer.unsigned(changes.len() as u64);
    let mut next = 0;
    for change in changes {
        let index = change.body.index();
        writer.unsigned((index - next) as u64);
        next = index + 1;
        for (now, before) in change.pose.iter().zip(&mut poses[index]) {
            writer.signed(*now - *before);
            *before = *now;
        }
    }
}

/// Reads the changes from one sample to the next, and applies them to `poses`.
pub fn read(reader: &mut Reader, poses: &mut [RoundedPose]) -> Result<Vec<PoseChange>, RecordError> {
    let (count, mut next) = (reader.unsigned()?, 0u64);
    let mut changes = Vec::new();
    for _ in 0..count {
        let index = next.checked_add(reader.unsigned()?).ok_or(reader.damaged())?;
        let pose = usize::try_from(index).ok().and_then(|index| poses.get_mut(index)).ok_or(reader.damaged())?;
        next = index + 1;
        for part in pose.iter_mut() {
            *part = part
                .checked_add(reader.signed()?)
                .filter(|part| part.abs() <= MAX_ROUNDED as i64)
                .ok_or(reader.damaged())?;
        }
        changes.push(PoseChange { body: BodyId(index as u32), pose: *pose });
    }
    Ok(changes)
}
