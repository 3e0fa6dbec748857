//! Scenes: plain dicts, from the list, from options, from a notation and from files.

use std::fs::File;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use teeter_scene::{CardsOptions, MAX_BYTES, NAMED, Scene, SceneError, TowerOptions};

use crate::argument::{count, shown};
use crate::error::Kind;
use crate::plain::{keywords, read, value, write};

/// Scene of an argument: a dict, the name of a scene, a notation such as `(010)-(111)`, or the path
/// of a file.
pub fn scene_of(object: &Bound<'_, PyAny>) -> PyResult<Scene> {
    if let Ok(text) = object.cast::<PyString>() {
        let text = text.to_cow().map_err(|_| Kind::Scene.error("`scene` is no Unicode text"))?;
        if let Some(scene) = teeter_scene::named(&text) {
            return Ok(scene);
        }
        if text.starts_with('(') {
            return teeter_scene::config(&text, &TowerOptions::exact()).map_err(|error| rejected(&error));
        }
        return from_file(PathBuf::from(text.as_ref()));
    }
    if object.hasattr("__fspath__")? {
        return from_file(object.extract()?);
    }
    if !object.is_instance_of::<PyDict>() {
        let message = format!("`scene` is {}, expected a dict, a name, a notation or a path", shown(object));
        return Err(Kind::Scene.error(message));
    }
    let text = value(Kind::Scene, "scene", object)?.to_string();
    Scene::from_json(&text).map_err(|error| rejected(&error))
}

/// Exception of a scene that is rejected.
pub fn rejected(error: &SceneError) -> PyErr {
    match error {
        // Lines and columns are those of a text that the caller never saw.
        SceneError::Json { location, message, .. } => Kind::Scene.error(format_args!("{location}{message}")),
        error => Kind::Scene.error(error),
    }
}

/// Scene as a dict.
pub fn dict<'py>(py: Python<'py>, scene: &Scene) -> PyResult<Bound<'py, PyAny>> {
    write(py, scene)
}

fn from_file(path: PathBuf) -> PyResult<Scene> {
    let shown = path.display();
    let file = File::open(&path).map_err(|error| {
        let names: Vec<&str> = NAMED.iter().map(|entry| entry.name).collect();
        Kind::Scene.error(format_args!(
            "`scene` is {shown}, neither a file that can be read ({error}) nor one of {}",
            names.join(", ")
        ))
    })?;
    Scene::read(file, MAX_BYTES).map_err(|error| Kind::Scene.error(format_args!("{shown}: {error}")))
}

/// Names of the scenes of the list.
#[pyfunction]
pub fn names() -> Vec<&'static str> {
    NAMED.iter().map(|entry| entry.name).collect()
}

/// Scene of the list with this name, as a dict.
#[pyfunction]
pub fn named<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let scene = teeter_scene::named(name);
    let scene = scene
        .ok_or_else(|| Kind::Scene.error(format_args!("`name` is '{name}', expected one of {}", names().join(", "))))?;
    dict(py, &scene)
}

/// Scene of an argument, checked, as a dict.
#[pyfunction]
pub fn load<'py>(scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    dict(scene.py(), &scene_of(scene)?)
}

/// Full tower, as a dict.
#[pyfunction]
#[pyo3(signature = (**options))]
pub fn tower<'py>(py: Python<'py>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
    let options: TowerOptions = keywords(Kind::Scene, options)?;
    dict(py, &teeter_scene::tower(&options).map_err(|error| rejected(&error))?)
}

/// Full towers in a square field, as a dict.
#[pyfunction]
#[pyo3(signature = (towers, **options))]
pub fn field<'py>(towers: &Bound<'py, PyAny>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
    let count = count("towers", towers, 1..=10_000)? as u32;
    let options: TowerOptions = keywords(Kind::Scene, options)?;
    dict(towers.py(), &teeter_scene::field(count, &options).map_err(|error| rejected(&error))?)
}

/// Tower of a notation such as `(010)-(1L1)`, bottom row first, as a dict.
#[pyfunction]
#[pyo3(signature = (notation, **options))]
pub fn config<'py>(
    py: Python<'py>,
    notation: &str,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let exact = TowerOptions::exact();
    let all = PyDict::new(py);
    all.set_item("height_sd", exact.height_sd)?;
    all.set_item("mass_sd", exact.mass_sd)?;
    all.set_item("edge_radius", exact.edge_radius)?;
    if let Some(options) = options {
        all.update(options.as_mapping())?;
    }
    let options: TowerOptions = read(Kind::Scene, "", &all)?;
    dict(py, &teeter_scene::config(notation, &options).map_err(|error| rejected(&error))?)
}

/// House of cards, as a dict.
#[pyfunction]
#[pyo3(signature = (storeys, **options))]
pub fn cards<'py>(storeys: &Bound<'py, PyAny>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
    let storeys_count = count("storeys", storeys, 1..=u64::from(teeter_scene::MAX_STOREYS))? as u32;
    let options: CardsOptions = keywords(Kind::Scene, options)?;
    dict(storeys.py(), &teeter_scene::cards(storeys_count, &options).map_err(|error| rejected(&error))?)
}
