//! World of Python.

mod motion;
mod queries;
mod state;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use teeter_physics::{BuildError, Params, World as Physics};
use teeter_scene::Scene;

use crate::error::Kind;
use crate::plain::keywords;
use crate::pool::detached;
use crate::scene::{rejected, scene_of};

/// Bodies and contacts in time. World(scene, *, precision="single", width="auto", sleep=True,
/// ramp=0.0, frame=1/60)
///
/// scene: a dict (see docs/scene-format.md), the name of a scene of the list, a notation such as
/// "(010)-(111)", or the path of a file. All of its future follows from the scene, the constants of
/// the run and the inputs, bit for bit on every machine. Bodies are addressed by their index, in
/// the order of the scene's blocks.
///
/// Raises SceneError or ParamError, which name the block and the field.
#[pyclass(module = "teeter")]
#[derive(Debug)]
pub struct World {
    pub world: Physics,
}

impl World {
    /// Builds a world without Python's lock.
    pub fn build(py: Python<'_>, scene: &Scene, params: Params) -> PyResult<Self> {
        let world = detached(py, || Physics::new(scene, params))?.map_err(|error| unbuilt(&error))?;
        Ok(Self { world })
    }
}

/// Exception of a world that cannot be built.
pub fn unbuilt(error: &BuildError) -> PyErr {
    match error {
        BuildError::Scene(error) => rejected(error),
        BuildError::Param { .. } => Kind::Param.error(error),
        _ => Kind::Scene.error(error),
    }
}

/// Array of rows of `N` numbers.
pub fn rows<'py, const N: usize>(py: Python<'py>, numbers: Vec<[f64; N]>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let shape = [numbers.len(), N];
    PyArray1::from_vec(py, numbers.into_flattened()).reshape(shape)
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (scene, **params))]
    fn new(scene: &Bound<'_, PyAny>, params: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let params: Params = keywords(Kind::Param, params)?;
        Self::build(scene.py(), &scene_of(scene)?, params)
    }

    /// Number of bodies.
    fn __len__(&self) -> usize {
        self.world.len()
    }

    fn __repr__(&self) -> String {
        format!("<World '{}': {} bodies, {:.3} s>", self.world.scene().name, self.world.len(), self.world.time())
    }
}
