//! Motion of a world: steps, and changes from outside.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use teeter_physics::{Input, Twist, World as Physics};
use teeter_scene::{Form, Springs};

use super::{World, unbuilt};
use crate::argument::{body, orientation, vector, within};
use crate::error::Kind;
use crate::input::Parts;
use crate::plain::{keywords, read};
use crate::pool::detached;
use crate::report::StepReport;

/// Frames after which a long run sees whether it was interrupted.
const FRAMES: usize = 16;
/// Longest time that one call runs for, s.
const MAX_SECONDS: f64 = 1e6;

/// Advances by `frames` frames, at least one, and returns the last report. Python's signals are
/// handled in between.
fn run(py: Python<'_>, world: &mut Physics, input: &Input, mut frames: usize) -> PyResult<StepReport> {
    loop {
        let part = frames.clamp(1, FRAMES);
        let report = detached(py, || {
            for _ in 1..part {
                world.step(input);
            }
            world.step(input)
        })?;
        if frames <= part {
            return Ok(report.into());
        }
        frames -= part;
        py.check_signals()?;
    }
}

#[pymethods]
impl World {
    /// Advances by one frame and returns a StepReport.
    ///
    /// hand: a Hand. forces: a list of Force. drives: a list of Drive. gravity: a vector, m/s², the
    /// scene's where absent. Each may also be plain data, see docs/inputs.md. A step never fails:
    /// what exceeds the limits of inputs is reduced to them, and a body whose state runs
    /// away is frozen and named in the report.
    ///
    /// Raises InputError or BodyError, and nothing has changed then.
    #[pyo3(signature = (*, hand=None, forces=None, drives=None, gravity=None))]
    fn step(
        &mut self,
        py: Python<'_>,
        hand: Option<&Bound<'_, PyAny>>,
        forces: Option<&Bound<'_, PyAny>>,
        drives: Option<&Bound<'_, PyAny>>,
        gravity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<StepReport> {
        let input = Parts { hand, forces, drives, gravity }.read(self.world.len())?;
        run(py, &mut self.world, &input, 1)
    }

    /// Advances by a time (s), rounded to whole frames and at least one, with the same input in
    /// each frame, and returns the last StepReport. Ctrl-C ends it after a frame.
    ///
    /// Raises InputError or BodyError, and nothing has changed then.
    #[pyo3(signature = (seconds, *, hand=None, forces=None, drives=None, gravity=None))]
    fn run_for(
        &mut self,
        seconds: &Bound<'_, PyAny>,
        hand: Option<&Bound<'_, PyAny>>,
        forces: Option<&Bound<'_, PyAny>>,
        drives: Option<&Bound<'_, PyAny>>,
        gravity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<StepReport> {
        let time = within("seconds", seconds, 0.0..=MAX_SECONDS)?;
        let input = Parts { hand, forces, drives, gravity }.read(self.world.len())?;
        let frames = self.world.frames(time);
        run(seconds.py(), &mut self.world, &input, frames)
    }

    /// Sets velocity (m/s) and spin (rad/s) of a body, and wakes all that it touches. A fixed or
    /// frozen body stays where it is.
    #[pyo3(signature = (body_index, velocity=None, spin=None))]
    #[pyo3(name = "set_velocity", text_signature = "($self, body, velocity=(0, 0, 0), spin=(0, 0, 0))")]
    fn set_velocity(
        &mut self,
        body_index: &Bound<'_, PyAny>,
        velocity: Option<&Bound<'_, PyAny>>,
        spin: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let body = body(&self.world, body_index)?;
        let velocity = velocity.map_or(Ok(Twist::ZERO.velocity), |velocity| vector("velocity", velocity))?;
        let spin = spin.map_or(Ok(Twist::ZERO.spin), |spin| vector("spin", spin))?;
        self.world.set_twist(body, Twist { velocity, spin });
        Ok(())
    }

    /// Sets the orientation (quaternion x, y, z, w of any length) of a body about its centre.
    #[pyo3(name = "set_orientation", text_signature = "($self, body, orientation)")]
    fn set_orientation(&mut self, body_index: &Bound<'_, PyAny>, quaternion: &Bound<'_, PyAny>) -> PyResult<()> {
        let body = body(&self.world, body_index)?;
        let orientation = orientation("orientation", quaternion)?;
        let world = &mut self.world;
        detached(body_index.py(), || world.set_orientation(body, orientation))
    }

    /// Changes the form of the blocks, "rigid" or "lattice", and their springs (stiffness, damping,
    /// particles: see docs/scene-format.md) at the present poses and velocities.
    ///
    /// Raises SceneError where a constant is out of its range; the world is unchanged then.
    #[pyo3(signature = (form, **springs))]
    fn set_form(&mut self, form: &Bound<'_, PyAny>, springs: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let name: Form = read(Kind::Scene, "form", form)?;
        let springs: Springs = keywords(Kind::Scene, springs)?;
        let world = &mut self.world;
        detached(form.py(), || world.set_form(name, springs))?.map_err(|error| unbuilt(&error))
    }
}
