//! Rollout: trajectories of copies of all worlds of a batch.

use glam::DVec3;
use numpy::{PyArray1, PyArray4, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyList;
use rayon::prelude::*;
use teeter_physics::{AppliedForce, BodyId, Hand, Input, POSE_STRIDE, World};

use crate::argument::{body_of, count, shown};
use crate::error::{Kind, unexpected};
use crate::input::input_of;
use crate::pool::Pool;
use crate::twist::{TWIST_STRIDE, write_twists};

/// Largest size of the trajectories, bytes.
const MAX_BYTES: usize = 1 << 33;

type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// Trajectories of a rollout.
///
/// poses: float64 of shape (N, T, n, 7). velocities: shape (N, T, n, 6). times: s, shape (T,).
/// hashes: of the states at the end, one a world.
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug)]
pub struct Rollout {
    poses: Py<PyArray4<f64>>,
    velocities: Py<PyArray4<f64>>,
    times: Py<PyArray1<f64>>,
    hashes: Vec<String>,
}

/// Inputs of a rollout, one a world and frame.
#[derive(Debug)]
pub struct Task {
    worlds: usize,
    len: usize,
    frames: usize,
    every: usize,
    bodies: Vec<BodyId>,
    forces: Vec<f64>,
    gravity: Vec<f64>,
    hands: Vec<Option<Hand>>,
    targets: Vec<f64>,
}

impl Task {
    /// A rollout without input of `worlds` worlds of `len` bodies.
    pub fn new(worlds: usize, len: usize, frames: &Bound<'_, PyAny>, every: Given<'_, '_>) -> PyResult<Self> {
        let frames = count("frames", frames, 1..=10_000_000)? as usize;
        let every = every.map_or(Ok(1), |every| count("every", every, 1..=frames as u64))? as usize;
        let stored = (worlds * len * (POSE_STRIDE + TWIST_STRIDE) * 8).saturating_mul(frames / every);
        if stored > MAX_BYTES {
            let expected = format!("at most {} GB of trajectories: raise `every`", MAX_BYTES >> 30);
            return Err(unexpected(Kind::Input, "frames", frames, expected));
        }
        let (bodies, forces, gravity) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { worlds, len, frames, every, bodies, forces, gravity, hands: Vec::new(), targets: Vec::new() })
    }

    /// Reads the forces and the bodies that they act on.
    pub fn set_forces(&mut self, forces: Given<'_, '_>, bodies: Given<'_, '_>) -> PyResult<()> {
        let (forces, bodies) = match (forces, bodies) {
            (None, None) => return Ok(()),
            (Some(forces), Some(bodies)) => (forces, bodies),
            (Some(_), None) => {
                return Err(unexpected(Kind::Input, "bodies", "absent", "the bodies that `forces` act on"));
            }
            (None, Some(_)) => return Err(unexpected(Kind::Input, "forces", "absent", "the forces on `bodies`")),
        };
        let wrong = || unexpected(Kind::Input, "bodies", shown(bodies), "a list of bodies");
        for (i, index) in bodies.try_iter().map_err(|_| wrong())?.enumerate() {
            self.bodies.push(body_of(self.len, &format!("bodies[{i}]"), &index?)?);
        }
        self.forces = array("forces", forces, &[self.worlds, self.frames, self.bodies.len(), 3])?;
        Ok(())
    }

    /// Reads gravity.
    pub fn set_gravity(&mut self, gravity: Given<'_, '_>) -> PyResult<()> {
        if let Some(gravity) = gravity {
            self.gravity = array("gravity", gravity, &[self.worlds, self.frames, 3])?;
        }
        Ok(())
    }

    /// Reads the hands and their targets.
    pub fn set_hands(&mut self, hands: Given<'_, '_>, targets: Given<'_, '_>) -> PyResult<()> {
        let Some(hands) = hands else {
            return match targets {
                Some(_) => Err(unexpected(Kind::Input, "hands", "absent", "the hands that `targets` are of")),
                None => Ok(()),
            };
        };
        let list = hands.cast::<PyList>().ok().filter(|list| list.len() == self.worlds);
        let wrong =
            || unexpected(Kind::Input, "hands", shown(hands), format_args!("a list of {} hands or None", self.worlds));
        for (i, hand) in list.ok_or_else(wrong)?.iter().enumerate() {
            let input = pyo3::types::PyDict::new(hand.py());
            input.set_item("hand", &hand)?;
            self.hands.push(input_of(&input, &format!("hands[{i}]"), self.len)?.hand);
        }
        let Some(targets) = targets else { return Ok(()) };
        self.targets = array("targets", targets, &[self.worlds, self.frames, 3])?;
        Ok(())
    }

    /// Input of a frame of a world.
    fn input(&self, world: usize, frame: usize) -> Input {
        let at = world * self.frames + frame;
        let vectors = |from: &[f64], n: usize| -> Vec<DVec3> {
            from.get(3 * n * at..3 * n * (at + 1)).unwrap_or_default().chunks_exact(3).map(DVec3::from_slice).collect()
        };
        let mut hand = self.hands.get(world).cloned().flatten();
        if let (Some(hand), Some(target)) = (&mut hand, vectors(&self.targets, 1).first()) {
            hand.target = *target;
        }
        let forces = self.bodies.iter().zip(vectors(&self.forces, self.bodies.len()));
        Input {
            gravity: vectors(&self.gravity, 1).first().copied(),
            hand,
            forces: forces.map(|(body, force)| AppliedForce::at_center(*body, force)).collect(),
            drives: Vec::new(),
        }
    }

    /// Runs a copy of world `i` and writes its poses and twists; returns the hash at the end.
    fn trajectory(&self, i: usize, world: &World, poses: &mut [f64], twists: &mut [f64]) -> String {
        let mut world = world.clone();
        // A world without bodies has rows of no numbers, and a chunk must have one.
        let len = self.len.max(1);
        let mut poses = poses.chunks_exact_mut(len * POSE_STRIDE);
        let mut twists = twists.chunks_exact_mut(len * TWIST_STRIDE);
        for frame in 0..self.frames {
            world.step(&self.input(i, frame));
            let is_stored = (frame + 1).is_multiple_of(self.every);
            if is_stored && let (Some(poses), Some(twists)) = (poses.next(), twists.next()) {
                poses.copy_from_slice(world.poses());
                write_twists(&world, twists);
            }
        }
        format!("{:016x}", world.hash())
    }

    /// Runs copies of the worlds.
    pub fn run(&self, py: Python<'_>, worlds: &[World], pool: &Pool) -> PyResult<Rollout> {
        let (poses_len, twists_len) = (self.len * POSE_STRIDE, self.len * TWIST_STRIDE);
        let stored = self.frames / self.every;
        let mut poses = vec![0.0; worlds.len() * stored * poses_len];
        let mut twists = vec![0.0; worlds.len() * stored * twists_len];
        let hashes: Vec<String> = pool.run(py, || {
            let chunks = poses.par_chunks_mut((stored * poses_len).max(1));
            let chunks = chunks.zip(twists.par_chunks_mut((stored * twists_len).max(1)));
            let chunks = chunks.zip(worlds.par_iter().enumerate());
            chunks.map(|((poses, twists), (i, world))| self.trajectory(i, world, poses, twists)).collect()
        })?;
        let frame = worlds.first().map_or(0.0, |world| world.params().frame);
        let times = (1..=stored).map(|at| (at * self.every) as f64 * frame).collect();
        Ok(Rollout {
            poses: PyArray1::from_vec(py, poses).reshape([worlds.len(), stored, self.len, POSE_STRIDE])?.unbind(),
            velocities: PyArray1::from_vec(py, twists)
                .reshape([worlds.len(), stored, self.len, TWIST_STRIDE])?
                .unbind(),
            times: PyArray1::from_vec(py, times).unbind(),
            hashes,
        })
    }
}

/// Reads an array of finite numbers of a shape.
fn array(field: &str, object: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<f64>> {
    let wrong = |found: String| unexpected(Kind::Input, field, found, format_args!("float64 of shape {shape:?}"));
    let array: PyReadonlyArrayDyn<'_, f64> = object.extract().map_err(|_| {
        wrong(format!("of type {}", object.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string())))
    })?;
    if array.shape() != shape {
        return Err(wrong(format!("of shape {:?}", array.shape())));
    }
    let numbers: Vec<f64> = array.as_array().iter().copied().collect();
    match numbers.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(unexpected(Kind::Input, field, x, "finite numbers")),
        None => Ok(numbers),
    }
}
