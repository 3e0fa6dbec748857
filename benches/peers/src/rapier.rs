//! Rapier.
//!
//! Its tolerances are for things of about a metre, so the scene is made larger, density kept: lengths and gravity grow by the scale, masses by
//! its third power and forces by its fourth; times stay as they are.

use glam::{DQuat, DVec3};
use rapier3d::prelude::*;
use teeter_scene::Scene;

use crate::engine::{Engine, FRAME, Pull};

/// What is changed from the defaults of `IntegrationParameters`.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Name in the table.
    pub name: &'static str,
    /// Units of the engine in a metre of the scene.
    pub scale: f64,
    /// Steps in a frame of 1/60 s.
    pub steps: usize,
    /// `num_solver_iterations`.
    pub iterations: usize,
    /// Natural frequency of a contact, Hz, twice as much for one with the floor (as in the defaults); the default where absent.
    pub contact_hertz: Option<f64>,
    /// Friction at each point of contact instead of the simplified model.
    pub coulomb: bool,
}

/// What is measured.
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

    /// The setting in words.
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

/// A world of Rapier.
pub struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    setting: Setting,
}

impl Rapier {
    /// A world with `scene` in it.
    pub fn new(scene: &Scene, setting: Setting) -> Self {
        let s = setting.scale;
        let mut world = PhysicsWorld { integration_parameters: setting.parameters(), ..PhysicsWorld::default() };
        world.gravity = vector(DVec3::new(0.0, 0.0, -scene.gravity * s));
        let material = |collider: ColliderBuilder| collider.friction(scene.friction as f32).restitution(0.0);
        // 2 m square, 0.2 m thick, its top at z = 0
        let floor = ColliderBuilder::cuboid(s as f32, s as f32, 0.1 * s as f32);
        world.insert(RigidBodyBuilder::fixed().translation(vector(DVec3::new(0.0, 0.0, -0.1 * s))), material(floor));
        let bodies = scene.blocks.iter().map(|block| {
            let [x, y, z] = block.size.map(|l| (0.5 * l * s) as f32);
            let body = RigidBodyBuilder::dynamic()
                .translation(vector(DVec3::from(block.pos) * s))
                .rotation(vector(DVec3::new(0.0, 0.0, block.yaw)))
                .can_sleep(false);
            let collider = ColliderBuilder::cuboid(x, y, z).mass((block.mass * s.powi(3)) as f32);
            world.insert(body, material(collider)).0
        });
        let bodies = bodies.collect();
        Self { world, bodies, setting }
    }
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Engine for Rapier {
    fn frame(&mut self, pull: Option<Pull>) {
        for i in 0..self.setting.steps {
            if let Some(pull) = pull {
                let body = &mut self.world.bodies[self.bodies[pull.body]];
                body.reset_forces(true);
                body.add_force(vector(pull.at(i, self.setting.steps) * self.setting.scale.powi(4)), true);
            }
            self.world.step();
        }
    }

    fn pose(&self, body: usize) -> (DVec3, DQuat) {
        let body = &self.world.bodies[self.bodies[body]];
        let (p, q) = (body.translation(), body.rotation());
        let position = DVec3::new(p.x.into(), p.y.into(), p.z.into()) / self.setting.scale;
        (position, DQuat::from_xyzw(q.x.into(), q.y.into(), q.z.into(), q.w.into()).normalize())
    }
}
