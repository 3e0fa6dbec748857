//! Number and size of the towers of a report.

use serde::Serialize;
use teeter_physics::Params;
use teeter_scene::{Form, Scene, TowerOptions, tower};

/// Choices of the user; none stands for the default.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// True for the small report, which shows in a minute that everything runs.
    pub quick: bool,
    /// Form of the blocks.
    pub form: Option<Form>,
    /// Towers of each kind.
    pub towers: Option<u64>,
    /// Seed of the first tower.
    pub seed: u64,
    /// Simulated rest of all towers together, h.
    pub hours: Option<f64>,
    /// Blocks torn out of a tower, one or a collapse at a time.
    pub collapses: Option<u32>,
}

/// Number and size of the towers of a report.
#[derive(Debug, Clone, Serialize)]
pub struct Size {
    /// Towers of each kind.
    pub towers: u64,
    /// Rows of the towers.
    pub rows: u32,
    /// Seed of the first tower; the others follow it.
    pub seed: u64,
    /// Simulated rest of all towers together, h.
    pub hours: f64,
    /// Blocks torn out of a tower, one or a collapse at a time.
    #[serde(rename = "yanks")]
    pub collapses: usize,
    /// Form of the blocks.
    pub form: Form,
    /// True for the small report.
    pub quick: bool,
}

impl Size {
    /// Fills in the defaults.
    pub fn new(options: &Options) -> Self {
        let default = |quick: f64, full: f64| if options.quick { quick } else { full };
        Self {
            towers: options.towers.unwrap_or(default(2.0, 20.0) as u64),
            rows: default(5.0, 18.0) as u32,
            seed: options.seed,
            hours: options.hours.unwrap_or(default(0.01, 24.0)),
            collapses: options.collapses.map_or(default(10.0, 1000.0) as usize, |count| count as usize),
            form: options.form.unwrap_or_default(),
            quick: options.quick,
        }
    }

    /// Options of a tower.
    pub fn tower_options(&self) -> TowerOptions {
        TowerOptions { rows: self.rows, ..TowerOptions::default() }
    }

    /// Builds `count` towers with successive seeds, at a contact stiffness (N/m).
    pub fn towers(&self, count: u64, stiffness: f64, options: &TowerOptions) -> Vec<Scene> {
        let build = |i: u64| {
            let options = TowerOptions { seed: self.seed.wrapping_add(i), ..options.clone() };
            self.with_form(Scene { stiffness, ..tower(&options).expect("the options of the report are valid") })
        };
        (0..count).map(build).collect()
    }

    /// Returns a scene with the form of blocks of the report.
    pub fn with_form(&self, scene: Scene) -> Scene {
        Scene { form: self.form, ..scene }
    }

    /// Number of towers divided by `divisor`, at least one.
    pub fn share(&self, divisor: u64) -> u64 {
        (self.towers / divisor).max(1)
    }
}

/// Parameters of all runs: stability is judged without sleep.
pub fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}
