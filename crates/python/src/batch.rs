//! Batch of worlds that are stepped side by side.

use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rayon::prelude::*;
use teeter_physics::{Input, POSE_STRIDE, Params, World as Physics};
use teeter_scene::Scene;
use teeter_study::xray;

use crate::argument::{count, within};
use crate::error::{Kind, unexpected};
use crate::input::input_of;
use crate::plain::keywords;
use crate::pool::Pool;
use crate::rollout::{Rollout, Task};
use crate::scene::scene_of;
use crate::twist::{TWIST_STRIDE, write_twists};
use crate::world::{World, unbuilt};

/// Largest number of worlds.
const MAX_WORLDS: u64 = 1_000_000;
/// Frames after which a long run sees whether it was interrupted.
const FRAMES: usize = 4;

/// Worlds of equally many bodies that are stepped side by side. WorldBatch(scenes, *, threads=None,
/// precision="single", width="auto", sleep=True, ramp=0.0, frame=1/60)
///
/// scenes: a list of scenes, as World takes them, or of worlds, which are copied; each has its own
/// constants. threads: number of threads, one a core where absent; it changes no bit. `poses`,
/// `velocities` and `times` are live views: arrays that each step writes again. Copy what has to
/// stay.
///
/// Raises SceneError, ParamError or InputError with the index of the scene.
#[pyclass(module = "teeter")]
#[derive(Debug)]
pub struct WorldBatch {
    worlds: Vec<Physics>,
    /// States at the start.
    starts: Vec<Vec<u8>>,
    pool: Pool,
    poses: Py<PyArray3<f64>>,
    velocities: Py<PyArray3<f64>>,
    times: Py<PyArray1<f64>>,
}

/// World to be copied, or scene to build one from.
enum Source {
    World(Box<Physics>),
    Scene(Scene),
}

impl Source {
    fn of(item: &Bound<'_, PyAny>) -> PyResult<Self> {
        match item.cast::<World>() {
            Ok(world) => Ok(Self::World(Box::new(world.try_borrow()?.world.clone()))),
            Err(_) => Ok(Self::Scene(scene_of(item)?)),
        }
    }
}

/// Adds the index of an item to the message of its exception.
fn at_index(py: Python<'_>, index: usize, error: PyErr) -> PyErr {
    let message = error.value(py).to_string();
    let class = error.get_type(py);
    let field = error.value(py).getattr("field").ok();
    match class.call1((format!("scenes[{index}]: {message}"), field)) {
        Ok(error) => PyErr::from_value(error),
        Err(_) => error,
    }
}

impl WorldBatch {
    fn bodies(&self) -> usize {
        self.worlds.first().map_or(0, Physics::len)
    }

    /// Writes the views.
    fn refresh(&self, py: Python<'_>) -> PyResult<()> {
        let (poses, velocities, times) = (self.poses.bind(py), self.velocities.bind(py), self.times.bind(py));
        let (mut poses, mut velocities, mut times) =
            (poses.try_readwrite()?, velocities.try_readwrite()?, times.try_readwrite()?);
        let bodies = self.bodies();
        let (all_poses, all_velocities) = (poses.as_slice_mut()?, velocities.as_slice_mut()?);
        for (i, world) in self.worlds.iter().enumerate() {
            all_poses[i * bodies * POSE_STRIDE..][..bodies * POSE_STRIDE].copy_from_slice(world.poses());
            write_twists(world, &mut all_velocities[i * bodies * TWIST_STRIDE..][..bodies * TWIST_STRIDE]);
        }
        for (to, world) in times.as_slice_mut()?.iter_mut().zip(&self.worlds) {
            *to = world.time();
        }
        Ok(())
    }

    /// Inputs of all worlds from a list with one a world, or None.
    fn inputs(&self, given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Input>> {
        let Some(given) = given else { return Ok(vec![Input::default(); self.worlds.len()]) };
        let list = given.cast::<PyList>().ok().filter(|list| list.len() == self.worlds.len());
        let list = list.ok_or_else(|| {
            let expected = format!("a list of {} inputs, one a world", self.worlds.len());
            unexpected(Kind::Input, "inputs", crate::argument::shown(given), expected)
        })?;
        let read = |(i, item): (usize, Bound<'_, PyAny>)| input_of(&item, &format!("inputs[{i}]"), self.bodies());
        list.iter().enumerate().map(read).collect()
    }

    fn advance(&mut self, py: Python<'_>, inputs: &[Input], mut frames: usize) -> PyResult<()> {
        while frames > 0 {
            let part = frames.min(FRAMES);
            let Self { worlds, pool, .. } = self;
            pool.run(py, || {
                worlds.par_iter_mut().zip(inputs).for_each(|(world, input)| {
                    for _ in 0..part {
                        world.step(input);
                    }
                });
            })?;
            frames -= part;
            py.check_signals()?;
        }
        self.refresh(py)
    }

    /// World of an index.
    fn index(&self, index: &Bound<'_, PyAny>) -> PyResult<usize> {
        Ok(count("index", index, 0..=self.worlds.len() as u64 - 1)? as usize)
    }
}

/// View of an array that its user cannot write.
fn view<'py, T>(array: &Bound<'py, T>) -> PyResult<Bound<'py, PyAny>> {
    let view = array.as_any().call_method0("view")?;
    view.getattr("flags")?.setattr("writeable", false)?;
    Ok(view)
}

#[pymethods]
impl WorldBatch {
    #[new]
    #[pyo3(signature = (scenes, *, threads=None, **params))]
    fn new(
        py: Python<'_>,
        scenes: &Bound<'_, PyAny>,
        threads: Option<&Bound<'_, PyAny>>,
        params: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let params: Params = keywords(Kind::Param, params)?;
        let threads = threads.map_or(Ok(0), |threads| count("threads", threads, 1..=4096))? as usize;
        let list = scenes.cast::<PyList>().ok().filter(|list| (1..=MAX_WORLDS as usize).contains(&list.len()));
        let expected = || {
            unexpected(
                Kind::Input,
                "scenes",
                crate::argument::shown(scenes),
                "a list of scenes or worlds, at least one",
            )
        };
        let items = list.ok_or_else(expected)?.iter().enumerate();
        let sources: Vec<Source> = items
            .map(|(i, item)| Source::of(&item).map_err(|error| at_index(py, i, error)))
            .collect::<PyResult<_>>()?;
        let pool = Pool::new(threads);
        let built: Vec<_> = pool.run(py, || {
            let build = |source: Source| match source {
                Source::World(world) => Ok(*world),
                Source::Scene(scene) => Physics::new(&scene, params),
            };
            sources.into_par_iter().map(build).collect()
        })?;
        let built = built.into_iter().enumerate();
        let worlds: Vec<Physics> =
            built.map(|(i, world)| world.map_err(|error| at_index(py, i, unbuilt(&error)))).collect::<PyResult<_>>()?;
        let bodies = worlds[0].len();
        if let Some(i) = worlds.iter().position(|world| world.len() != bodies) {
            let message = format!("`scenes[{i}]` has {} blocks, expected {bodies}, as the first has", worlds[i].len());
            return Err(Kind::Input.error(message));
        }
        let n = worlds.len();
        let batch = Self {
            starts: worlds.iter().map(Physics::snapshot).collect(),
            pool,
            poses: PyArray3::zeros(py, [n, bodies, POSE_STRIDE], false).unbind(),
            velocities: PyArray3::zeros(py, [n, bodies, TWIST_STRIDE], false).unbind(),
            times: PyArray1::zeros(py, n, false).unbind(),
            worlds,
        };
        batch.refresh(py)?;
        Ok(batch)
    }

    /// Number of worlds.
    fn __len__(&self) -> usize {
        self.worlds.len()
    }

    fn __repr__(&self) -> PyResult<String> {
        let (n, bodies) = (self.worlds.len(), self.bodies());
        Ok(format!("<WorldBatch: {n} worlds of {bodies} bodies, {} threads>", self.pool.threads()?))
    }

    /// Number of threads.
    #[getter]
    fn threads(&self) -> PyResult<usize> {
        self.pool.threads()
    }

    /// Live view of all poses, float64 of shape (N, n, 7): position (m), quaternion x, y, z, w.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        view(self.poses.bind(py))
    }

    /// Live view of all velocities, float64 of shape (N, n, 6): velocity (m/s) and spin (rad/s).
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        view(self.velocities.bind(py))
    }

    /// Live view of the simulated times, s, float64 of shape (N,).
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        view(self.times.bind(py))
    }

    /// Advances all worlds by `frames` frames, each with its input, a dict of `hand`, `forces`,
    /// `drives` and `gravity`, or None. Ctrl-C ends it after some frames.
    ///
    /// inputs: a list with one a world, or None. Raises InputError or BodyError, and nothing has
    /// changed then.
    #[pyo3(signature = (inputs=None, *, frames=None), text_signature = "($self, inputs=None, *, frames=1)")]
    fn step(
        &mut self,
        py: Python<'_>,
        inputs: Option<&Bound<'_, PyAny>>,
        frames: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let frames = frames.map_or(Ok(1), |frames| count("frames", frames, 1..=1_000_000_000))? as usize;
        let inputs = self.inputs(inputs)?;
        self.advance(py, &inputs, frames)
    }

    /// Advances all worlds by a time (s), rounded to whole frames and at least one.
    #[pyo3(signature = (seconds, inputs=None))]
    fn run_for(&mut self, seconds: &Bound<'_, PyAny>, inputs: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let time = within("seconds", seconds, 0.0..=1e6)?;
        let inputs = self.inputs(inputs)?;
        let frames = self.worlds[0].frames(time).max(1);
        self.advance(seconds.py(), &inputs, frames)
    }

    /// Puts worlds back to their start: all, or those where `mask`, a list of N booleans, is True.
    #[pyo3(signature = (mask=None))]
    fn reset(&mut self, py: Python<'_>, mask: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let n = self.worlds.len();
        let mask: Vec<bool> = match mask {
            None => vec![true; n],
            Some(given) => {
                let wrong =
                    || unexpected(Kind::Input, "mask", crate::argument::shown(given), format_args!("{n} booleans"));
                let flags = given.try_iter().map_err(|_| wrong())?;
                let flags: Vec<bool> =
                    flags.map(|flag| flag?.is_truthy()).collect::<PyResult<_>>().map_err(|_| wrong())?;
                if flags.len() != n {
                    return Err(wrong());
                }
                flags
            }
        };
        let Self { worlds, starts, pool, .. } = self;
        let restored: Result<Vec<()>, _> = pool.run(py, || {
            let all = worlds.par_iter_mut().zip(starts.par_iter()).zip(&mask);
            all.filter(|(_, chosen)| **chosen).map(|((world, start), _)| world.restore(start)).collect()
        })?;
        restored.map_err(|error| Kind::Snapshot.error(error))?;
        self.refresh(py)
    }

    /// Copy of a world.
    #[pyo3(text_signature = "($self, index)")]
    fn world(&self, index: &Bound<'_, PyAny>) -> PyResult<World> {
        Ok(World { world: self.worlds[self.index(index)?].clone() })
    }

    /// States of all worlds as bytes, see World.snapshot.
    fn snapshots<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyBytes>> {
        self.worlds.iter().map(|world| PyBytes::new(py, &world.snapshot())).collect()
    }

    /// Takes over the state of one world.
    ///
    /// Raises SnapshotError where the bytes are none of this world; it is unchanged then.
    #[pyo3(text_signature = "($self, index, state)")]
    fn restore(&mut self, py: Python<'_>, index: &Bound<'_, PyAny>, state: &[u8]) -> PyResult<()> {
        let index = self.index(index)?;
        self.worlds[index].restore(state).map_err(|error| Kind::Snapshot.error(error))?;
        self.refresh(py)
    }

    /// Hashes of all states, see World.hash.
    fn hashes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let worlds = &self.worlds;
        self.pool.run(py, || worlds.par_iter().map(|world| format!("{:016x}", world.hash())).collect())
    }

    /// Loads of all bodies, N, float64 of shape (N, n, 3): below, above, tightness; see World.xray.
    fn xray<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let worlds = &self.worlds;
        let loads: Vec<f64> = self.pool.run(py, || {
            let of = |world: &Physics| xray(world, world.scene().friction);
            let each = worlds.par_iter().flat_map_iter(of);
            each.flat_map_iter(|load| [load.below_n, load.above_n, load.tightness_n]).collect()
        })?;
        PyArray1::from_vec(py, loads).reshape([self.worlds.len(), self.bodies(), 3])
    }

    /// Runs copies of all worlds for `frames` frames, and returns their trajectories as a Rollout.
    /// The batch stays as it is.
    ///
    /// forces: N, shape (N, frames, k, 3), at the centres of `bodies`, k indices. gravity: m/s²,
    /// shape (N, frames, 3). hands: a list of N hands, or None, whose target of each frame is that
    /// of `targets`, m, shape (N, frames, 3). every: frames from one stored pose to the next.
    ///
    /// Raises InputError or BodyError.
    #[pyo3(signature = (frames, *, forces=None, bodies=None, gravity=None, hands=None, targets=None, every=None))]
    #[pyo3(
        text_signature = "($self, frames, *, forces=None, bodies=None, gravity=None, hands=None, targets=None, every=1)"
    )]
    fn rollout(
        &self,
        frames: &Bound<'_, PyAny>,
        forces: Option<&Bound<'_, PyAny>>,
        bodies: Option<&Bound<'_, PyAny>>,
        gravity: Option<&Bound<'_, PyAny>>,
        hands: Option<&Bound<'_, PyAny>>,
        targets: Option<&Bound<'_, PyAny>>,
        every: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Rollout> {
        let mut task = Task::new(self.worlds.len(), self.bodies(), frames, every)?;
        task.set_forces(forces, bodies)?;
        task.set_gravity(gravity)?;
        task.set_hands(hands, targets)?;
        task.run(frames.py(), &self.worlds, &self.pool)
    }
}
