//! Records of games.

use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use teeter_game::{Command, Verification, verify};
use teeter_physics::{BodyId, POSE_STRIDE};

use crate::error::Kind;
use crate::plain::write;
use crate::pool::detached;
use crate::scene::dict;

/// Record of a game: scene, constants, rules and commands, with checks. Record(data)
///
/// data: bytes of a record file. Raises RecordError, which names the fault.
#[pyclass(frozen, module = "teeter")]
#[derive(Debug)]
pub struct Record {
    pub record: teeter_game::Record,
}

/// Result of a replay.
#[derive(Debug, Serialize)]
struct Verified {
    same: bool,
    hash: String,
    diverged_at_frame: Option<u32>,
    diverged_at_s: Option<f64>,
    block: Option<BodyId>,
    distance_m: Option<f64>,
}

impl From<Verification> for Verified {
    fn from(verification: Verification) -> Self {
        let divergence = verification.divergence;
        let block = divergence.and_then(|divergence| divergence.block);
        Self {
            same: verification.same,
            hash: format!("{:016x}", verification.hash),
            diverged_at_frame: divergence.map(|divergence| divergence.frame),
            diverged_at_s: divergence.map(|divergence| divergence.time_s),
            block: block.map(|block| block.body),
            distance_m: block.map(|block| block.distance),
        }
    }
}

#[pymethods]
impl Record {
    #[new]
    fn new(data: &[u8]) -> PyResult<Self> {
        let record = teeter_game::Record::decode(data).map_err(|error| Kind::Record.error(error))?;
        Ok(Self { record })
    }

    fn __repr__(&self) -> String {
        format!(
            "<Record '{}': {} frames, {:.1} s>",
            self.record.scene.name,
            self.record.frames(),
            self.record.seconds()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyAny>, (Bound<'py, PyBytes>,)) {
        (py.get_type::<Self>().into_any(), (self.encode(py),))
    }

    /// Bytes of the record file.
    fn encode<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.record.encode())
    }

    /// Number of frames.
    #[getter]
    fn frames(&self) -> u32 {
        self.record.frames()
    }

    /// Simulated time, s.
    #[getter]
    fn seconds(&self) -> f64 {
        self.record.seconds()
    }

    /// Identity of the engine that played the game.
    #[getter]
    fn engine(&self) -> &str {
        &self.record.engine
    }

    /// Scene at the start, a dict.
    #[getter]
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, &self.record.scene)
    }

    /// Constants of the run, a dict.
    #[getter]
    fn params<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.record.params)
    }

    /// Rules, a dict.
    #[getter]
    fn rules<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.record.rules)
    }

    /// Commands, a list of dicts, one a frame.
    fn commands<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let commands: Vec<Command> = self.record.commands(0).collect();
        write(py, &commands)
    }

    /// Poses at the end of each second and of the record, float64 of shape (k, n, 7), rounded to a
    /// twentieth of a millimetre. They need no simulation.
    fn keyframes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let mut poses = Vec::new();
        for (p, q) in self.record.keyframes().flatten() {
            poses.extend([p.x, p.y, p.z, q.x, q.y, q.z, q.w]);
        }
        let bodies = self.record.scene.blocks.len();
        let frames = poses.len() / (bodies * POSE_STRIDE).max(1);
        PyArray1::from_vec(py, poses).reshape([frames, bodies, POSE_STRIDE])
    }

    /// Plays the record again, and returns a dict: same, hash, and where it diverges
    /// diverged_at_frame, diverged_at_s, block and distance_m.
    fn verify<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let record = &self.record;
        let verification = detached(py, || verify(record))?.map_err(|error| Kind::Record.error(error))?;
        write(py, &Verified::from(verification))
    }
}
