//! What the bench asks of an engine.

use glam::{DQuat, DVec3};
use teeter_scene::Scene;

/// Time between two looks at an engine, s.
pub const FRAME: f64 = 1.0 / 60.0;

/// A force at the centre of a block that grows evenly during a frame, N.
#[derive(Debug, Clone, Copy)]
pub struct Pull {
    /// Index of the block.
    pub body: usize,
    /// Force at the start of the frame.
    pub from: DVec3,
    /// Force at its end.
    pub to: DVec3,
}

impl Pull {
    /// The force in the step `i` of `n` of a frame: that at its end.
    pub fn at(&self, i: usize, n: usize) -> DVec3 {
        self.from.lerp(self.to, (i + 1) as f64 / n as f64)
    }
}

/// One engine with one scene in it. Lengths are in m and forces in N whatever the engine calculates in; sleep is off, one thread.
pub trait Engine {
    /// Advances by [`FRAME`].
    fn frame(&mut self, pull: Option<Pull>);
    /// Centre (m) and orientation of a block.
    fn pose(&self, body: usize) -> (DVec3, DQuat);
}

/// A setting of an engine: one line of the table.
#[derive(Clone)]
pub struct Entry {
    /// Which engine.
    pub engine: &'static str,
    /// Which of its settings.
    pub setting: &'static str,
    /// The setting spelled out.
    pub details: String,
    /// Builds it with a scene.
    pub build: Build,
}

/// How an engine is built.
#[derive(Clone, Copy)]
pub enum Build {
    /// Teeter.
    Teeter(crate::teeter::Setting),
    /// Rapier.
    Rapier(crate::rapier::Setting),
    /// Box3D.
    Box3d(crate::box3d::Setting),
}

impl Entry {
    /// The engine with the scene as it was built, at time 0.
    pub fn start(&self, scene: &Scene) -> Box<dyn Engine> {
        match self.build {
            Build::Teeter(setting) => Box::new(crate::teeter::Teeter::new(scene, setting)),
            Build::Rapier(setting) => Box::new(crate::rapier::Rapier::new(scene, setting)),
            Build::Box3d(setting) => Box::new(crate::box3d::Box3d::new(scene, setting)),
        }
    }

    /// `engine setting`.
    pub fn name(&self) -> String {
        format!("{} {}", self.engine, self.setting)
    }
}

/// Everything that is measured, in the order of the table.
pub fn entries() -> Vec<Entry> {
    let teeter = crate::teeter::SETTINGS.iter().map(|s| Entry {
        engine: "Teeter",
        setting: s.name,
        details: s.details(),
        build: Build::Teeter(*s),
    });
    let rapier = crate::rapier::SETTINGS.iter().map(|s| Entry {
        engine: "Rapier",
        setting: s.name,
        details: s.details(),
        build: Build::Rapier(*s),
    });
    let box3d = crate::box3d::SETTINGS.iter().map(|s| Entry {
        engine: "Box3D",
        setting: s.name,
        details: s.details(),
        build: Build::Box3d(*s),
    });
    teeter.chain(rapier).chain(box3d).collect()
}
