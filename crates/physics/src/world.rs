//! The world: its bodies in clusters, and what it says of them.

use glam::{DMat3, DQuat, DVec3};
use teeter_scene::{Form, Scene, Springs};

use crate::body::{Bodies, FLOOR, Shapes};
use crate::broad_phase::Bound;
use crate::cluster::{Cluster, Loop};
use crate::constants::SWEEP_LEAST;
use crate::frame::Outcome;
use crate::hand::{Aim, grasped};
use crate::input::{AppliedForce, Input};
use crate::lanes::float_mode::FloatMode;
use crate::lattice::Particles;
use crate::params::Params;
use crate::regroup::Clusters;
use crate::report::{ContactReport, LatticeReport, StepReport};
use crate::rest;
use crate::setup::{Masses, Setup};

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

/// Bodies and contacts in time. All of its future follows from the scene, the [`Params`] and the [`Input`]s.
#[derive(Debug, Clone)]
pub struct World {
    pub(crate) params: Params,
    /// The scene without its blocks.
    pub(crate) scene: Scene,
    pub(crate) setup: Setup,
    pub(crate) clusters: Clusters,
    pub(crate) time: f64,
    /// Where the hand of the last step wanted its body.
    pub(crate) aim: Option<Aim>,
    /// Forces at the end of the last step.
    pub(crate) forces: Vec<AppliedForce>,
    /// Gravity of the last step.
    pub(crate) gravity: DVec3,
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
        let setup = Setup::new(scene, &params, Masses::new(&shapes));
        let mut cluster = Cluster::new(&params, scene.form);
        cluster.ids = (0..scene.blocks.len() as u32).collect();
        cluster.bodies = Bodies::new(scene);
        cluster.particles = vec![Particles::default(); shapes.particles.len()];
        cluster.bodies.stretch = vec![DMat3::IDENTITY; shapes.particles.len()];
        let bound = |i| Bound::new(&shapes, &cluster.bodies, i, SWEEP_LEAST);
        cluster.contacts.swept = (0..cluster.len()).map(bound).collect();
        cluster.contacts.bounds = cluster.contacts.swept.clone();
        cluster.contacts.renew_near();
        cluster.contacts.detect_all(&shapes, &mut cluster.bodies);
        cluster.shapes = shapes;
        // the first step divides it
        cluster.outgrown = true;
        let mut world = Self {
            scene: Scene { blocks: Vec::new(), ..scene.clone() },
            setup,
            clusters: Clusters::one(cluster),
            time: 0.0,
            aim: None,
            forces: Vec::new(),
            gravity: setup.own_gravity(),
            poses: vec![0.0; 7 * scene.blocks.len()],
            params,
        };
        world.write_poses();
        Ok(world)
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.clusters.place.len()
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
        self.setup.stiffness
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The substep, s.
    pub fn substep(&self) -> f64 {
        self.setup.h
    }

    /// Seven numbers a body in order of creation: position (m), orientation (x, y, z, w).
    pub fn poses(&self) -> &[f64] {
        &self.poses
    }

    /// Six numbers a body: velocity of the centre (m/s), angular velocity (rad/s).
    pub fn velocities(&self) -> Vec<f64> {
        let of = |i: u32| {
            let (cluster, i) = self.clusters.of(i);
            let (v, w) = (cluster.bodies.velocity[i], cluster.bodies.spin[i]);
            [v.x, v.y, v.z, w.x, w.y, w.z]
        };
        (0..self.len() as u32).flat_map(of).collect()
    }

    /// Edge lengths of a body, m.
    pub fn size(&self, body: u32) -> DVec3 {
        let (cluster, i) = self.clusters.of(body);
        cluster.shapes.half[i] * 2.0
    }

    /// Mass of a body, kg.
    pub fn mass(&self, body: u32) -> f64 {
        let (cluster, i) = self.clusters.of(body);
        cluster.shapes.mass[i]
    }

    /// Whether a body sleeps.
    pub fn asleep(&self, body: u32) -> bool {
        let (cluster, i) = self.clusters.of(body);
        cluster.bodies.asleep[i]
    }

    /// Gives a body a velocity (m/s) and a spin (rad/s): how an experiment starts.
    pub fn set_velocity(&mut self, body: u32, velocity: DVec3, spin: DVec3) {
        self.wake(body);
        let (cluster, i) = self.clusters.of_mut(body);
        cluster.bodies.velocity[i] = velocity;
        cluster.bodies.spin[i] = spin;
        if let Some(particles) = cluster.particles.get_mut(i) {
            particles.set_motion(cluster.shapes.particles[i], cluster.bodies.orientation[i], velocity, spin);
        }
    }

    /// What the blocks are.
    pub fn form(&self) -> Form {
        self.scene.form
    }

    /// Stiffness of the springs within the blocks, N/m, where they have any.
    pub fn spring_stiffness(&self) -> Option<f64> {
        self.setup.springs.map(|springs| springs.stiffness)
    }

    /// Makes the blocks of another form, or gives them other springs, where they are and as they move. Springs that were strained stay so
    /// where there were springs before.
    ///
    /// # Errors
    /// When a constant of the springs is out of its range; the world is then unchanged.
    pub fn set_form(&mut self, form: Form, springs: Springs) -> Result<(), BuildError> {
        let _mode = FloatMode::standard();
        let scene = Scene { form, springs, ..self.scene.clone() };
        scene.validate_constants()?;
        let refit = form != self.scene.form || springs.particles != self.scene.springs.particles;
        self.scene = scene;
        for cluster in &mut self.clusters.list {
            let Cluster { shapes, bodies, particles, .. } = cluster;
            shapes.set_form(form, springs.particles);
            if refit {
                let of = |i: usize, &half: &DVec3| {
                    Particles::of_rigid(half, bodies.orientation[i], bodies.velocity[i], bodies.spin[i])
                };
                *particles = shapes.particles.iter().enumerate().map(|(i, half)| of(i, half)).collect();
                bodies.stretch = vec![DMat3::IDENTITY; particles.len()];
            }
            cluster.kernel = Loop::new(&self.params, form);
            cluster.contacts.detect_all(&cluster.shapes, &mut cluster.bodies);
        }
        self.setup = Setup::new(&self.scene, &self.params, self.setup.masses);
        (0..self.len() as u32).for_each(|body| self.wake(body));
        Ok(())
    }

    /// Places of the particles of a body in the world, m, and the forces of its springs (N, pulling is positive) in the order of the pairs
    /// (0, 1), (0, 2), ... (6, 7); none where the body is rigid. Bit k of a particle's number says on which side of axis k it is.
    pub fn lattice(&self, body: u32) -> Option<LatticeReport> {
        let (cluster, i) = self.clusters.of(body);
        let springs = self.setup.springs.as_ref()?;
        Some(cluster.particles.get(i)?.report(cluster.shapes.particles[i], cluster.bodies.pose(i as u32), springs))
    }

    /// Turns a body to an orientation about its centre: how an experiment starts. The contacts are found anew.
    pub fn set_orientation(&mut self, body: u32, orientation: DQuat) {
        let _mode = FloatMode::standard();
        self.wake(body);
        let (cluster, i) = self.clusters.of_mut(body);
        cluster.bodies.orientation[i] = orientation.normalize();
        // what it may sweep now can be another cluster's
        self.clusters.regroup(&self.params, self.scene.form, self.setup.frame, &[]);
        let (cluster, i) = self.clusters.of_mut(body);
        let due = [i as u32];
        let (pairs, _) = cluster.contacts.candidates(&cluster.shapes, &mut cluster.bodies, &due, SWEEP_LEAST);
        cluster.contacts.detect(&cluster.shapes, &mut cluster.bodies, &due, &pairs);
        self.write_poses();
    }

    /// The contacts that bear load on a body, in the order of the other bodies.
    pub fn contacts(&self, body: u32) -> Vec<ContactReport> {
        let (cluster, i) = self.clusters.of(body);
        let i = i as u32;
        let mut reports = Vec::new();
        for manifold in &cluster.contacts.manifolds {
            if manifold.a != i && manifold.b != i {
                continue;
            }
            let (center, axes) = cluster.bodies.pose(manifold.a);
            let force: f64 = manifold.points.iter().map(|p| p.force).sum();
            if force <= 0.0 {
                continue;
            }
            let place: DVec3 = manifold.points.iter().map(|p| p.anchor_a * p.force).sum();
            let normal = axes * manifold.frame[0];
            let (other, normal) = if manifold.a == i { (manifold.b, -normal) } else { (manifold.a, normal) };
            reports.push(ContactReport {
                other: (other != FLOOR).then(|| cluster.ids[other as usize]),
                point: center + axes * (place / force),
                normal,
                force,
            });
        }
        reports
    }

    /// Deepest overlap, m.
    pub fn penetration(&self) -> f64 {
        let points = self.clusters.list.iter().flat_map(|c| &c.contacts.manifolds).flat_map(|m| &m.points);
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
                && !self.quarantined(h.body)
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

    /// Whether a body was taken out of the play.
    fn quarantined(&self, body: u32) -> bool {
        let (cluster, i) = self.clusters.of(body);
        cluster.bodies.quarantined[i]
    }

    /// Wakes a body and all that it touches.
    fn wake(&mut self, body: u32) {
        let (cluster, i) = self.clusters.of_mut(body);
        rest::wake(&mut cluster.bodies, &cluster.contacts.manifolds, &[i as u32]);
    }

    /// Wakes what the input acts on.
    pub(crate) fn rouse(&mut self, input: &Input) {
        let gravity = input.gravity.unwrap_or(self.setup.own_gravity());
        let mut who: Vec<u32> = input.forces.iter().map(|f| f.body).collect();
        who.extend(input.drives.iter().map(|d| d.body));
        who.extend(input.hand.iter().map(|h| h.body));
        // a hand or force that lets go changes the loads as well
        who.extend(self.forces.iter().map(|f| f.body));
        who.extend(self.aim.iter().map(|a| a.body));
        if gravity != self.gravity {
            who = (0..self.len() as u32).collect();
        }
        self.gravity = gravity;
        who.into_iter().for_each(|body| self.wake(body));
    }

    /// Keeps of the input what the next step continues from.
    pub(crate) fn remember(&mut self, input: &Input) {
        self.aim = input.hand.as_ref().map(Aim::of);
        self.forces.clone_from(&input.forces);
    }

    /// Time and poses at the end of a step, and the report on it.
    pub(crate) fn summarise(&mut self, input: &Input, outcomes: Vec<Outcome>) -> StepReport {
        self.time += self.setup.substeps as f64 * self.setup.h;
        self.write_poses();
        let mut report = StepReport { time: self.time, ..StepReport::default() };
        let mut squares = 0.0;
        for (cluster, outcome) in self.clusters.list.iter().zip(outcomes) {
            report.substeps = report.substeps.max(outcome.substeps);
            report.syncs += outcome.syncs;
            report.detections += outcome.detections;
            report.manifolds += cluster.contacts.manifolds.len() as u32;
            let points = cluster.contacts.manifolds.iter().flat_map(|m| &m.points);
            report.touching += points.filter(|p| p.force > 0.0).count() as u32;
            report.awake += (0..cluster.len()).filter(|&i| cluster.bodies.moves(i)).count() as u32;
            report.penetration = report.penetration.max(outcome.penetration);
            for v in &cluster.bodies.velocity {
                squares += v.length_squared();
                report.max_speed = report.max_speed.max(v.length());
            }
            report.quarantined.extend(outcome.quarantined.iter().map(|&i| cluster.ids[i as usize]));
            report.hand = report.hand.or(outcome.hand);
        }
        report.quarantined.sort_unstable();
        report.rms_speed = (squares / self.len().max(1) as f64).sqrt();
        if let (Some(to), Some(hand)) = (&mut report.hand, &input.hand) {
            let (cluster, i) = self.clusters.of(hand.body);
            to.point = grasped(&hand.anchor, &cluster.bodies, i);
        }
        report
    }

    pub(crate) fn write_poses(&mut self) {
        for cluster in &self.clusters.list {
            let poses = cluster.bodies.position.iter().zip(&cluster.bodies.orientation);
            for (&id, (p, q)) in cluster.ids.iter().zip(poses) {
                self.poses[7 * id as usize..][..7].copy_from_slice(&[p.x, p.y, p.z, q.x, q.y, q.z, q.w]);
            }
        }
    }
}

fn check(params: &Params) -> Result<(), BuildError> {
    let range = |field, value: f64, low: f64, high: f64, expected| {
        // a NaN is in no range
        if (low..=high).contains(&value) { Ok(()) } else { Err(BuildError::Param { field, value, expected }) }
    };
    range("ramp", params.ramp, 0.0, 60.0, "0 to 60 s")?;
    range("frame", params.frame, 1e-4, 0.1, "0.0001 to 0.1 s")
}
