//! Teeter.

use glam::{DQuat, DVec3};
use teeter_physics::{AppliedForce, BodyId, Input, Params, Pose, Precision, World};
use teeter_scene::Scene;

use crate::engine::{Engine, FRAME, Pull};

/// Contact stiffness and number format. Everything else has its default, except that sleep is off.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Name in the table.
    pub name: &'static str,
    /// Contact stiffness, N/m.
    pub stiffness: f64,
    /// Precision of the inner loop.
    pub precision: Precision,
}

/// Measured settings.
pub const SETTINGS: [Setting; 4] = [
    Setting { name: "k = 3e5", stiffness: 3e5, precision: Precision::Single },
    Setting { name: "k = 1e6", stiffness: 1e6, precision: Precision::Single },
    Setting { name: "k = 3e6", stiffness: 3e6, precision: Precision::Single },
    Setting { name: "k = 1e6, f64", stiffness: 1e6, precision: Precision::Double },
];

impl Setting {
    fn params(&self) -> Params {
        Params { precision: self.precision, sleep: false, frame: FRAME, ..Params::default() }
    }

    /// Returns the values of the setting as text.
    pub fn details(&self) -> String {
        let format = if self.precision == Precision::Single { "f32" } else { "f64" };
        format!("SI units, stiffness {:e} N/m, inner loop in {format}, frame 1/60 s", self.stiffness)
    }
}

/// World of Teeter.
pub struct Teeter(World);

impl Teeter {
    /// Builds a world of a scene.
    pub fn new(scene: &Scene, setting: Setting) -> Self {
        let scene = Scene { stiffness: setting.stiffness, ..scene.clone() };
        Self(World::new(&scene, setting.params()).expect("the scenes and settings of the bench are valid"))
    }
}

impl Engine for Teeter {
    fn frame(&mut self, pull: Option<Pull>) {
        // The world itself interpolates a force from that of the previous step.
        let forces = pull.iter().map(|p| AppliedForce::at_center(BodyId(p.body as u32), p.to));
        let report = self.0.step(&Input::forces(forces.collect()));
        assert!(report.quarantined.is_empty(), "Teeter froze blocks {:?}", report.quarantined);
    }

    fn pose(&self, body: usize) -> (DVec3, DQuat) {
        let Pose { position, orientation } = self.0.pose(BodyId(body as u32));
        (position, orientation)
    }
}
