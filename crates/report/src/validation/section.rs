//! A part of the report, and how large the measurements are.

use serde::Serialize;
use serde_json::{Value, json};
use teeter_physics::Params;
use teeter_scene::{Form, Scene, TowerOptions, tower};

use super::plot::Plot;

/// One measured figure.
#[derive(Debug, Clone, Serialize)]
pub struct Figure {
    /// What was measured.
    pub what: String,
    /// What came out, with its unit.
    pub value: String,
    /// What it is to be.
    pub goal: Option<String>,
    /// Whether it is.
    pub met: Option<bool>,
}

/// A table.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Table {
    /// Heads of the columns.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

/// A part of the report.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// Short name, for links and selection.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// How it was measured.
    pub method: String,
    /// Figures.
    pub figures: Vec<Figure>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// All of it as data.
    pub data: Value,
}

impl Section {
    /// An empty one.
    pub fn new(name: &'static str, title: &'static str, method: impl Into<String>) -> Self {
        Self { name, title, method: method.into(), ..Self::default() }
    }

    /// Adds a figure that only informs.
    pub fn say(&mut self, what: impl Into<String>, value: impl Into<String>) {
        self.figures.push(Figure { what: what.into(), value: value.into(), goal: None, met: None });
    }

    /// Adds a figure that is to reach a goal.
    pub fn goal(&mut self, what: impl Into<String>, value: impl Into<String>, goal: impl Into<String>, met: bool) {
        self.figures.push(Figure { what: what.into(), value: value.into(), goal: Some(goal.into()), met: Some(met) });
    }

    /// Adds a table.
    pub fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        self.tables.push(Table { head: head.iter().map(|h| (*h).to_owned()).collect(), rows });
    }

    /// The section as data, without its plots.
    pub fn json(&self) -> Value {
        json!({"name": self.name, "title": self.title, "figures": self.figures, "tables": self.tables, "data": self.data})
    }
}

/// What of the size is asked for.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Low towers and few of them.
    pub quick: bool,
    /// What blocks are.
    pub form: Option<Form>,
    /// Towers of each kind.
    pub towers: Option<u64>,
    /// Seed of the first tower.
    pub seed: u64,
    /// Hours of simulated rest.
    pub hours: Option<f64>,
    /// Blocks torn out.
    pub yanks: Option<u32>,
}

/// How large the measurements are.
#[derive(Debug, Clone, Serialize)]
pub struct Size {
    /// Towers of each kind.
    pub towers: u64,
    /// Rows of the towers.
    pub rows: u32,
    /// Seed of the first tower; the others follow it.
    pub seed: u64,
    /// Hours of simulated rest, of all towers together.
    pub hours: f64,
    /// Blocks torn out.
    pub yanks: usize,
    /// What blocks are.
    pub form: Form,
    /// Whether it is the small size of the tests.
    pub quick: bool,
}

impl Size {
    /// What is asked for.
    pub fn of(args: &Options) -> Self {
        let small = |quick: f64, full: f64| if args.quick { quick } else { full };
        Self {
            towers: args.towers.unwrap_or(small(2.0, 20.0) as u64),
            rows: small(5.0, 18.0) as u32,
            seed: args.seed,
            hours: args.hours.unwrap_or(small(0.01, 24.0)),
            yanks: args.yanks.map_or(small(10.0, 1000.0) as usize, |y| y as usize),
            form: args.form.unwrap_or_default(),
            quick: args.quick,
        }
    }

    /// Options of a tower of this size.
    pub fn options(&self) -> TowerOptions {
        TowerOptions { rows: self.rows, ..TowerOptions::default() }
    }

    /// So many towers that differ in their seeds, at a stiffness (N/m).
    pub fn towers(&self, count: u64, stiffness: f64, options: &TowerOptions) -> Vec<Scene> {
        let one = |i: u64| {
            let options = TowerOptions { seed: self.seed.wrapping_add(i), ..options.clone() };
            self.formed(Scene { stiffness, ..tower(&options).expect("the options of the report are valid") })
        };
        (0..count).map(one).collect()
    }

    /// The scene with blocks of this form.
    pub fn formed(&self, scene: Scene) -> Scene {
        Scene { form: self.form, ..scene }
    }

    /// A share of the towers, at least one.
    pub fn share(&self, of: u64) -> u64 {
        (self.towers / of).max(1)
    }
}

/// Constants of all runs: nothing sleeps where stability is judged.
pub fn params() -> Params {
    Params { sleep: false, ..Params::default() }
}
