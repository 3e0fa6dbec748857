//! The world: construction, changes from outside, and queries.

use glam::{DMat3, DQuat, DVec3};
use teeter_scene::{Form, Scene, Springs};

use crate::actuator::hand::HandTarget;
use crate::actuator::limits::{self, shortened};
use crate::body::{Bodies, FLOOR, Shapes, point_speed};
use crate::body_id::BodyId;
use crate::build_error::BuildError;
use crate::cluster::partition::Clusters;
use crate::cluster::{Cluster, rest};
use crate::collision::broad_phase::{Aabb, exceeds_pairs};
use crate::collision::manifold::Manifold;
use crate::constants::{MAX_INPUT_SPEED, MAX_PAIRS, MAX_SUBSTEPS, MIN_SWEEP};
use crate::derived::{Derived, Masses};
use crate::input::AppliedForce;
use crate::kernel::any_kernel::AnyKernel;
use crate::lattice::particles::Particles;
use crate::overload;
use crate::params::Params;
use crate::pose::{POSE_STRIDE, Pose, Twist};
use crate::report::{ContactReport, LatticeReport};
use crate::simd::float_mode::FloatMode;

/// Bodies and contacts in time. All of its future follows from the scene, the [`Params`] and the
/// [`Input`](crate::Input)s.
///
/// ```
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut world = World::new(&scene, Params::default())?;
/// world.run_for(1.0);
/// for body in world.bodies() {
///     assert!(world.pose(body).position.z > 0.0);
/// }
/// let state = world.snapshot();
/// world.run_for(0.5);
/// world.restore(&state).unwrap();
/// assert!((world.time() - 1.0).abs() < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct World {
    pub(crate) params: Params,
    /// The scene as built, with the present form and springs.
    pub(crate) scene: Scene,
    pub(crate) derived: Derived,
    pub(crate) clusters: Clusters,
    pub(crate) time: f64,
    /// Target of the hand in the last step.
    pub(crate) hand_target: Option<HandTarget>,
    /// Forces at the end of the last step.
    pub(crate) forces: Vec<AppliedForce>,
    /// Gravity of the last step.
    pub(crate) gravity: DVec3,
    poses: Vec<f64>,
}

impl World {
    /// Builds a world at rest in the poses of `scene`.
    ///
    /// # Errors
    /// When a constant is out of its range or the scene is not valid, naming the field or block.
    pub fn new(scene: &Scene, params: Params) -> Result<Self, BuildError> {
        let _mode = FloatMode::standard();
        check(&params)?;
        scene.validate()?;
        let mut shapes = Shapes::new(scene);
        let bodies = Bodies::new(scene);
        let bounds: Vec<Aabb> = (0..bodies.len()).map(|i| Aabb::new(&shapes, &bodies, i, MIN_SWEEP)).collect();
        if exceeds_pairs(&bounds, MAX_PAIRS) {
            return Err(BuildError::Crowded { limit: MAX_PAIRS });
        }
        let fixed: Vec<bool> = scene.blocks.iter().map(|block| block.fixed).collect();
        let derived = Derived::new(scene, &params, Masses::new(&shapes, &fixed));
        check_substeps(scene, &derived)?;
        shapes.spring = derived.contact_spring();
        let mut world = Self {
            scene: scene.clone(),
            derived,
            clusters: Clusters::single(single_cluster(scene, &params, shapes)),
            time: 0.0,
            hand_target: None,
            forces: Vec::new(),
            gravity: derived.scene_gravity(),
            poses: vec![0.0; POSE_STRIDE * scene.blocks.len()],
            params,
        };
        world.write_poses();
        overload::check(&world.clusters.list[0], scene)?;
        if params.ramp == 0.0 {
            world.settle_start();
        }
        Ok(world)
    }

    /// Returns the bodies in order of creation, which is that of the scene's blocks.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyId> + DoubleEndedIterator + use<> {
        (0..self.len() as u32).map(BodyId)
    }

    /// Returns the body of an index that comes from outside; none where the world has no such body.
    pub fn body(&self, index: u32) -> Option<BodyId> {
        ((index as usize) < self.len()).then_some(BodyId(index))
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.clusters.locations.len()
    }

    /// Returns true if there is no body.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Constants of the run.
    pub fn params(&self) -> &Params {
        &self.params
    }

    /// The scene that the world was built from, with the present form and springs of the blocks.
    /// Its blocks are where they were at the start.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the present state as a scene: poses, velocities and spins of the blocks, with the
    /// constants, the form and the springs. A world built from it goes on from here, without the
    /// history of the contacts and the strain of the blocks, and its time begins at zero.
    ///
    /// A block that has never rotated keeps its `yaw`. The label of the scene and its margin are
    /// left out: they are about the scene as built.
    ///
    /// ```
    /// use teeter_physics::{BodyId, Params, World};
    ///
    /// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
    /// world.run_for(1.0);
    /// let scene = world.to_scene();
    /// let position = world.pose(BodyId(4)).position;
    /// assert_eq!(scene.blocks[4].pos, position.to_array());
    /// // what touches settles again at the start
    /// let next = World::new(&scene, Params::default())?;
    /// assert!(next.pose(BodyId(4)).position.distance(position) < 1e-6);
    /// # Ok::<(), teeter_physics::BuildError>(())
    /// ```
    pub fn to_scene(&self) -> Scene {
        let mut scene = Scene { label: None, margin: None, ..self.scene.clone() };
        for (body, block) in self.bodies().zip(&mut scene.blocks) {
            let (pose, twist) = (self.pose(body), self.twist(body));
            block.pos = pose.position.to_array();
            (block.velocity, block.spin) = (twist.velocity.to_array(), twist.spin.to_array());
            if pose.orientation != DQuat::from_array(block.rotation()) {
                (block.yaw, block.orientation) = (0.0, Some(pose.orientation.to_array()));
            }
        }
        scene
    }

    /// Stiffness of a contact of [`REFERENCE_AREA`](crate::REFERENCE_AREA), N/m.
    pub fn stiffness(&self) -> f64 {
        self.derived.stiffness
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Length of a substep, s.
    pub fn substep(&self) -> f64 {
        self.derived.h
    }

    /// Number of frames that cover `seconds`, rounded to the nearest.
    pub fn frames(&self, seconds: f64) -> usize {
        (seconds / self.params.frame).round() as usize
    }

    /// Poses of all bodies, [`POSE_STRIDE`] numbers a body in order of creation: position (m),
    /// orientation (x, y, z, w).
    pub fn poses(&self) -> &[f64] {
        &self.poses
    }

    /// Position and orientation of a body.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn pose(&self, body: BodyId) -> Pose {
        let (cluster, i) = self.locate(body);
        Pose { position: cluster.bodies.position[i], orientation: cluster.bodies.orientation[i] }
    }

    /// Velocity and spin of a body.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn twist(&self, body: BodyId) -> Twist {
        let (cluster, i) = self.locate(body);
        Twist { velocity: cluster.bodies.velocity[i], spin: cluster.bodies.spin[i] }
    }

    /// Edge lengths of a body, m.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn size(&self, body: BodyId) -> DVec3 {
        let (cluster, i) = self.locate(body);
        cluster.shapes.half[i] * 2.0
    }

    /// Mass of a body, kg.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn mass(&self, body: BodyId) -> f64 {
        let (cluster, i) = self.locate(body);
        cluster.shapes.mass[i]
    }

    /// Returns true if a body sleeps.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn is_asleep(&self, body: BodyId) -> bool {
        let (cluster, i) = self.locate(body);
        cluster.bodies.asleep[i]
    }

    /// Returns true if a body was frozen because its state was not finite or ran away.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn is_quarantined(&self, body: BodyId) -> bool {
        let (cluster, i) = self.locate(body);
        cluster.bodies.quarantined[i]
    }

    /// Returns true if nothing moves a body: it is fixed or was frozen.
    pub(crate) fn is_immovable(&self, body: BodyId) -> bool {
        let (cluster, i) = self.locate(body);
        cluster.bodies.is_immovable(i)
    }

    /// Sets velocity and spin of a body: the start of an experiment. Wakes it and all that it
    /// touches. A body that is fixed or quarantined stays where it is; numbers that are not finite
    /// are ignored, and what would move a point of the body faster than 1 km/s is reduced to that.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn set_twist(&mut self, body: BodyId, twist: Twist) {
        if self.is_immovable(body) || !twist.velocity.is_finite() || !twist.spin.is_finite() {
            return;
        }
        self.wake(body);
        let (cluster, i) = self.locate_mut(body);
        let twist = Twist {
            velocity: shortened(twist.velocity, MAX_INPUT_SPEED),
            spin: shortened(twist.spin, MAX_INPUT_SPEED / cluster.shapes.half[i].min_element()),
        };
        let around = point_speed(cluster.shapes.half[i], cluster.bodies.orientation[i].conjugate() * twist.spin);
        let twist = Twist { spin: twist.spin * (MAX_INPUT_SPEED / around).min(1.0), ..twist };
        cluster.bodies.velocity[i] = twist.velocity;
        cluster.bodies.spin[i] = twist.spin;
        if let Some(particles) = cluster.particles.get_mut(i) {
            let orientation = cluster.bodies.orientation[i];
            particles.set_motion(cluster.shapes.particles[i], orientation, twist.velocity, twist.spin);
        }
    }

    /// Form of the blocks: rigid, or particles and springs.
    pub fn form(&self) -> Form {
        self.scene.form
    }

    /// Stiffness of the springs within the blocks, N/m; none where the blocks are rigid.
    pub fn spring_stiffness(&self) -> Option<f64> {
        self.derived.springs.map(|springs| springs.stiffness)
    }

    /// Changes the form of the blocks or their springs, at the present poses and velocities.
    /// Springs keep their strain where there were springs before.
    ///
    /// # Errors
    /// When a constant of the springs is out of its range; the world is then unchanged.
    pub fn set_form(&mut self, form: Form, springs: Springs) -> Result<(), BuildError> {
        let _mode = FloatMode::standard();
        let scene = Scene { form, springs, ..self.scene.clone() };
        scene.validate_constants()?;
        let refit = form != self.scene.form || springs.particles != self.scene.springs.particles;
        let derived = Derived::new(&scene, &self.params, self.derived.masses);
        check_substeps(&scene, &derived)?;
        (self.scene, self.derived) = (scene, derived);
        for cluster in &mut self.clusters.list {
            let Cluster { shapes, bodies, particles, .. } = cluster;
            shapes.set_form(form, springs.particles);
            shapes.spring = self.derived.contact_spring();
            if refit {
                let of = |i: usize, &half: &DVec3| {
                    Particles::of_rigid(half, bodies.orientation[i], bodies.velocity[i], bodies.spin[i])
                };
                *particles = shapes.particles.iter().enumerate().map(|(i, half)| of(i, half)).collect();
                bodies.stretch = vec![DMat3::IDENTITY; particles.len()];
            }
            cluster.kernel = AnyKernel::new(&self.params, form);
            cluster.contacts.detect_all(&cluster.shapes, &mut cluster.bodies);
        }
        self.bodies().for_each(|body| self.wake(body));
        Ok(())
    }

    /// Positions of the particles of a body in the world, m, and the forces of its springs (N,
    /// tension is positive) in the order of the pairs (0, 1), (0, 2), ... (6, 7); none where the
    /// body is rigid. Bit k of a particle's number is its side of axis k.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn lattice(&self, body: BodyId) -> Option<LatticeReport> {
        let (cluster, i) = self.locate(body);
        let springs = self.derived.springs.as_ref()?;
        Some(cluster.particles.get(i)?.report(cluster.shapes.particles[i], cluster.bodies.pose(i as u32), springs))
    }

    /// Sets the orientation of a body about its centre: the start of an experiment. Detects its
    /// contacts again. A quaternion of any length is taken; one without a direction is ignored.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn set_orientation(&mut self, body: BodyId, orientation: DQuat) {
        let _mode = FloatMode::standard();
        let Some(orientation) = limits::unit(orientation) else { return };
        self.wake(body);
        let (cluster, i) = self.locate_mut(body);
        cluster.bodies.orientation[i] = orientation;
        // Its new swept bounds may overlap those of another cluster.
        self.clusters.partition(&self.params, self.scene.form, self.derived.frame, &[]);
        let (cluster, i) = self.locate_mut(body);
        let due = [i as u32];
        let pairs = cluster.contacts.candidate_pairs(&cluster.shapes, &mut cluster.bodies, &due, MIN_SWEEP);
        cluster.contacts.detect(&cluster.shapes, &cluster.bodies, &due, &pairs);
        self.write_poses();
    }

    /// Loaded contacts of a body, in the order of the other bodies.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn contacts(&self, body: BodyId) -> Vec<ContactReport> {
        let (cluster, i) = self.locate(body);
        let i = i as u32;
        let mut reports = Vec::new();
        for manifold in &cluster.contacts.manifolds {
            if manifold.a != i && manifold.b != i {
                continue;
            }
            let (center, axes) = cluster.bodies.pose(manifold.a);
            let force = manifold.normal_force();
            if force <= 0.0 {
                continue;
            }
            let moment: DVec3 = manifold.points.iter().map(|p| p.anchor_a * p.normal_force).sum();
            let normal = axes * manifold.frame[0];
            let (other, normal) = if manifold.a == i { (manifold.b, -normal) } else { (manifold.a, normal) };
            reports.push(ContactReport {
                other: (other != FLOOR).then(|| BodyId(cluster.ids[other as usize])),
                point: center + axes * (moment / force),
                normal,
                force,
            });
        }
        reports
    }

    /// Deepest penetration, m.
    pub fn penetration(&self) -> f64 {
        let manifolds = self.clusters.list.iter().flat_map(|c| &c.contacts.manifolds);
        manifolds.map(Manifold::deepest).fold(0.0, f64::max)
    }

    /// Returns the cluster of a body and the body's index there.
    fn locate(&self, body: BodyId) -> (&Cluster, usize) {
        self.assert_has(body);
        self.clusters.get(body.0)
    }

    fn locate_mut(&mut self, body: BodyId) -> (&mut Cluster, usize) {
        self.assert_has(body);
        self.clusters.get_mut(body.0)
    }

    fn assert_has(&self, body: BodyId) {
        assert!(body.index() < self.len(), "there is no body {body}: the world has {}", self.len());
    }

    /// Wakes a body and all that it touches.
    pub(crate) fn wake(&mut self, body: BodyId) {
        let (cluster, i) = self.locate_mut(body);
        rest::wake(&mut cluster.bodies, &cluster.contacts.manifolds, &[i as u32]);
    }

    pub(crate) fn write_poses(&mut self) {
        for cluster in &self.clusters.list {
            let poses = cluster.bodies.position.iter().zip(&cluster.bodies.orientation);
            for (&id, (p, q)) in cluster.ids.iter().zip(poses) {
                let to = &mut self.poses[POSE_STRIDE * id as usize..][..POSE_STRIDE];
                to.copy_from_slice(&[p.x, p.y, p.z, q.x, q.y, q.z, q.w]);
            }
        }
    }
}

/// All bodies of a scene in one cluster, with their contacts detected; the first step partitions
/// it.
fn single_cluster(scene: &Scene, params: &Params, shapes: Shapes) -> Cluster {
    let mut cluster = Cluster::new(params, scene.form);
    cluster.ids = (0..scene.blocks.len() as u32).collect();
    cluster.bodies = Bodies::new(scene);
    let bodies = &cluster.bodies;
    let at_start =
        |i: usize, &half: &DVec3| Particles::of_rigid(half, bodies.orientation[i], bodies.velocity[i], bodies.spin[i]);
    cluster.particles = shapes.particles.iter().enumerate().map(|(i, half)| at_start(i, half)).collect();
    cluster.bodies.stretch = vec![DMat3::IDENTITY; shapes.particles.len()];
    let bound = |i| Aabb::new(&shapes, &cluster.bodies, i, MIN_SWEEP);
    cluster.contacts.swept = (0..cluster.len()).map(bound).collect();
    cluster.contacts.bounds = cluster.contacts.swept.clone();
    cluster.contacts.update_neighbours();
    cluster.contacts.detect_initial(&shapes, &mut cluster.bodies);
    cluster.shapes = shapes;
    cluster.contacts.outgrown = true;
    cluster
}

/// Checks that a frame has at most [`MAX_SUBSTEPS`], which grow with the root of stiffness over
/// mass.
fn check_substeps(scene: &Scene, derived: &Derived) -> Result<(), BuildError> {
    let moving = scene.blocks.iter().filter(|block| !block.fixed);
    let Some(lightest) = moving.min_by(|a, b| a.mass.total_cmp(&b.mass)) else { return Ok(()) };
    if derived.substeps <= MAX_SUBSTEPS {
        return Ok(());
    }
    let (id, mass, substeps) = (lightest.id, lightest.mass, derived.substeps as f64);
    let excess = substeps / MAX_SUBSTEPS as f64;
    let factor = excess * excess;
    Err(BuildError::Substeps { id, mass, substeps, min_mass: factor * mass, factor })
}

fn check(params: &Params) -> Result<(), BuildError> {
    let range = |field, value: f64, min: f64, max: f64, expected| {
        // NaN is in no range.
        if (min..=max).contains(&value) { Ok(()) } else { Err(BuildError::Param { field, value, expected }) }
    };
    range("ramp", params.ramp, 0.0, 60.0, "0 to 60 s")?;
    range("frame", params.frame, 1e-4, 0.1, "0.0001 to 0.1 s")
}
