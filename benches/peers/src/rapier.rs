//! Rapier.
//!
//! Its tolerances are for bodies of about a metre, so the scene is scaled at constant density:
//! lengths and gravity by the scale, masses by its third power and forces by its fourth. Times stay
//! the same.

use glam::{DQuat, DVec3};
use rapier3d::prelude::*;
use teeter_scene::Scene;

use crate::engine::{Engine, FRAME, Pull};

/// Changes from the defaults of `IntegrationParameters`.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Name in the table.
    pub name: &'static str,
    /// Length units of the engine in a metre of the scene.
    pub scale: f64,
    /// Number of steps in a frame of 1/60 s.
    pub steps: usize,
    /// Number of solver iterations, `num_solver_iterations`.
    pub iterations: usize,
    /// Natural frequency of a contact, Hz, doubled for contacts with the floor as in the defaults.
    /// Defaults to that of Rapier.
    pub contact_hertz: Option<f64>,
    /// True for Coulomb friction at each contact point instead of the simplified model.
    pub coulomb: bool,
}

/// Measured settings.
pub const SETTINGS: [Setting; 3] = [
    Setting { name: "default", scale: 10.0, steps: 1, iterations: 4, contact_hertz: None, coulomb: false },
    Setting { name: "best", scale: 100.0, steps: 4, iterations: 8, contact_hertz: Some(480.0), coulomb: true },
    Setting { name: "stiff", scale: 100.0, steps: 4, iterations: 32, contact_hertz: Some(1920.0), coulomb: true },
];

impl Setting {
    fn parameters(&self) -> IntegrationParameters {
        let mut p = IntegrationParameters {
            dt: (FRAME / self.steps as f64) as f32,
            num_solver_iterations: self.iterations,
            friction_model: if self.coulomb { FrictionModel::Coulomb } else { FrictionModel::Simplified },
            ..IntegrationParameters::default()
        };
        if let Some(hertz) = self.contact_hertz {
            p.contact_softness.natural_frequency = hertz as f32;
            p.static_contact_softness.natural_frequency = 2.0 * hertz as f32;
        }
        p
    }

    /// Returns the values of the setting as text.
    pub fn details(&self) -> String {
        let p = self.parameters();
        format!(
            "lengths and gravity x {}, length_unit 1, dt 1/{} s, num_solver_iterations {}, contact_softness {} Hz (fixed bodies {} Hz), damping ratio {}, FrictionModel::{:?}, the rest default",
            self.scale,
            60 * self.steps,
            self.iterations,
            p.contact_softness.natural_frequency,
            p.static_contact_softness.natural_frequency,
            p.contact_softness.damping_ratio,
            p.friction_model,
        )
    }
}

/// World of Rapier.
pub struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    setting: Setting,
}

impl Rapier {
    /// Builds a world of a scene.
    pub fn new(scene: &Scene, setting: Setting) -> Self {
        let s = setting.scale;
        let mut world = PhysicsWorld { integration_parameters: setting.parameters(), ..PhysicsWorld::default() };
        world.gravity = vector(DVec3::new(0.0, 0.0, -scene.gravity * s));
        let material = |collider: ColliderBuilder| collider.friction(scene.friction as f32).restitution(0.0);
        // The floor is 2 m square and 0.2 m thick, with its top at z = 0.
        let floor = ColliderBuilder::cuboid(s as f32, s as f32, 0.1 * s as f32);
        world.insert(RigidBodyBuilder::fixed().translation(vector(DVec3::new(0.0, 0.0, -0.1 * s))), material(floor));
        let bodies = scene.blocks.iter().map(|block| {
            let [x, y, z] = block.size.map(|l| (0.5 * l * s) as f32);
            let kind = if block.fixed { RigidBodyBuilder::fixed() } else { RigidBodyBuilder::dynamic() };
            let body = kind
                .translation(vector(DVec3::from(block.pos) * s))
                .rotation(vector(DQuat::from_array(block.rotation()).to_scaled_axis()))
                .can_sleep(false);
            let collider = ColliderBuilder::cuboid(x, y, z).mass((block.mass * s.powi(3)) as f32);
            world.insert(body, material(collider)).0
        });
        let bodies = bodies.collect();
        Self { world, bodies, setting }
    }

    /// Sets the acceleration of free fall, m/s².
    pub fn set_gravity(&mut self, gravity: DVec3) {
        self.world.gravity = vector(gravity * self.setting.scale);
    }

    /// Time of a step, s.
    pub fn step_seconds(&self) -> f64 {
        FRAME / self.setting.steps as f64
    }

    /// Advances by one step under forces (N) at the centres of blocks.
    ///
    /// # Panics
    /// When there is no such block.
    pub fn step(&mut self, forces: &[(usize, DVec3)]) {
        for &(body, force) in forces {
            let body = &mut self.world.bodies[self.bodies[body]];
            body.reset_forces(true);
            body.add_force(vector(force * self.setting.scale.powi(4)), true);
        }
        self.world.step();
        for &(body, _) in forces {
            self.world.bodies[self.bodies[body]].reset_forces(true);
        }
    }
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Engine for Rapier {
    fn frame(&mut self, pull: Option<Pull>) {
        for i in 0..self.setting.steps {
            let force = pull.map(|pull| (pull.body, pull.at(i, self.setting.steps)));
            self.step(force.as_slice());
        }
    }

    fn pose(&self, body: usize) -> (DVec3, DQuat) {
        let body = &self.world.bodies[self.bodies[body]];
        let (p, q) = (body.translation(), body.rotation());
        let position = DVec3::new(p.x.into(), p.y.into(), p.z.into()) / self.setting.scale;
        (position, DQuat::from_xyzw(q.x.into(), q.y.into(), q.z.into(), q.w.into()).normalize())
    }
}
