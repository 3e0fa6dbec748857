//! Games that begin in the middle of a record.

use pyo3::prelude::*;
use teeter_game::{RecordError, Replay};

use super::Game;
use crate::argument::count;
use crate::error::Kind;
use crate::pool::detached;
use crate::record::Record;

#[pymethods]
impl Record {
    /// Game as it is after `frame` frames, which can be played on from there; at the end where
    /// absent.
    #[pyo3(signature = (frame=None))]
    fn game(&self, py: Python<'_>, frame: Option<&Bound<'_, PyAny>>) -> PyResult<Game> {
        let last = self.record.frames();
        let frame =
            frame.map_or(Ok(last), |frame| Ok::<u32, PyErr>(count("frame", frame, 0..=u64::from(last))? as u32))?;
        let record = &self.record;
        let game = detached(py, || {
            let mut replay = Replay::near(record, frame)?;
            while replay.frame() < frame && replay.step().is_some() {}
            Ok(replay.into_game())
        })?;
        game.map(Game::unrecorded).map_err(|error: RecordError| Kind::Record.error(error))
    }
}
