//! Queries of a world.

use glam::DVec3;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use teeter_physics::{BodyId, POSE_STRIDE};
use teeter_study::{breakaway_force, xray};

use super::{World, rows};
use crate::argument::{body, direction, within};
use crate::picture::{draw, size, view};
use crate::plain::write;
use crate::pool::detached;
use crate::report::{Contacts, Energy, Loads};
use crate::scene::dict;
use crate::twist::{TWIST_STRIDE, write_twists};

impl World {
    /// Direction of the longest edge of a body in the world.
    fn long_axis(&self, body: BodyId) -> DVec3 {
        let size = self.world.size(body);
        let longest =
            [DVec3::X, DVec3::Y, DVec3::Z].into_iter().reduce(|a, b| if size.dot(b) > size.dot(a) { b } else { a });
        self.world.pose(body).orientation * longest.unwrap_or(DVec3::X)
    }
}

#[pymethods]
impl World {
    /// Poses of all bodies, float64 of shape (n, 7): position of the centre (m) and orientation as
    /// a quaternion x, y, z, w. A copy.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        PyArray1::from_slice(py, self.world.poses()).reshape([self.world.len(), POSE_STRIDE])
    }

    /// Velocities of all bodies, float64 of shape (n, 6): velocity of the centre (m/s) and spin
    /// (rad/s). A copy.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut twists = vec![0.0; self.world.len() * TWIST_STRIDE];
        write_twists(&self.world, &mut twists);
        PyArray1::from_vec(py, twists).reshape([self.world.len(), TWIST_STRIDE])
    }

    /// Edge lengths of all bodies along their own axes, m, shape (n, 3).
    #[getter]
    fn sizes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, self.world.bodies().map(|body| self.world.size(body).to_array()).collect())
    }

    /// Masses of all bodies, kg, shape (n,).
    #[getter]
    fn masses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.world.bodies().map(|body| self.world.mass(body)).collect())
    }

    /// Ids of the blocks in the scene, in the order of the bodies.
    #[getter]
    fn ids(&self) -> Vec<u32> {
        self.world.scene().blocks.iter().map(|block| block.id).collect()
    }

    /// True for each body that sleeps, bool of shape (n,).
    #[getter]
    fn asleep<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_vec(py, self.world.bodies().map(|body| self.world.is_asleep(body)).collect())
    }

    /// Bodies that were frozen because their state ran away.
    #[getter]
    fn quarantined(&self) -> Vec<u32> {
        self.world.bodies().filter(|body| self.world.is_quarantined(*body)).map(|body| body.0).collect()
    }

    /// Simulated time, s.
    #[getter]
    fn time(&self) -> f64 {
        self.world.time()
    }

    /// Length of a frame, s.
    #[getter]
    fn frame(&self) -> f64 {
        self.world.params().frame
    }

    /// Length of a substep, s.
    #[getter]
    fn substep(&self) -> f64 {
        self.world.substep()
    }

    /// Constants of the run, as a dict.
    #[getter]
    fn params<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, self.world.params())
    }

    /// Form of the blocks, "rigid" or "lattice".
    #[getter]
    fn form(&self) -> String {
        self.world.form().to_string()
    }

    /// Stiffness of a contact of 26.8 mm by 26.8 mm, N/m.
    #[getter]
    fn stiffness(&self) -> f64 {
        self.world.stiffness()
    }

    /// Stiffness of the springs within the blocks, N/m; None where they are rigid.
    #[getter]
    fn spring_stiffness(&self) -> Option<f64> {
        self.world.spring_stiffness()
    }

    /// Deepest penetration, m.
    #[getter]
    fn penetration(&self) -> f64 {
        self.world.penetration()
    }

    /// Mechanical energy, an Energy, J.
    #[getter]
    fn energy(&self) -> Energy {
        self.world.energy().into()
    }

    /// Differences to the scene and reasons to doubt the results, one line each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.world.warnings().iter().map(ToString::to_string).collect()
    }

    /// Scene that the world was built from, as a dict.
    #[getter]
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, self.world.scene())
    }

    /// Present state as a scene, a dict: poses, velocities and spins of the blocks. A world built
    /// from it goes on without the history of the contacts; snapshot() has that.
    fn to_scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, &self.world.to_scene())
    }

    /// Loaded contacts of all pairs of bodies, or of those with one body, as Contacts.
    ///
    /// Raises BodyError.
    #[pyo3(signature = (of=None), text_signature = "($self, body=None)")]
    fn contacts(&self, py: Python<'_>, of: Option<&Bound<'_, PyAny>>) -> PyResult<Contacts> {
        let bodies: Vec<BodyId> = match of {
            Some(index) => vec![body(&self.world, index)?],
            None => self.world.bodies().collect(),
        };
        Contacts::of(py, &self.world, &bodies)
    }

    /// Loads of all bodies from the contacts of the moment, as Loads (N). Of meaning at rest only.
    ///
    /// friction: coefficient of static friction, that of the scene where absent.
    #[pyo3(signature = (friction=None))]
    fn xray(&self, py: Python<'_>, friction: Option<&Bound<'_, PyAny>>) -> PyResult<Loads> {
        let friction = match friction {
            Some(friction) => within("friction", friction, 0.0..=2.0)?,
            None => self.world.scene().friction,
        };
        Ok(Loads::new(py, &xray(&self.world, friction)))
    }

    /// Force that starts a body sliding from the present state, N; None above 10 N. Measured on
    /// copies: the world stays as it is.
    ///
    /// direction: along which it is pulled, in the world; the long axis of the body where absent.
    /// Raises BodyError or InputError.
    #[pyo3(signature = (of, along=None), text_signature = "($self, body, direction=None)")]
    fn breakaway_force(&self, of: &Bound<'_, PyAny>, along: Option<&Bound<'_, PyAny>>) -> PyResult<Option<f64>> {
        let body = body(&self.world, of)?;
        let axis = match along {
            Some(along) => direction("direction", along)?,
            None => self.long_axis(body),
        };
        let world = &self.world;
        detached(of.py(), || breakaway_force(world, body, axis))
    }

    /// Particles (m, shape (8, 3), in the world) and forces of the springs (N, shape (28,), tension
    /// is positive, between particles 0 and 1, 0 and 2, ... 6 and 7) of a lattice block; None where
    /// it is rigid.
    #[pyo3(text_signature = "($self, body)")]
    fn lattice<'py>(&self, of: &Bound<'py, PyAny>) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        let Some(report) = self.world.lattice(body(&self.world, of)?) else { return Ok(None) };
        let particles = rows(of.py(), report.particles.iter().map(DVec3::to_array).collect())?;
        Ok(Some((particles.into_any(), PyArray1::from_slice(of.py(), &report.forces).into_any())))
    }

    /// Picture of the present state, uint8 of shape (height, width, 3), red, green and blue.
    ///
    /// azimuth, elevation: direction of the camera, rad; distance, m; target: the point in the
    /// centre, m. What is absent frames all blocks.
    #[pyo3(signature = (width=None, height=None, *, azimuth=None, elevation=None, distance=None, target=None))]
    #[pyo3(
        text_signature = "($self, width=640, height=480, *, azimuth=None, elevation=None, distance=None, target=None)"
    )]
    fn render<'py>(
        &self,
        py: Python<'py>,
        width: Option<&Bound<'py, PyAny>>,
        height: Option<&Bound<'py, PyAny>>,
        azimuth: Option<&Bound<'py, PyAny>>,
        elevation: Option<&Bound<'py, PyAny>>,
        distance: Option<&Bound<'py, PyAny>>,
        target: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let size = size(width, height)?;
        let view = view(azimuth, elevation, distance, target)?;
        let picture = draw(py, &self.world, size, &view)?;
        let shape = [size.height as usize, size.width as usize, 3];
        PyArray1::from_vec(py, picture.rgb).reshape(shape)
    }
}
