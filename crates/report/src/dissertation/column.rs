//! Columns of the report: the simulators side by side.

use teeter_dissertation::jenga3d::{Constants, Disabling};
use teeter_scene::{Form, Scene};

use super::engine::Engine;
use super::springs::Springs;
use super::tower::Tower;
use crate::error::Error;

/// Builds the tower of a scene with the constants of 2003. The engine takes gravity and friction
/// from them, so that all columns have the same.
pub type Build = fn(&Scene, &Constants) -> Result<Tower, Error>;

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
    Column { name: "2003 method", build: springs, awake: springs_awake },
    Column {
        name: "2003 with 6.3",
        build: |scene, constants| springs(scene, &with_future_work(constants)),
        awake: |scene, constants| springs_awake(scene, &with_future_work(constants)),
    },
    ENGINE[0],
    ENGINE[1],
];

/// Columns of the engine.
pub const ENGINE: [Column; 2] = [
    Column {
        name: "lattice",
        build: |scene, constants| engine(scene, constants, Form::Lattice, true),
        awake: |scene, constants| engine(scene, constants, Form::Lattice, false),
    },
    Column {
        name: "rigid",
        build: |scene, constants| engine(scene, constants, Form::Rigid, true),
        awake: |scene, constants| engine(scene, constants, Form::Rigid, false),
    },
];

/// Time after which nothing rests in a report, s.
const NEVER: f64 = 60.0;

/// Names of all columns behind other headings of a table.
pub fn headings<const N: usize>(first: [&'static str; N]) -> impl Iterator<Item = &'static str> {
    first.into_iter().chain(COLUMNS.iter().map(|column| column.name))
}

fn springs(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
    Ok(Tower::new(Springs::new(scene, constants.clone())?))
}

fn springs_awake(scene: &Scene, constants: &Constants) -> Result<Tower, Error> {
    springs(scene, &Constants { rest_time: NEVER, ..constants.clone() })
}

/// Adds the future work of section 6.3: rest by rigid motion over a time, and static friction, as
/// large as the kinetic one where the constants have none.
fn with_future_work(constants: &Constants) -> Constants {
    let static_friction = constants.static_friction.or(Some(constants.friction));
    Constants { static_friction, disabling: Disabling::Rigid, ..constants.clone() }
}

fn engine(scene: &Scene, constants: &Constants, form: Form, sleep: bool) -> Result<Tower, Error> {
    Ok(Tower::new(Engine::new(&with_material(scene, constants), form, sleep)?))
}

/// Scene with the gravity and friction of the constants.
fn with_material(scene: &Scene, constants: &Constants) -> Scene {
    let kinetic = kinetic_friction(constants);
    let friction = constants.static_friction.filter(|_| constants.friction_enabled).unwrap_or(kinetic);
    let kinetic_friction = (kinetic < friction).then_some(kinetic);
    Scene { gravity: constants.gravity, friction, kinetic_friction, ..scene.clone() }
}

/// Coefficient of the friction of a sliding block.
pub fn kinetic_friction(constants: &Constants) -> f64 {
    let max = constants.static_friction.unwrap_or(f64::INFINITY);
    if constants.friction_enabled { constants.friction.min(max) } else { 0.0 }
}
