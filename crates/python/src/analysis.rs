//! Measurements of towers and games.

use pyo3::prelude::*;
use serde::Serialize;
use teeter_game::{FallChance, Rules, Survey, TrialErrors};
use teeter_physics::{BodyId, Params};

use crate::argument::{body_of, seed, within};
use crate::error::Kind;
use crate::game::rules_of;
use crate::plain::write;
use crate::pool::detached;
use crate::record::Record;
use crate::scene::scene_of;
use crate::world::{World, unbuilt};

/// Largest simulated time of all rollouts, s.
const MAX_BUDGET: f64 = 1e7;

/// Breakaway forces of all blocks of a scene, a list of dicts: id, forward_N, backward_N (None
/// above 10 N), exact, on_springs_N and load.
///
/// Raises SceneError.
#[pyfunction]
pub fn force_map<'py>(scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = scene.py();
    let scene = scene_of(scene)?;
    let blocks = detached(py, || teeter_study::force_map(&scene, Params::default(), || ()))?;
    write(py, &blocks.map_err(|error| unbuilt(&error))?)
}

/// Builds a scene without one of its blocks, simulates it for 5 s, and returns a dict: id; fell;
/// exact_fell, whether a tower of rigid blocks falls (None where the linear programme was not
/// solved); lean_mm, the largest displacement of any block from where it was built; creep_mm, that
/// after the first 2 s.
///
/// body: index of the block in the scene. Raises SceneError or BodyError.
#[pyfunction]
pub fn remove<'py>(scene: &Bound<'py, PyAny>, body: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = scene.py();
    let scene = scene_of(scene)?;
    let body = body_of(scene.blocks.len(), "body", body)?;
    let removal = detached(py, || teeter_study::remove(&scene, body.index(), Params::default()))?;
    write(py, &removal.map_err(|error| unbuilt(&error))?)
}

#[derive(Serialize)]
struct Block {
    body: BodyId,
    #[serde(flatten)]
    chance: FallChance,
    chance_stuck: f64,
    #[serde(rename = "force_N")]
    force_n: Option<f64>,
    #[serde(rename = "tightness_N")]
    tightness_n: f64,
    held_by: Vec<BodyId>,
    falls_by_statics: Option<bool>,
    toward: [f64; 3],
}

#[derive(Serialize)]
struct Move {
    turn: u32,
    player: u32,
    body: BodyId,
    time_s: f64,
    #[serde(flatten)]
    chance: FallChance,
    safest_body: Option<BodyId>,
    safest_chance: Option<f64>,
    blunder: bool,
    fell: bool,
}

#[derive(Serialize)]
struct Fall {
    time_s: f64,
    bodies: Vec<BodyId>,
    taken: BodyId,
}

#[derive(Serialize)]
struct Report {
    moves: Vec<Move>,
    fall: Option<Fall>,
}

/// Task of the rollouts, from the arguments.
fn survey(
    rules: Option<&Bound<'_, PyAny>>,
    budget: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<Survey> {
    Ok(Survey {
        rules: rules.map_or_else(|| Ok(Rules::default()), |rules| rules_of(rules, 2))?,
        errors: TrialErrors::default(),
        budget: budget.map_or(Ok(0.0), |budget| within("budget", budget, 0.0..=MAX_BUDGET))?,
        seed: seed.map_or(Ok(0), self::seed)?,
    })
}

/// Tries taking each block of a world at rest on copies, and returns a list of dicts in order of
/// the bodies: body, chance_of_fall with the ends of its interval of 95 % low and high, rollouts,
/// chance_stuck, force_N, tightness_N, held_by, falls_by_statics and toward.
///
/// budget: simulated time of all rollouts, s; each block is tried once at the least. Raises
/// InputError or RulesError.
#[pyfunction]
#[pyo3(signature = (world, *, rules=None, budget=None, seed=None))]
#[pyo3(text_signature = "(world, *, rules='free', budget=0.0, seed=0)")]
pub fn analyse<'py>(
    py: Python<'py>,
    world: &Bound<'py, World>,
    rules: Option<&Bound<'py, PyAny>>,
    budget: Option<&Bound<'py, PyAny>>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let survey = survey(rules, budget, seed)?;
    let world = world.try_borrow()?.world.clone();
    let blocks = detached(py, || teeter_game::analyse_tower(&world, &survey, || ()))?;
    let blocks = blocks.map_err(|error| unbuilt(&error))?.into_iter().map(|block| Block {
        body: block.candidate.body,
        chance: block.tally.falls.into(),
        chance_stuck: block.tally.stuck.share(),
        force_n: block.force_n,
        tightness_n: block.candidate.tightness_n,
        held_by: block.held_by,
        falls_by_statics: block.candidate.falls,
        toward: block.candidate.toward.to_array(),
    });
    write(py, &blocks.collect::<Vec<_>>())
}

/// Tries each move of a recorded game again, and returns a dict: moves, a list of dicts, and fall,
/// None where no block fell.
///
/// budget: simulated time of all rollouts, s. Raises RecordError or InputError.
#[pyfunction]
#[pyo3(signature = (record, *, budget=None, seed=None), text_signature = "(record, *, budget=0.0, seed=0)")]
pub fn breakdown<'py>(
    py: Python<'py>,
    record: &Bound<'py, Record>,
    budget: Option<&Bound<'py, PyAny>>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let record = &record.get().record;
    let survey = Survey { rules: record.rules, ..survey(None, budget, seed)? };
    let breakdown = detached(py, || teeter_game::breakdown(record, &survey, || ()))?;
    let breakdown = breakdown.map_err(|error| Kind::Record.error(error))?;
    let moves = breakdown.moves.iter().map(|played| Move {
        turn: played.turn,
        player: played.player,
        body: played.body,
        time_s: played.time_s,
        chance: played.falls.into(),
        safest_body: played.safest.map(|(body, _)| body),
        safest_chance: played.safest.map(|(_, falls)| falls.share()),
        blunder: played.is_blunder(),
        fell: played.fell,
    });
    let fall = breakdown.fall.as_ref();
    let fall = fall.map(|fall| Fall { time_s: fall.time_s, bodies: fall.bodies.clone(), taken: fall.taken });
    write(py, &Report { moves: moves.collect(), fall })
}
