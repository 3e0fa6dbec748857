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
    /// Energy put in during the step, J: the work of hand, forces and drives on the bodies, what a
    /// change of gravity adds to their potential energy, and what they do not fall by while gravity
    /// grows. [`EnergyBalance`](crate::EnergyBalance) has what is lost.
    pub put_in: f64,
    /// Bodies frozen during this step, which no longer move: their state was not finite, they were
    /// fast with energy that nobody put in, or faster than 1e4 m/s.
    pub quarantined: Vec<BodyId>,
    /// Report of the hand; none where there was no hand.
    pub hand: Option<HandReport>,
}

/// Force and torque of the hand at the end of a step.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_physics::{BodyId, Hand, Input, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let body = BodyId(0);
/// let lift = world.pose(body).position + DVec3::Z * 0.05;
/// let hand = Hand::carry(body, DVec3::ZERO, lift, DQuat::IDENTITY);
/// let report = world.run_with(1.0, &Input::hand(hand)).hand.unwrap();
/// // at rest in the air the hand carries the weight
/// assert!((report.force.z / (world.mass(body) * 9.81) - 1.0).abs() < 1e-3);
/// assert!(report.point.distance(lift) < 1e-5 && !report.capped);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
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
///
/// ```
/// use teeter_physics::{BodyId, Params, World};
///
/// let mut world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// world.run_for(2.0);
/// let contacts = world.contacts(BodyId(0));
/// // the floor carries the weight
/// assert_eq!((contacts.len(), contacts[0].other), (1, None));
/// assert!((contacts[0].force / (world.mass(BodyId(0)) * 9.81) - 1.0).abs() < 1e-3);
/// assert!(contacts[0].normal.z > 0.999);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
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
///
/// ```
/// use teeter_physics::{BodyId, Params, World};
/// use teeter_scene::Form;
///
/// let mut scene = teeter_scene::named("block").unwrap();
/// scene.form = Form::Lattice;
/// scene.gravity = 0.0;
/// let world = World::new(&scene, Params::default())?;
/// let lattice = world.lattice(BodyId(0)).unwrap();
/// let center = lattice.particles.iter().sum::<glam::DVec3>() / 8.0;
/// assert!(center.distance(world.pose(BodyId(0)).position) < 1e-12);
/// // nothing is strained without gravity
/// assert!(lattice.forces.iter().all(|force| force.abs() < 1e-6));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LatticeReport {
    /// Positions in the world, m.
    pub particles: [DVec3; 8],
    /// Forces of the springs, N; tension is positive. In the order of the pairs of particles
    /// (0, 1), (0, 2), ... (6, 7).
    pub forces: [f64; 28],
}
