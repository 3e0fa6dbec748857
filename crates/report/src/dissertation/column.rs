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
}

/// Columns, the dissertation's method first.
pub const COLUMNS: &[Column] = &[
    Column { name: "2003 method", build: springs },
    Column { name: "2003 with 6.3", build: springs_with_future_work },
    ENGINE[0],
    ENGINE[1],
];

/// Columns of the engine.
pub const ENGINE: [Column; 2] = [Column { name: "lattice", build: lattice }, Column { name: "rigid", build: rigid }];

/// Names of all columns behind other headings of a table.
pub fn headings<const N: usize>(first: [&'static str; N]) -> impl Iterator<Item = &'static str> {
    first.into_iter().chain(COLUMNS.iter().map(|column| column.name))
}

fn springs(scene: &Scene) -> Result<Tower, Error> {
    Ok(Tower::new(Springs::new(scene, Constants::default())?))
}

/// Adds the future work of section 6.3: static friction, and rest by rigid motion.
fn springs_with_future_work(scene: &Scene) -> Result<Tower, Error> {
    let constants = Constants { static_friction: Some(0.4), disabling: Disabling::Rigid, ..Constants::default() };
    Ok(Tower::new(Springs::new(scene, constants)?))
}

fn lattice(scene: &Scene) -> Result<Tower, Error> {
    Ok(Tower::new(Engine::new(scene, Form::Lattice)?))
}

fn rigid(scene: &Scene) -> Result<Tower, Error> {
    Ok(Tower::new(Engine::new(scene, Form::Rigid)?))
}
