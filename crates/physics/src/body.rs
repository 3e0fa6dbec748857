//! Bodies: constant properties ([`Shapes`]) and state ([`Bodies`]), one array for each field, in
//! order of creation.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_scene::{Form, Particles, Scene};

use crate::constants::{MAX_RADIUS, MIN_STRETCH, SHARP_RADIUS};
use crate::contact_spring::ContactSpring;

/// Index that stands for the floor.
pub const FLOOR: u32 = u32::MAX;

/// Constant properties of the bodies.
#[derive(Debug, Clone, Default)]
pub struct Shapes {
    /// Half edge lengths, m.
    pub half: Vec<DVec3>,
    /// Mass, kg.
    pub mass: Vec<f64>,
    /// Principal moments of inertia, kg m².
    pub inertia: Vec<DVec3>,
    /// Distance from the centre to a corner, m.
    pub radius: Vec<f64>,
    /// Coefficient of static friction.
    pub friction: Vec<f64>,
    /// Radius of the edges, m; that of sharp blocks follows from their size.
    pub edge_radius: Vec<f64>,
    /// True if the edges are rounded; the radius of sharp ones only gives them a normal.
    pub rounded: bool,
    /// Constants of the springs of contacts.
    pub spring: ContactSpring,
    /// Distances of the particles from the centre along the body's axes, m; empty for rigid bodies.
    pub particles: Vec<DVec3>,
}

impl Shapes {
    /// Properties of the blocks of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut shapes = Self::default();
        for block in &scene.blocks {
            let half = DVec3::from(block.size) / 2.0;
            shapes.half.push(half);
            shapes.mass.push(block.mass);
            shapes.radius.push(half.length());
            shapes.friction.push(block.friction.unwrap_or(scene.friction));
            let sharp = SHARP_RADIUS * middle_edge(half);
            let radius = if scene.edge_radius > 0.0 { scene.edge_radius } else { sharp };
            shapes.edge_radius.push(radius.min(MAX_RADIUS * 2.0 * half.min_element()));
        }
        shapes.rounded = scene.edge_radius > 0.0;
        shapes.set_form(scene.form, scene.springs.particles);
        shapes
    }

    /// Appends body `i` of `from`.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.half.push(from.half[i]);
        self.mass.push(from.mass[i]);
        self.inertia.push(from.inertia[i]);
        self.radius.push(from.radius[i]);
        self.friction.push(from.friction[i]);
        self.edge_radius.push(from.edge_radius[i]);
        self.rounded = from.rounded;
        self.spring = from.spring;
        self.particles.extend(from.particles.get(i));
    }

    /// Sets the form of the bodies, and with it particles and inertia.
    pub fn set_form(&mut self, form: Form, particles: Particles) {
        self.particles = match form {
            Form::Rigid => Vec::new(),
            Form::Lattice => self.half.iter().map(|&half| half * particles.inset()).collect(),
        };
        let moments = |half: DVec3| {
            let square = half * half;
            DVec3::new(square.y + square.z, square.z + square.x, square.x + square.y)
        };
        self.inertia = match form {
            // Uniform cuboid: m (ly² + lz²) / 12.
            Form::Rigid => self.mass.iter().zip(&self.half).map(|(mass, &half)| mass / 3.0 * moments(half)).collect(),
            Form::Lattice => self.mass.iter().zip(&self.particles).map(|(mass, &half)| *mass * moments(half)).collect(),
        };
    }
}

/// State of the bodies.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Bodies {
    /// Positions of the centres, m.
    pub position: Vec<DVec3>,
    /// Orientations, unit quaternions.
    pub orientation: Vec<DQuat>,
    /// Velocities of the centres, m/s. In single precision they are exactly those of the inner
    /// loop.
    pub velocity: Vec<DVec3>,
    /// Angular velocities in the world, rad/s.
    pub spin: Vec<DVec3>,
    /// Mean acceleration between the last two syncs, m/s²: predicts the next travel budget.
    pub acceleration: Vec<f64>,
    /// Detection margin, m.
    pub margin: Vec<f64>,
    /// Pose at the last detection.
    pub detection_pose: Vec<(DVec3, DQuat)>,
    /// Pose at the start of the present rest.
    pub rest_pose: Vec<(DVec3, DQuat)>,
    /// Time at rest, s.
    pub rest_time: Vec<f64>,
    /// Velocity (m/s) and spin (rad/s) at the last test for rest.
    pub rest_twist: Vec<(DVec3, DVec3)>,
    /// True while the body sleeps.
    pub asleep: Vec<bool>,
    /// True if the body was frozen because its state was not finite or ran away.
    pub quarantined: Vec<bool>,
    /// True if the body is held in place and never moves.
    pub fixed: Vec<bool>,
    /// Stretch S of each body, empty for rigid bodies: R S maps the body's frame to the world. It
    /// follows from the particles.
    #[serde(skip)]
    pub stretch: Vec<DMat3>,
}

impl Bodies {
    /// Blocks of a scene.
    pub fn new(scene: &Scene) -> Self {
        let n = scene.blocks.len();
        let position: Vec<DVec3> = scene.blocks.iter().map(|b| b.pos.into()).collect();
        let orientation: Vec<DQuat> = scene.blocks.iter().map(|b| DQuat::from_array(b.rotation())).collect();
        let poses: Vec<_> = position.iter().copied().zip(orientation.iter().copied()).collect();
        Self {
            velocity: scene.blocks.iter().map(|b| b.velocity.into()).collect(),
            spin: scene.blocks.iter().map(|b| b.spin.into()).collect(),
            acceleration: vec![0.0; n],
            margin: vec![0.0; n],
            detection_pose: poses.clone(),
            rest_pose: poses,
            rest_time: vec![0.0; n],
            rest_twist: vec![(DVec3::ZERO, DVec3::ZERO); n],
            asleep: vec![false; n],
            quarantined: vec![false; n],
            fixed: scene.blocks.iter().map(|b| b.fixed).collect(),
            stretch: Vec::new(),
            position,
            orientation,
        }
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Appends body `i` of `from`.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.position.push(from.position[i]);
        self.orientation.push(from.orientation[i]);
        self.velocity.push(from.velocity[i]);
        self.spin.push(from.spin[i]);
        self.acceleration.push(from.acceleration[i]);
        self.margin.push(from.margin[i]);
        self.detection_pose.push(from.detection_pose[i]);
        self.rest_pose.push(from.rest_pose[i]);
        self.rest_time.push(from.rest_time[i]);
        self.rest_twist.push(from.rest_twist[i]);
        self.asleep.push(from.asleep[i]);
        self.quarantined.push(from.quarantined[i]);
        self.fixed.push(from.fixed[i]);
        self.stretch.extend(from.stretch.get(i));
    }

    /// Returns true if every stored field has `n` entries.
    pub fn has_len(&self, n: usize) -> bool {
        let vectors = [&self.position, &self.velocity, &self.spin];
        let scalars = [&self.acceleration, &self.margin, &self.rest_time];
        let flags = [&self.asleep, &self.quarantined, &self.fixed];
        vectors.iter().all(|x| x.len() == n)
            && scalars.iter().all(|x| x.len() == n)
            && flags.iter().all(|x| x.len() == n)
            && [&self.detection_pose, &self.rest_pose].iter().all(|x| x.len() == n)
            && self.orientation.len() == n
            && self.rest_twist.len() == n
    }

    /// Returns true if forces move the body.
    pub fn is_active(&self, i: usize) -> bool {
        !self.asleep[i] && !self.is_immovable(i)
    }

    /// Returns true if nothing moves the body, neither forces nor a touch that would wake it.
    pub fn is_immovable(&self, i: usize) -> bool {
        self.quarantined[i] || self.fixed[i]
    }

    /// Upper bound of the speed of a body's points, m/s.
    pub fn max_point_speed(&self, shapes: &Shapes, i: usize) -> f64 {
        self.velocity[i].length() + self.spin[i].length() * shapes.radius[i]
    }

    /// Kinetic energy of a body that moves as a whole, J.
    pub fn kinetic_energy(&self, shapes: &Shapes, i: usize) -> f64 {
        let (velocity, spin) = (self.velocity[i], self.spin[i]);
        0.5 * shapes.mass[i] * velocity.length_squared() + 0.5 * spin.dot(self.inertia(shapes, i) * spin)
    }

    /// Upper bound of the displacement of a body's points from another pose, m.
    pub fn travel_since(&self, shapes: &Shapes, i: usize, pose: (DVec3, DQuat)) -> f64 {
        (self.position[i] - pose.0).length() + rotation_between(pose.1, self.orientation[i]).length() * shapes.radius[i]
    }

    /// Inertia tensor in the world, kg m².
    pub fn inertia(&self, shapes: &Shapes, i: usize) -> DMat3 {
        world_tensor(self.orientation[i], shapes.inertia[i])
    }

    /// Inverse inertia tensor in the world, 1/(kg m²).
    pub fn inv_inertia(&self, shapes: &Shapes, i: usize) -> DMat3 {
        world_tensor(self.orientation[i], shapes.inertia[i].recip())
    }

    /// Centre (m) and axes of a body; those of the world for the floor.
    pub fn pose(&self, i: u32) -> (DVec3, DMat3) {
        if i == FLOOR {
            (DVec3::ZERO, DMat3::IDENTITY)
        } else {
            (self.position[i as usize], DMat3::from_quat(self.orientation[i as usize]))
        }
    }

    /// Velocity (m/s) of a body at a point of the world, and its spin (rad/s); zero for the floor.
    pub fn twist_at(&self, i: u32, point: DVec3) -> (DVec3, DVec3) {
        if i == FLOOR {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let i = i as usize;
        (self.velocity[i] + self.spin[i].cross(point - self.position[i]), self.spin[i])
    }

    /// Square of a speed, m²/s²: points of a body are at most the root of two times as fast.
    pub fn squared_speed_bound(&self, shapes: &Shapes, i: usize) -> f64 {
        let radius = shapes.radius[i];
        self.velocity[i].length_squared() + self.spin[i].length_squared() * (radius * radius)
    }

    /// Stretch of a body; none for rigid bodies and the floor.
    pub fn stretch_of(&self, i: u32) -> Option<&DMat3> {
        self.stretch.get(i as usize)
    }

    /// Affine map from a body's frame to the world: centre (m) and strained axes.
    pub fn affine(&self, i: u32) -> (DVec3, DMat3) {
        let (center, axes) = self.pose(i);
        (center, self.strained(i, axes))
    }

    /// Axes of a body with its strain applied.
    pub fn strained(&self, i: u32, axes: DMat3) -> DMat3 {
        self.stretch_of(i).map_or(axes, |stretch| axes * *stretch)
    }

    /// Half edge lengths of a body with its strain applied, m.
    pub fn half(&self, shapes: &Shapes, i: usize) -> DVec3 {
        self.stretch.get(i).map_or(shapes.half[i], |s| {
            shapes.half[i] * DVec3::new(s.x_axis.x, s.y_axis.y, s.z_axis.z).max(MIN_STRETCH)
        })
    }
}

/// Speed about the centre of the fastest point of a box with these half edges (m) at a spin in its
/// own frame (rad/s), m/s; exact about its axes, else an upper bound, at most by a quarter above.
pub fn point_speed(half: DVec3, spin: DVec3) -> f64 {
    let spin = spin.abs();
    DVec3::new(spin.y * half.z + spin.z * half.y, spin.z * half.x + spin.x * half.z, spin.x * half.y + spin.y * half.x)
        .length()
}

/// Length of the middle one of the three edges of a box with these half edges, m.
pub fn middle_edge(half: DVec3) -> f64 {
    let [x, y, z] = half.to_array();
    2.0 * x.max(y).min(x.max(z)).min(y.max(z))
}

/// Area of the largest face of a box with these half edges, m².
pub fn largest_face(half: DVec3) -> f64 {
    4.0 * (half.x * half.y).max(half.y * half.z).max(half.z * half.x)
}

/// Force and torque on a body.
#[derive(Debug, Clone, Copy, Default)]
pub struct BodyForce {
    /// Force, N.
    pub force: DVec3,
    /// Lever arm of the force, from the centre of the body, m.
    pub arm: DVec3,
    /// Torque in addition to that of the force, N m.
    pub torque: DVec3,
}

impl BodyForce {
    /// Power at a velocity of the centre (m/s) and a spin (rad/s), W.
    pub fn power(&self, (v, w): (DVec3, DVec3)) -> f64 {
        self.force.dot(v + w.cross(self.arm)) + self.torque.dot(w)
    }
}

/// Rotated diagonal tensor, R diag(d) Rᵀ, with the rotation as a quaternion.
pub fn world_tensor(q: DQuat, d: DVec3) -> DMat3 {
    rotate_tensor(DMat3::from_quat(q), d)
}

/// Rotated diagonal tensor, R diag(d) Rᵀ.
pub fn rotate_tensor(r: DMat3, d: DVec3) -> DMat3 {
    DMat3::from_cols(r.x_axis * d.x, r.y_axis * d.y, r.z_axis * d.z) * r.transpose()
}

/// Rotation vector between two orientations, rad, accurate to third order: for small rotations.
pub fn rotation_between(from: DQuat, to: DQuat) -> DVec3 {
    let q = to * from.conjugate();
    let v = DVec3::new(q.x, q.y, q.z);
    if q.w < 0.0 { v * -2.0 } else { v * 2.0 }
}

/// Rotates `q` by a rotation vector, rad. Uses tan(x/2) = x/2 + x³/24, which is exact to fifth
/// order, and returns a unit quaternion.
pub fn rotated(q: DQuat, rotation: DVec3) -> DQuat {
    let half = rotation * (0.5 * (1.0 + rotation.length_squared() / 12.0));
    (DQuat::from_xyzw(half.x, half.y, half.z, 1.0) * q).normalize()
}
