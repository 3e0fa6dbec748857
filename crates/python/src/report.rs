//! Reports of worlds as objects of Python.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use teeter_physics::{BodyId, World};
use teeter_study::Load;

/// Force and torque of a hand at the end of a step.
///
/// force: force on the body, N. torque: N m. point: the grasped point in the world, m. capped and
/// torque_capped: True where force or torque was at its limit.
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug, Clone, Copy)]
pub struct HandReport {
    force: (f64, f64, f64),
    torque: (f64, f64, f64),
    point: (f64, f64, f64),
    capped: bool,
    torque_capped: bool,
}

/// Report of a step.
///
/// time: simulated time, s. substeps, syncs, detections, manifolds, touching, awake: counts.
/// penetration: the deepest of the step, m. max_speed, rms_speed: over the bodies, m/s. put_in:
/// energy put in by the input, J. quarantined: bodies frozen in this step because their state ran
/// away. hand: a HandReport, None without a hand.
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug)]
pub struct StepReport {
    time: f64,
    substeps: u32,
    syncs: u32,
    detections: u32,
    manifolds: u32,
    touching: u32,
    awake: u32,
    penetration: f64,
    max_speed: f64,
    rms_speed: f64,
    put_in: f64,
    quarantined: Vec<u32>,
    hand: Option<HandReport>,
}

impl From<teeter_physics::StepReport> for StepReport {
    fn from(report: teeter_physics::StepReport) -> Self {
        let hand = report.hand.map(|hand| HandReport {
            force: hand.force.into(),
            torque: hand.torque.into(),
            point: hand.point.into(),
            capped: hand.capped,
            torque_capped: hand.torque_capped,
        });
        Self {
            time: report.time,
            substeps: report.substeps,
            syncs: report.syncs,
            detections: report.detections,
            manifolds: report.manifolds,
            touching: report.touching,
            awake: report.awake,
            penetration: report.penetration,
            max_speed: report.max_speed,
            rms_speed: report.rms_speed,
            put_in: report.put_in,
            quarantined: report.quarantined.iter().map(|body| body.0).collect(),
            hand,
        }
    }
}

#[pymethods]
impl HandReport {
    fn __repr__(&self) -> String {
        let Self { force: (x, y, z), capped, .. } = self;
        format!("HandReport(force=({x:.4}, {y:.4}, {z:.4}), capped={})", if *capped { "True" } else { "False" })
    }
}

#[pymethods]
impl StepReport {
    fn __repr__(&self) -> String {
        let Self { time, awake, touching, max_speed, penetration, .. } = self;
        format!(
            "StepReport(time={time:.4}, awake={awake}, touching={touching}, max_speed={max_speed:.3e}, \
             penetration={penetration:.3e})"
        )
    }
}

/// Loaded contacts, one a pair of bodies.
///
/// a, b: int64 of shape (k,), the bodies with a < b, and b = -1 for the floor. force: normal force,
/// N, shape (k,). point: centre of the load, m, shape (k, 3). normal: direction of the force on a,
/// shape (k, 3).
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug)]
pub struct Contacts {
    a: Py<PyArray1<i64>>,
    b: Py<PyArray1<i64>>,
    force: Py<PyArray1<f64>>,
    point: Py<PyArray2<f64>>,
    normal: Py<PyArray2<f64>>,
}

impl Contacts {
    /// Contacts of some bodies, each pair once.
    pub fn of(py: Python<'_>, world: &World, bodies: &[BodyId]) -> PyResult<Self> {
        let (mut a, mut b, mut force, mut point, mut normal) = (vec![], vec![], vec![], vec![], vec![]);
        for &body in bodies {
            for contact in world.contacts(body) {
                let is_second = contact.other.is_some_and(|other| other < body && bodies.len() > 1);
                if is_second {
                    continue;
                }
                a.push(i64::from(body.0));
                b.push(contact.other.map_or(-1, |other| i64::from(other.0)));
                force.push(contact.force);
                point.extend(contact.point.to_array());
                normal.extend(contact.normal.to_array());
            }
        }
        let shape = [force.len(), 3];
        Ok(Self {
            a: PyArray1::from_vec(py, a).unbind(),
            b: PyArray1::from_vec(py, b).unbind(),
            force: PyArray1::from_vec(py, force).unbind(),
            point: PyArray1::from_vec(py, point).reshape(shape)?.unbind(),
            normal: PyArray1::from_vec(py, normal).reshape(shape)?.unbind(),
        })
    }
}

#[pymethods]
impl Contacts {
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.a.bind(py).len()
    }
}

/// Loads of all bodies: the X-ray.
///
/// Each an array of shape (n,), N. below: normal force on the lower face. above: normal force on
/// the upper face, the load. tightness: force that starts the block sliding straight. loose: bool,
/// True where nothing presses on the block.
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug)]
pub struct Loads {
    below: Py<PyArray1<f64>>,
    above: Py<PyArray1<f64>>,
    tightness: Py<PyArray1<f64>>,
    loose: Py<PyArray1<bool>>,
}

impl Loads {
    /// Arrays of loads.
    pub fn new(py: Python<'_>, loads: &[Load]) -> Self {
        let array = |part: fn(&Load) -> f64| PyArray1::from_vec(py, loads.iter().map(part).collect()).unbind();
        Self {
            below: array(|x| x.below_n),
            above: array(|x| x.above_n),
            tightness: array(|x| x.tightness_n),
            loose: PyArray1::from_vec(py, loads.iter().map(Load::is_loose).collect()).unbind(),
        }
    }
}

/// Mechanical energy, J.
///
/// kinetic; potential, in gravity; elastic, in the springs of contacts and blocks; total.
#[pyclass(frozen, get_all, module = "teeter")]
#[derive(Debug, Clone, Copy)]
pub struct Energy {
    kinetic: f64,
    potential: f64,
    elastic: f64,
    total: f64,
}

impl From<teeter_physics::Energy> for Energy {
    fn from(energy: teeter_physics::Energy) -> Self {
        let teeter_physics::Energy { kinetic, potential, elastic } = energy;
        Self { kinetic, potential, elastic, total: energy.total() }
    }
}

#[pymethods]
impl Energy {
    fn __repr__(&self) -> String {
        let Self { kinetic, potential, elastic, total } = self;
        format!("Energy(kinetic={kinetic:.6e}, potential={potential:.6e}, elastic={elastic:.6e}, total={total:.6e})")
    }
}
