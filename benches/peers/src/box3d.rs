//! Box3D, through its C interface.
//!
//! Its tolerances are for bodies of about a metre, so the scene is scaled at constant density:
//! lengths and gravity by the scale, masses by its third power and forces by its fourth. Times stay
//! the same.

use box3d_sys as b3;
use glam::{DQuat, DVec3};
use teeter_scene::Scene;

use crate::engine::{Engine, FRAME, Pull};

/// Changes from the defaults of `b3WorldDef`, and the number of substeps.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Name in the table.
    pub name: &'static str,
    /// Length units of the engine in a metre of the scene.
    pub scale: f64,
    /// Number of steps in a frame of 1/60 s.
    pub steps: usize,
    /// Number of substeps in a step.
    pub substeps: i32,
    /// `contactHertz`, Hz. Defaults to that of Box3D.
    pub contact_hertz: Option<f32>,
}

/// Measured settings.
pub const SETTINGS: [Setting; 3] = [
    Setting { name: "default", scale: 10.0, steps: 1, substeps: 4, contact_hertz: None },
    Setting { name: "best", scale: 100.0, steps: 2, substeps: 16, contact_hertz: Some(480.0) },
    Setting { name: "stiff", scale: 100.0, steps: 2, substeps: 64, contact_hertz: Some(1920.0) },
];

impl Setting {
    fn world(&self) -> b3::b3WorldDef {
        // SAFETY: the function has no arguments and returns a plain value.
        let mut def = unsafe { b3::b3DefaultWorldDef() };
        def.enableSleep = false;
        def.workerCount = 1;
        if let Some(hertz) = self.contact_hertz {
            def.contactHertz = hertz;
        }
        def
    }

    /// Returns the values of the setting as text.
    pub fn details(&self) -> String {
        let def = self.world();
        format!(
            "lengths and gravity x {}, length units per metre 1, time step 1/{} s, {} substeps, contactHertz {} Hz (Box3D uses {} Hz: at most an eighth of the substep rate), contactDampingRatio {}, the rest default",
            self.scale,
            60 * self.steps,
            self.substeps,
            def.contactHertz,
            def.contactHertz.min(0.125 * 60.0 * (self.steps as i32 * self.substeps) as f32),
            def.contactDampingRatio,
        )
    }
}

/// World of Box3D.
pub struct Box3d {
    world: b3::b3WorldId,
    bodies: Vec<b3::b3BodyId>,
    setting: Setting,
}

impl Box3d {
    /// Builds a world of a scene.
    pub fn new(scene: &Scene, setting: Setting) -> Self {
        let s = setting.scale;
        let mut def = setting.world();
        def.gravity = vector(DVec3::new(0.0, 0.0, -scene.gravity * s));
        // SAFETY: the definition is complete and outlives the call.
        let world = unsafe { b3::b3CreateWorld(&def) };
        let add = |kind, position: DVec3, yaw: f64, half: DVec3, density: f64| {
            // SAFETY: the world exists, and definitions and hull outlive the calls, which copy
            // them.
            unsafe {
                let mut body = b3::b3DefaultBodyDef();
                body.type_ = kind;
                body.position = vector(position);
                body.rotation.s = (0.5 * yaw).cos() as f32;
                body.rotation.v = vector(DVec3::new(0.0, 0.0, (0.5 * yaw).sin()));
                body.enableSleep = false;
                let id = b3::b3CreateBody(world, &body);
                let mut shape = b3::b3DefaultShapeDef();
                shape.density = density as f32;
                shape.baseMaterial.friction = scene.friction as f32;
                shape.baseMaterial.restitution = 0.0;
                let hull = b3::b3MakeBoxHull(half.x as f32, half.y as f32, half.z as f32);
                b3::b3CreateHullShape(id, &shape, &hull.base);
                id
            }
        };
        // The floor is 2 m square and 0.2 m thick, with its top at z = 0.
        add(b3::b3BodyType_b3_staticBody, DVec3::new(0.0, 0.0, -0.1 * s), 0.0, DVec3::new(s, s, 0.1 * s), 1.0);
        let bodies = scene.blocks.iter().map(|block| {
            let size = DVec3::from(block.size);
            let density = block.mass / size.element_product();
            add(b3::b3BodyType_b3_dynamicBody, DVec3::from(block.pos) * s, block.yaw, 0.5 * s * size, density)
        });
        Self { world, bodies: bodies.collect(), setting }
    }
}

impl Drop for Box3d {
    fn drop(&mut self) {
        // SAFETY: the world exists and nothing else refers to it.
        unsafe { b3::b3DestroyWorld(self.world) }
    }
}

fn vector(v: DVec3) -> b3::b3Vec3 {
    b3::b3Vec3 { x: v.x as f32, y: v.y as f32, z: v.z as f32 }
}

impl Engine for Box3d {
    fn frame(&mut self, pull: Option<Pull>) {
        let Setting { steps, substeps, scale, .. } = self.setting;
        for i in 0..steps {
            // SAFETY: world and body exist.
            unsafe {
                if let Some(pull) = pull {
                    b3::b3Body_ApplyForceToCenter(
                        self.bodies[pull.body],
                        vector(pull.at(i, steps) * scale.powi(4)),
                        true,
                    );
                }
                b3::b3World_Step(self.world, (FRAME / steps as f64) as f32, substeps);
            }
        }
    }

    fn pose(&self, body: usize) -> (DVec3, DQuat) {
        // SAFETY: the body exists.
        let (p, q) = unsafe { (b3::b3Body_GetPosition(self.bodies[body]), b3::b3Body_GetRotation(self.bodies[body])) };
        let position = DVec3::new(p.x.into(), p.y.into(), p.z.into()) / self.setting.scale;
        (position, DQuat::from_xyzw(q.v.x.into(), q.v.y.into(), q.v.z.into(), q.s.into()).normalize())
    }
}
