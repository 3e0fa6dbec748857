//! Report of a step.

use glam::DVec3;
use serde::Serialize;

use crate::body_id::BodyId;

/// Report of one step.
///
/// ```
/// use teeter_physics::{Input, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let report = world.step(&Input::default());
/// assert_eq!(report.awake as usize, world.len());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StepReport {
    /// Simulated time at the end of the step, s.
    pub time: f64,
    /// Substeps; the maximum over clusters.
    pub substeps: u32,
    /// Syncs, summed over clusters.
    pub syncs: u32,
    /// Pairs tested by the narrow phase.
    pub detections: u32,
    /// Manifolds at the end.
    pub manifolds: u32,
    /// Contact points under load at the end.
    pub touching: u32,
    /// Bodies awake at the end.
    pub awake: u32,
    /// Deepest penetration at any sync of the step, m.
    pub penetration: f64,
    /// Maximum speed over the bodies at the end, m/s.
    pub max_speed: f64,
    /// Root mean square of the bodies' speeds at the end, m/s.
    pub rms_speed: f64,
    /// Bodies frozen during this step because their state was not finite or ran away; they no longer
    /// move.
    pub quarantined: Vec<BodyId>,
    /// Report of the hand; none where there was no hand.
    pub hand: Option<HandReport>,
}

/// Force and torque of the hand at the end of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct HandReport {
    /// Force on the body, N.
    pub force: DVec3,
    /// Torque on the body, N m.
    pub torque: DVec3,
    /// The force was at its limit.
    pub capped: bool,
    /// The torque was at its limit.
    pub torque_capped: bool,
    /// Grasped point in the world, m.
    pub point: DVec3,
}

/// A loaded contact of a body, summed over its points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactReport {
    /// Other body; none for the floor.
    pub other: Option<BodyId>,
    /// Centre of the load, m.
    pub point: DVec3,
    /// Direction of the force on this body, unit vector.
    pub normal: DVec3,
    /// Normal force, N.
    pub force: f64,
}

/// Particles and springs of a lattice block.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LatticeReport {
    /// Positions in the world, m.
    pub particles: [DVec3; 8],
    /// Forces of the springs, N; tension is positive. In the order of the pairs of particles (0, 1),
    /// (0, 2), ... (6, 7).
    pub forces: [f64; 28],
}
