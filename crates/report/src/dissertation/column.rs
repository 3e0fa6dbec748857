//! Columns of the report: the simulators side by side.

use teeter_dissertation::jenga3d::{Constants, Disabling};
use teeter_scene::{Form, Scene};

use super::engine::Engine;
use super::springs::Springs;
use super::tower::Tower;
use crate::error::Error;

/// Builds the tower of a scene.
pub type Build = fn(&Scene) -> Result<Tower, Error>;

/// Column of the report.
#[derive(Clone, Copy)]
pub struct Column {
    /// Heading.
    pub name: &'static str,
    /// Simulator.
    pub build: Build,
    /// Simulator whose blocks never come to rest, so that each frame costs what a moving tower
    /// costs.
    pub awake: Build,
}

/// Columns, the dissertation's method first.
pub const COLUMNS: &[Column] = &[
    Column { name: "2003 method", build: springs, awake: springs },
    Column {
        name: "2003 with 6.3",
        build: |scene| with_future_work(scene, Constants::default().rest_time),
        awake: |scene| with_future_work(scene, NEVER),
    },
    ENGINE[0],
    ENGINE[1],
];

/// Columns of the engine.
pub const ENGINE: [Column; 2] = [
    Column {
        name: "lattice",
        build: |scene| engine(scene, Form::Lattice, true),
        awake: |scene| engine(scene, Form::Lattice, false),
    },
    Column {
        name: "rigid",
        build: |scene| engine(scene, Form::Rigid, true),
        awake: |scene| engine(scene, Form::Rigid, false),
    },
];

/// Time after which nothing rests in a report, s.
const NEVER: f64 = 60.0;

/// Names of all columns behind other headings of a table.
pub fn headings<const N: usize>(first: [&'static str; N]) -> impl Iterator<Item = &'static str> {
    first.into_iter().chain(COLUMNS.iter().map(|column| column.name))
}

fn springs(scene: &Scene) -> Result<Tower, Error> {
    Ok(Tower::new(Springs::new(scene, Constants::default())?))
}

/// Adds the future work of section 6.3: static friction, and rest by rigid motion over a time, s.
fn with_future_work(scene: &Scene, rest_time: f64) -> Result<Tower, Error> {
    let constants =
        Constants { static_friction: Some(0.4), disabling: Disabling::Rigid, rest_time, ..Constants::default() };
    Ok(Tower::new(Springs::new(scene, constants)?))
}

fn engine(scene: &Scene, form: Form, sleep: bool) -> Result<Tower, Error> {
    Ok(Tower::new(Engine::new(scene, form, sleep)?))
}
