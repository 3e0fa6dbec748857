//! Report of a step.

use glam::DVec3;
use serde::Serialize;

use crate::body_id::BodyId;

/// What happened during one step.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StepReport {
    /// Simulated time at the end of the step, s.
    pub time: f64,
    /// Substeps that were run; of clusters stepped apart, those of the one with most.
    pub substeps: u32,
    /// Runs of the inner loop between two syncs, over all clusters.
    pub syncs: u32,
    /// Pairs on which detection ran.
    pub detections: u32,
    /// Manifolds kept.
    pub manifolds: u32,
    /// Points that carry load at the end.
    pub touching: u32,
    /// Bodies awake at the end.
    pub awake: u32,
    /// Deepest overlap at any sync of the step, m.
    pub penetration: f64,
    /// Fastest body at the end, m/s.
    pub max_speed: f64,
    /// Root mean square speed over all bodies at the end, m/s.
    pub rms_speed: f64,
    /// Bodies frozen during this step because their state was not finite or ran away; they stay where they are.
    pub quarantined: Vec<BodyId>,
    /// What the hand did, if there was one.
    pub hand: Option<HandReport>,
}

/// What the hand did at the end of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct HandReport {
    /// Force of the hand on the body, N.
    pub force: DVec3,
    /// Torque of the hand on the body, N m.
    pub torque: DVec3,
    /// Whether the force was at its limit.
    pub capped: bool,
    /// Whether the torque was at its limit.
    pub torque_capped: bool,
    /// The grasped point in the world, m.
    pub point: DVec3,
}

/// One loaded contact of a body, summed over its points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactReport {
    /// The other body; none for the floor.
    pub other: Option<BodyId>,
    /// Centre of the load, m.
    pub point: DVec3,
    /// Direction in which it presses on this body.
    pub normal: DVec3,
    /// Normal force, N.
    pub force: f64,
}

/// A block of springs: where its particles are and how its springs pull.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LatticeReport {
    /// Places in the world, m.
    pub particles: [DVec3; 8],
    /// Forces of the springs, N: pulling is positive, pushing negative. In the order of the pairs of particles (0, 1), (0, 2), ... (6, 7).
    pub forces: [f64; 28],
}
