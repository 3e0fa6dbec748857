//! Rigid bodies: what they are ([`Shapes`], constant) and where they are ([`Bodies`], changing). One array a field, in order of
//! creation.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_scene::{Form, Particles, Scene};

/// A block of springs counts as no thinner than this part of what it was, along any axis.
const LEAST_STRETCH: DVec3 = DVec3::splat(0.05);

/// No body: the floor.
pub const FLOOR: u32 = u32::MAX;

/// What does not change about the bodies.
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
    /// Distances of its particles from the centre along its axes, m; empty where bodies are rigid.
    pub particles: Vec<DVec3>,
}

impl Shapes {
    pub fn new(scene: &Scene) -> Self {
        let mut shapes = Self::default();
        for block in &scene.blocks {
            let half = DVec3::from(block.size) / 2.0;
            shapes.half.push(half);
            shapes.mass.push(block.mass);
            shapes.radius.push(half.length());
        }
        shapes.set_form(scene.form, scene.springs.particles);
        shapes
    }

    /// Takes body `i` of others.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.half.push(from.half[i]);
        self.mass.push(from.mass[i]);
        self.inertia.push(from.inertia[i]);
        self.radius.push(from.radius[i]);
        self.particles.extend(from.particles.get(i));
    }

    /// Gives the bodies particles, or takes them.
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
            // uniform cuboid: m (ly² + lz²) / 12
            Form::Rigid => self.mass.iter().zip(&self.half).map(|(mass, &half)| mass / 3.0 * moments(half)).collect(),
            Form::Lattice => self.mass.iter().zip(&self.particles).map(|(mass, &half)| *mass * moments(half)).collect(),
        };
    }
}

/// Where the bodies are and how they move.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Bodies {
    /// Centres, m.
    pub position: Vec<DVec3>,
    /// Orientations, unit quaternions.
    pub orientation: Vec<DQuat>,
    /// Velocities of the centres, m/s. In single precision they hold what the loop holds, exactly.
    pub velocity: Vec<DVec3>,
    /// Angular velocities in the world, rad/s.
    pub spin: Vec<DVec3>,
    /// Mean acceleration since the last sync, m/s²: an estimate for the next bound.
    pub acceleration: Vec<f64>,
    /// Detection margin, m.
    pub margin: Vec<f64>,
    /// Pose at the last detection.
    pub detected: Vec<(DVec3, DQuat)>,
    /// Pose at the start of the present rest.
    pub rested: Vec<(DVec3, DQuat)>,
    /// How long the body has been at rest, s.
    pub rest: Vec<f64>,
    /// Velocity and spin at the last look for rest.
    pub rest_velocity: Vec<(DVec3, DVec3)>,
    /// Whether the body sleeps.
    pub asleep: Vec<bool>,
    /// Whether the body was taken out because its state was not finite or ran away.
    pub quarantined: Vec<bool>,
    /// How each is strained: what turned by its orientation makes its places in the world of those in its frame. Follows from its particles;
    /// empty where bodies are rigid.
    #[serde(skip)]
    pub stretch: Vec<DMat3>,
}

impl Bodies {
    pub fn new(scene: &Scene) -> Self {
        let n = scene.blocks.len();
        let position: Vec<DVec3> = scene.blocks.iter().map(|b| b.pos.into()).collect();
        let orientation: Vec<DQuat> = scene
            .blocks
            .iter()
            .map(|b| DQuat::from_xyzw(0.0, 0.0, libm::sin(b.yaw / 2.0), libm::cos(b.yaw / 2.0)).normalize())
            .collect();
        let poses: Vec<_> = position.iter().copied().zip(orientation.iter().copied()).collect();
        Self {
            velocity: vec![DVec3::ZERO; n],
            spin: vec![DVec3::ZERO; n],
            acceleration: vec![0.0; n],
            margin: vec![0.0; n],
            detected: poses.clone(),
            rested: poses,
            rest: vec![0.0; n],
            rest_velocity: vec![(DVec3::ZERO, DVec3::ZERO); n],
            asleep: vec![false; n],
            quarantined: vec![false; n],
            stretch: Vec::new(),
            position,
            orientation,
        }
    }

    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Takes body `i` of others.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.position.push(from.position[i]);
        self.orientation.push(from.orientation[i]);
        self.velocity.push(from.velocity[i]);
        self.spin.push(from.spin[i]);
        self.acceleration.push(from.acceleration[i]);
        self.margin.push(from.margin[i]);
        self.detected.push(from.detected[i]);
        self.rested.push(from.rested[i]);
        self.rest.push(from.rest[i]);
        self.rest_velocity.push(from.rest_velocity[i]);
        self.asleep.push(from.asleep[i]);
        self.quarantined.push(from.quarantined[i]);
        self.stretch.extend(from.stretch.get(i));
    }

    /// Whether there are `n` of them, in every field.
    pub fn is_of(&self, n: usize) -> bool {
        let vectors = [&self.position, &self.velocity, &self.spin];
        let numbers = [&self.acceleration, &self.margin, &self.rest];
        let answers = [&self.asleep, &self.quarantined];
        vectors.iter().all(|x| x.len() == n)
            && numbers.iter().all(|x| x.len() == n)
            && answers.iter().all(|x| x.len() == n)
            && [&self.detected, &self.rested].iter().all(|x| x.len() == n)
            && self.orientation.len() == n
            && self.rest_velocity.len() == n
    }

    /// Whether forces move the body.
    pub fn moves(&self, i: usize) -> bool {
        !self.asleep[i] && !self.quarantined[i]
    }

    /// Fastest that a point of a body can be, m/s.
    pub fn point_speed(&self, shapes: &Shapes, i: usize) -> f64 {
        self.velocity[i].length() + self.spin[i].length() * shapes.radius[i]
    }

    /// Farthest that a point of a body can be from where it was in another pose, m.
    pub fn travel(&self, shapes: &Shapes, i: usize, from: (DVec3, DQuat)) -> f64 {
        (self.position[i] - from.0).length() + turn(from.1, self.orientation[i]).length() * shapes.radius[i]
    }

    /// Moment of inertia in the world, kg m².
    pub fn inertia(&self, shapes: &Shapes, i: usize) -> DMat3 {
        world_tensor(self.orientation[i], shapes.inertia[i])
    }

    /// Its inverse.
    pub fn inv_inertia(&self, shapes: &Shapes, i: usize) -> DMat3 {
        world_tensor(self.orientation[i], shapes.inertia[i].recip())
    }

    /// The pose of a body; the floor is the world.
    pub fn pose(&self, i: u32) -> (DVec3, DMat3) {
        if i == FLOOR {
            (DVec3::ZERO, DMat3::IDENTITY)
        } else {
            (self.position[i as usize], DMat3::from_quat(self.orientation[i as usize]))
        }
    }

    /// How a body is strained, where it can be; the floor cannot.
    pub fn stretch_of(&self, i: u32) -> Option<&DMat3> {
        self.stretch.get(i as usize)
    }

    /// Centre of a body, and what makes places from there of those in its frame: its axes, strained as it is.
    pub fn affine(&self, i: u32) -> (DVec3, DMat3) {
        let (center, axes) = self.pose(i);
        (center, self.strained(i, axes))
    }

    /// The axes of a body, strained as it is.
    pub fn strained(&self, i: u32, axes: DMat3) -> DMat3 {
        self.stretch_of(i).map_or(axes, |stretch| axes * *stretch)
    }

    /// Half edge lengths of a body as it is strained, m.
    pub fn half(&self, shapes: &Shapes, i: usize) -> DVec3 {
        self.stretch.get(i).map_or(shapes.half[i], |s| {
            shapes.half[i] * DVec3::new(s.x_axis.x, s.y_axis.y, s.z_axis.z).max(LEAST_STRETCH)
        })
    }
}

/// R diag(d) Rᵀ.
pub fn world_tensor(q: DQuat, d: DVec3) -> DMat3 {
    tensor(DMat3::from_quat(q), d)
}

/// The same of the matrix R.
pub fn tensor(r: DMat3, d: DVec3) -> DMat3 {
    DMat3::from_cols(r.x_axis * d.x, r.y_axis * d.y, r.z_axis * d.z) * r.transpose()
}

/// Rotation vector from `from` to `to`, rad, to third order: for small turns.
pub fn turn(from: DQuat, to: DQuat) -> DVec3 {
    let q = to * from.conjugate();
    let v = DVec3::new(q.x, q.y, q.z);
    if q.w < 0.0 { v * -2.0 } else { v * 2.0 }
}

/// `q` turned by the rotation vector `angle`, rad. Uses tan(x/2) = x/2 + x³/24: exact to fifth order, and of unit length.
pub fn turned(q: DQuat, angle: DVec3) -> DQuat {
    let half = angle * (0.5 * (1.0 + angle.length_squared() / 12.0));
    (DQuat::from_xyzw(half.x, half.y, half.z, 1.0) * q).normalize()
}
