//! State of a world: snapshots, copies, pickles and the hash.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use teeter_physics::Params;
use teeter_scene::Scene;

use super::World;
use crate::error::Kind;
use crate::pool::detached;
use crate::scene::rejected;

#[pymethods]
impl World {
    /// Whole state as bytes, without the scene and the constants.
    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.world.snapshot())
    }

    /// Takes over a state of a world of the same scene and constants, which goes on bit for bit.
    ///
    /// Raises SnapshotError where the bytes are none of this world; it is unchanged then.
    fn restore(&mut self, state: &[u8]) -> PyResult<()> {
        self.world.restore(state).map_err(|error| Kind::Snapshot.error(error))
    }

    /// Hash of the whole state, 16 hexadecimal digits: equal hashes, equal futures. The page and
    /// the shell show the same digits for the same state.
    fn hash(&self) -> String {
        format!("{:016x}", self.world.hash())
    }

    /// A copy that goes on independently.
    fn clone(&self) -> Self {
        Self { world: self.world.clone() }
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    /// A world of a pickle: scene and constants as JSON, and a snapshot.
    #[staticmethod]
    fn _unpickled(py: Python<'_>, scene: &str, params: &str, state: &[u8]) -> PyResult<Self> {
        let scene = Scene::from_json(scene).map_err(|error| rejected(&error))?;
        let params: Params = serde_json::from_str(params).map_err(|error| Kind::Param.error(error))?;
        let mut unpickled = Self::build(py, &scene, params)?;
        let world = &mut unpickled.world;
        detached(py, || world.restore(state))?.map_err(|error| Kind::Snapshot.error(error))?;
        Ok(unpickled)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let unpickle = py.get_type::<Self>().getattr("_unpickled")?;
        let params = serde_json::to_string(self.world.params()).map_err(|error| Kind::Param.error(error))?;
        (unpickle, (self.world.scene().to_json(), params, self.snapshot(py))).into_pyobject(py)
    }
}
