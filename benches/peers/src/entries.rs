//! List of the measured engines and settings.

use teeter_scene::Scene;

use crate::engine::Engine;
use crate::{box3d, rapier, teeter};

/// Setting of an engine: a row of the table.
#[derive(Clone)]
pub struct Entry {
    /// Name of the engine.
    pub engine: &'static str,
    /// Name of the setting.
    pub setting: &'static str,
    /// Values of the setting.
    pub details: String,
    /// Engine and setting.
    pub build: Build,
}

/// Engine with its setting.
#[derive(Clone, Copy)]
pub enum Build {
    /// Teeter.
    Teeter(teeter::Setting),
    /// Rapier.
    Rapier(rapier::Setting),
    /// Box3D.
    Box3d(box3d::Setting),
}

impl Entry {
    /// Builds the engine with a scene at time 0.
    pub fn start(&self, scene: &Scene) -> Box<dyn Engine> {
        match self.build {
            Build::Teeter(setting) => Box::new(teeter::Teeter::new(scene, setting)),
            Build::Rapier(setting) => Box::new(rapier::Rapier::new(scene, setting)),
            Build::Box3d(setting) => Box::new(box3d::Box3d::new(scene, setting)),
        }
    }

    /// Name as `engine setting`.
    pub fn name(&self) -> String {
        format!("{} {}", self.engine, self.setting)
    }
}

/// Returns all engines and settings in the order of the table.
pub fn entries() -> Vec<Entry> {
    let of_teeter = teeter::SETTINGS.iter().map(|s| Entry {
        engine: "Teeter",
        setting: s.name,
        details: s.details(),
        build: Build::Teeter(*s),
    });
    let of_rapier = rapier::SETTINGS.iter().map(|s| Entry {
        engine: "Rapier",
        setting: s.name,
        details: s.details(),
        build: Build::Rapier(*s),
    });
    let of_box3d = box3d::SETTINGS.iter().map(|s| Entry {
        engine: "Box3D",
        setting: s.name,
        details: s.details(),
        build: Build::Box3d(*s),
    });
    of_teeter.chain(of_rapier).chain(of_box3d).collect()
}
