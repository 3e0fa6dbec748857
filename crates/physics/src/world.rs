//! The world: constants, shapes and state.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_scene::Scene;

use crate::batch;
use crate::body::{Bodies, Shapes};
use crate::constants::{AREA_RANGE, NOMINAL_MASS, REFERENCE_AREA, STEP_FRACTION};
use crate::contacts::Contacts;
use crate::hand::{Aim, grasped};
use crate::input::{AppliedForce, Input};
use crate::kernel::Kernel;
use crate::lanes::float_mode::FloatMode;
use crate::pack::Packing;
use crate::params::{Params, Precision};
use crate::report::{ContactReport, StepReport};
use crate::rest;
use crate::restitution::damping_ratio;

/// Why a scene cannot become a world.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A constant of the run is out of its range.
    #[error("parameter `{field}` is {value}, expected {expected}")]
    Param {
        /// Which one.
        field: &'static str,
        /// What it was.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// The scene is not one that can be simulated.
    #[error(transparent)]
    Scene(#[from] teeter_scene::SceneError),
}

/// Largest force that a hand may be given, N, whatever the input says.
const STRONGEST_HAND: f64 = 50.0;

/// All that changes: with the constants and the inputs it determines all of the future.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct State {
    pub time: f64,
    pub bodies: Bodies,
    pub contacts: Contacts,
    /// Where the hand of the last step wanted its body.
    pub aim: Option<Aim>,
    /// Forces at the end of the last step.
    pub forces: Vec<AppliedForce>,
    /// Gravity of the last step.
    pub gravity: DVec3,
}

/// The inner loop in one of its two number formats.
#[derive(Debug, Clone)]
pub(crate) enum Loop {
    Single(Kernel<f32>),
    Double(Kernel<f64>),
}

/// Bodies and contacts in time. All of its future follows from the scene, the [`Params`] and the [`Input`]s.
#[derive(Debug, Clone)]
pub struct World {
    pub(crate) params: Params,
    pub(crate) shapes: Shapes,
    pub(crate) state: State,
    /// Gravity of the scene, m/s².
    scene_gravity: f64,
    /// Static and kinetic friction.
    pub(crate) mu: (f64, f64),
    /// Damping ratio.
    pub(crate) zeta: f64,
    /// Normal stiffness of a contact of the reference area, N/m.
    pub(crate) stiffness: f64,
    /// Substep, s, and how many make a frame.
    pub(crate) h: f64,
    pub(crate) substeps: usize,
    pub(crate) kernel: Loop,
    pub(crate) packing: Packing,
    poses: Vec<f64>,
}

impl World {
    /// A world at rest in the poses of `scene`.
    ///
    /// # Errors
    /// When a constant is out of its range or the scene is not valid, naming the field or block.
    pub fn new(scene: &Scene, params: Params) -> Result<Self, BuildError> {
        let _mode = FloatMode::standard();
        check(&params)?;
        scene.validate()?;
        let shapes = Shapes::new(scene);
        let bodies = Bodies::new(scene);
        let longest = STEP_FRACTION * (step_mass(&shapes) / scene.stiffness).sqrt();
        let substeps = (params.frame / longest).ceil().max(1.0) as usize;
        let mut world = Self {
            scene_gravity: scene.gravity,
            mu: (scene.friction, scene.kinetic_friction.unwrap_or(scene.friction)),
            zeta: damping_ratio(scene.restitution),
            stiffness: scene.stiffness,
            h: params.frame / substeps as f64,
            substeps,
            kernel: match params.precision {
                Precision::Single => Loop::Single(Kernel::new(params.width)),
                Precision::Double => Loop::Double(Kernel::new(params.width)),
            },
            packing: Packing::default(),
            poses: Vec::new(),
            state: State {
                time: 0.0,
                contacts: Contacts::new(bodies.len()),
                aim: None,
                forces: Vec::new(),
                gravity: DVec3::new(0.0, 0.0, -scene.gravity),
                bodies,
            },
            params,
            shapes,
        };
        let all: Vec<u32> = (0..world.len() as u32).collect();
        world.state.contacts.detect(&world.shapes, &mut world.state.bodies, &all);
        world.write_poses();
        Ok(world)
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The constants of the run.
    pub fn params(&self) -> &Params {
        &self.params
    }

    /// Stiffness of the scene, N/m.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// The substep, s.
    pub fn substep(&self) -> f64 {
        self.h
    }

    /// Seven numbers a body in order of creation: position (m), orientation (x, y, z, w).
    pub fn poses(&self) -> &[f64] {
        &self.poses
    }

    /// Six numbers a body: velocity of the centre (m/s), angular velocity (rad/s).
    pub fn velocities(&self) -> Vec<f64> {
        let bodies = &self.state.bodies;
        bodies.velocity.iter().zip(&bodies.spin).flat_map(|(v, w)| [v.x, v.y, v.z, w.x, w.y, w.z]).collect()
    }

    /// Edge lengths of a body, m.
    pub fn size(&self, body: u32) -> DVec3 {
        self.shapes.half[body as usize] * 2.0
    }

    /// Mass of a body, kg.
    pub fn mass(&self, body: u32) -> f64 {
        self.shapes.mass[body as usize]
    }

    /// Whether a body sleeps.
    pub fn asleep(&self, body: u32) -> bool {
        self.state.bodies.asleep[body as usize]
    }

    /// Gives a body a velocity (m/s) and a spin (rad/s): how an experiment starts.
    pub fn set_velocity(&mut self, body: u32, velocity: DVec3, spin: DVec3) {
        let i = body as usize;
        rest::wake(&mut self.state.bodies, &self.state.contacts.manifolds, &[body]);
        self.state.bodies.velocity[i] = velocity;
        self.state.bodies.spin[i] = spin;
    }

    /// Turns a body to an orientation about its centre: how an experiment starts. The contacts are found anew.
    pub fn set_orientation(&mut self, body: u32, orientation: glam::DQuat) {
        let _mode = FloatMode::standard();
        rest::wake(&mut self.state.bodies, &self.state.contacts.manifolds, &[body]);
        self.state.bodies.orientation[body as usize] = orientation.normalize();
        self.state.contacts.detect(&self.shapes, &mut self.state.bodies, &[body]);
        self.write_poses();
    }

    /// The contacts that bear load on a body, in the order of the other bodies.
    pub fn contacts(&self, body: u32) -> Vec<ContactReport> {
        let mut reports = Vec::new();
        for manifold in &self.state.contacts.manifolds {
            if manifold.a != body && manifold.b != body {
                continue;
            }
            let (center, axes) = self.state.bodies.pose(manifold.a);
            let force: f64 = manifold.points.iter().map(|p| p.force).sum();
            if force <= 0.0 {
                continue;
            }
            let place: DVec3 = manifold.points.iter().map(|p| p.anchor_a * p.force).sum();
            let normal = axes * manifold.frame[0];
            let (other, normal) = if manifold.a == body { (manifold.b, -normal) } else { (manifold.a, normal) };
            reports.push(ContactReport {
                other: (other != crate::body::FLOOR).then_some(other),
                point: center + axes * (place / force),
                normal,
                force,
            });
        }
        reports
    }

    /// Deepest overlap, m.
    pub fn penetration(&self) -> f64 {
        let points = self.state.contacts.manifolds.iter().flat_map(|m| &m.points);
        points.fold(0.0, |deepest, p| f64::max(deepest, -p.gap))
    }

    /// The input without what cannot be used.
    pub(crate) fn admissible(&self, input: &Input) -> Input {
        let known = |i: u32| (i as usize) < self.len();
        let mut input = input.clone();
        input.gravity = input.gravity.filter(|g| g.is_finite());
        input.forces.retain(|f| known(f.body) && f.point.is_finite() && f.force.is_finite());
        input.drives.retain(|d| known(d.body) && d.velocity.is_finite() && d.max_force >= 0.0);
        input.hand = input.hand.filter(|h| {
            known(h.body)
                && !self.state.bodies.quarantined[h.body as usize]
                && h.anchor.is_finite()
                && h.target.is_finite()
                && h.axis.is_finite()
                && h.orientation.is_none_or(|q| q.is_finite() && q.length_squared() > 0.0)
                && h.max_force >= 0.0
                && h.max_torque >= 0.0
        });
        if let Some(hand) = &mut input.hand {
            hand.max_force = hand.max_force.min(STRONGEST_HAND);
            hand.axis = hand.axis.normalize_or_zero();
            hand.orientation = hand.orientation.map(|q| q.normalize());
        }
        input
    }

    /// Wakes what the input acts on.
    pub(crate) fn rouse(&mut self, input: &Input) {
        let gravity = input.gravity.unwrap_or(DVec3::new(0.0, 0.0, -self.scene_gravity));
        let mut who: Vec<u32> = input.forces.iter().map(|f| f.body).collect();
        who.extend(input.drives.iter().map(|d| d.body));
        who.extend(input.hand.iter().map(|h| h.body));
        // a hand or force that lets go changes the loads as well
        who.extend(self.state.forces.iter().map(|f| f.body));
        who.extend(self.state.aim.iter().map(|a| a.body));
        if gravity != self.state.gravity {
            who = (0..self.len() as u32).collect();
        }
        self.state.gravity = gravity;
        rest::wake(&mut self.state.bodies, &self.state.contacts.manifolds, &who);
    }

    /// Gravity now, m/s²: that of the step, grown evenly over the ramp.
    pub(crate) fn gravity(&self, input: &Input) -> DVec3 {
        let gravity = input.gravity.unwrap_or(DVec3::new(0.0, 0.0, -self.scene_gravity));
        let ramp = self.params.ramp;
        if self.state.time < ramp { gravity * ((self.state.time / ramp).clamp(0.0, 1.0)) } else { gravity }
    }

    /// How many substeps may pass before the next sync.
    pub(crate) fn substeps_until_sync(&self, speeds: &[f64]) -> usize {
        let calm = self.state.time > self.params.ramp;
        ((batch::longest(speeds, calm) / self.h).round() as usize).max(1)
    }

    /// Keeps of the input what the next step continues from.
    pub(crate) fn remember(&mut self, input: &Input) {
        self.state.aim = input.hand.as_ref().map(Aim::of);
        self.state.forces.clone_from(&input.forces);
    }

    /// Fills in the report at the end of a step.
    pub(crate) fn summarise(&mut self, input: &Input, report: &mut StepReport) {
        self.write_poses();
        let bodies = &self.state.bodies;
        let manifolds = &self.state.contacts.manifolds;
        report.time = self.state.time;
        report.manifolds = manifolds.len() as u32;
        report.touching = manifolds.iter().flat_map(|m| &m.points).filter(|p| p.force > 0.0).count() as u32;
        report.awake = (0..bodies.len()).filter(|&i| bodies.moves(i)).count() as u32;
        let squares = bodies.velocity.iter().map(|v| v.length_squared());
        report.max_speed = squares.clone().fold(0.0, f64::max).sqrt();
        report.rms_speed = (squares.sum::<f64>() / bodies.len().max(1) as f64).sqrt();
        if let (Some(to), Some(hand)) = (&mut report.hand, &input.hand) {
            to.point = grasped(hand, bodies);
        }
    }

    pub(crate) fn write_poses(&mut self) {
        let bodies = &self.state.bodies;
        self.poses.clear();
        for (p, q) in bodies.position.iter().zip(&bodies.orientation) {
            self.poses.extend([p.x, p.y, p.z, q.x, q.y, q.z, q.w]);
        }
    }
}

/// The mass that bounds the substep, kg: that of the lightest body for the stiffness of its largest face. The nominal block has a
/// third to spare, so a block of the lightest wood does not shorten the step.
fn step_mass(shapes: &Shapes) -> f64 {
    let spare = 0.75;
    let flat = 0.081 * 0.0268 / REFERENCE_AREA;
    let bounds = shapes.half.iter().zip(&shapes.mass).map(|(half, mass)| {
        let face = 4.0 * (half.x * half.y).max(half.y * half.z).max(half.z * half.x);
        mass * flat / (face / REFERENCE_AREA).clamp(AREA_RANGE.0, AREA_RANGE.1)
    });
    bounds.map(|m| m / spare).fold(NOMINAL_MASS, f64::min)
}

fn check(params: &Params) -> Result<(), BuildError> {
    let range = |field, value: f64, low: f64, high: f64, expected| {
        // a NaN is in no range
        if (low..=high).contains(&value) { Ok(()) } else { Err(BuildError::Param { field, value, expected }) }
    };
    range("ramp", params.ramp, 0.0, 60.0, "0 to 60 s")?;
    range("frame", params.frame, 1e-4, 0.1, "0.0001 to 0.1 s")
}
