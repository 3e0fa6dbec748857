//! State of a game: snapshots, copies, pickles and hashes.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use teeter_game::Rules;
use teeter_physics::Params;
use teeter_scene::Scene;

use super::Game;
use crate::error::Kind;
use crate::scene::rejected;
use crate::world::World;

#[pymethods]
impl Game {
    /// Whole state as bytes, without the scene and the constants.
    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.game.snapshot())
    }

    /// Takes over a state of a game of the same scene and constants, which goes on bit for bit. A
    /// record ends with it.
    ///
    /// Raises SnapshotError where the bytes are none of this game; it is unchanged then.
    fn restore(&mut self, state: &[u8]) -> PyResult<()> {
        self.game.restore(state).map_err(|error| Kind::Snapshot.error(error))?;
        self.writer = None;
        Ok(())
    }

    /// Hash of the world's state, 16 hexadecimal digits, see World.hash.
    fn hash(&self) -> String {
        format!("{:016x}", self.game.hash())
    }

    /// Hash of the whole state: world, hand, detectors and turns.
    fn state_hash(&self) -> String {
        format!("{:016x}", self.game.state_hash())
    }

    /// A copy that goes on independently, with its record so far.
    #[pyo3(name = "clone")]
    fn copied(&self) -> Self {
        self.clone()
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    /// A game of a pickle: scene, constants and rules as JSON, and a snapshot.
    #[staticmethod]
    fn _unpickled(py: Python<'_>, scene: &str, params: &str, rules: &str, state: &[u8]) -> PyResult<Self> {
        let scene = Scene::from_json(scene).map_err(|error| rejected(&error))?;
        let params: Params = serde_json::from_str(params).map_err(|error| Kind::Param.error(error))?;
        let rules: Rules = serde_json::from_str(rules).map_err(|error| Kind::Rules.error(error))?;
        let world = World::build(py, &scene, params)?.world;
        let game = teeter_game::Game::with_rules(world, rules).map_err(|error| Kind::Rules.error(error))?;
        let mut unpickled = Self::unrecorded(game);
        unpickled.restore(state)?;
        Ok(unpickled)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let unpickle = py.get_type::<Self>().getattr("_unpickled")?;
        let world = self.game.world();
        let params = serde_json::to_string(world.params()).map_err(|error| Kind::Param.error(error))?;
        let rules = serde_json::to_string(&self.game.rules()).map_err(|error| Kind::Rules.error(error))?;
        (unpickle, (world.scene().to_json(), params, rules, self.snapshot(py))).into_pyobject(py)
    }
}
