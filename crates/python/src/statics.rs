//! Towers with exact answers: labelled ones, statics of rigid blocks, and the definition of a fall.

use glam::{DQuat, DVec3};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use serde::Serialize;
use teeter_physics::POSE_STRIDE;
use teeter_report::score::{Labelled, OracleSet};
use teeter_scene::Scene;
use teeter_study::{Breakaway, Cuboid, LimitError, RigidTower, drawn_tower, par_map};

use crate::argument::{count, number, seed, shown};
use crate::error::{Kind, unexpected};
use crate::plain::write;
use crate::pool::detached;
use crate::scene::{dict, scene_of};

/// Exception of statics without an answer.
fn unanswered(error: LimitError) -> PyErr {
    Kind::Scene.error(error)
}

/// Towers that are evenly spread over all of them.
fn spread<T>(all: Vec<T>, wanted: usize) -> Vec<T> {
    let len = all.len();
    let is_taken = |i: usize| (i + 1) * wanted / len > i * wanted / len;
    all.into_iter().enumerate().filter(|(i, _)| is_taken(*i)).map(|(_, item)| item).collect()
}

/// Towers of a set of the program, evenly spread over it.
fn of_set(py: Python<'_>, set: OracleSet, towers: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Labelled>> {
    let all = detached(py, || set.towers())?.map_err(|error| Kind::Scene.error(error))?;
    let wanted = towers.map_or(Ok(all.len() as u64), |towers| count("count", towers, 1..=all.len() as u64))?;
    Ok(spread(all, wanted as usize))
}

/// Towers that stand or fall by exact statics, a list of dicts with label and margin (mm).
///
/// count: 1 to 400 of the towers of data/oracle, by default all; with a seed that many towers,
/// 1 to 10,000, drawn from it. Raises InputError.
#[pyfunction]
#[pyo3(signature = (count=None, *, seed=None))]
pub fn labelled_towers<'py>(
    py: Python<'py>,
    count: Option<&Bound<'py, PyAny>>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let scenes: Vec<Scene> = match seed {
        None => of_set(py, OracleSet::Config, count)?.into_iter().map(|tower| tower.scene).collect(),
        Some(first) => {
            let first = self::seed(first)?;
            let wanted = count.map_or(Ok(400), |wanted| self::count("count", wanted, 1..=10_000))?;
            let seeds: Vec<u64> = (0..wanted).map(|i| first.wrapping_mul(10_000).wrapping_add(i)).collect();
            detached(py, || par_map(&seeds, |&seed| drawn_tower(seed)))?
        }
    };
    scenes.iter().map(|scene| dict(py, scene)).collect()
}

/// Towers with the exact angle at which they collapse, a list of pairs: the scene, a dict with
/// tilt_az (rad), and the angle, degrees. Those whose answer depends on contact between the sides
/// of neighbours are left out.
///
/// count: 1 to 50 towers of data/oracle are considered, by default all. Raises InputError.
#[pyfunction]
#[pyo3(signature = (count=None))]
pub fn tilted_towers<'py>(
    py: Python<'py>,
    count: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<(Bound<'py, PyAny>, f64)>> {
    let towers = of_set(py, OracleSet::Tilt, count)?.into_iter().filter(|tower| !tower.truth.side_sensitive);
    towers
        .filter_map(|tower| Some((tower.truth.tilt_deg?, tower.scene)))
        .map(|(tilt, scene)| Ok((dict(py, &scene)?, tilt)))
        .collect()
}

/// True where rigid blocks cannot rest like this, whatever friction does; False where normal forces
/// alone hold them; None where statics has no answer: where friction decides, of a tilted block or
/// one fixed in the air, or where the solver gives up.
///
/// Raises SceneError.
#[pyfunction]
pub fn exact_fall(scene: &Bound<'_, PyAny>) -> PyResult<Option<bool>> {
    let py = scene.py();
    let scene = scene_of(scene)?;
    detached(py, || match RigidTower::falls(&scene) {
        Some(true) => RigidTower::falls_despite_friction(&scene, 0.0).ok().filter(|falls| *falls),
        answer => answer,
    })
}

/// Angle at which rigid blocks can no longer rest on a floor that is tilted, degrees; 60 where they
/// always can. Exact where they topple, an upper bound where they slide.
///
/// azimuth: direction of the tilt, rad about z from x. Raises SceneError where the tower does not
/// rest on a level floor, or a block is tilted or fixed in the air.
#[pyfunction]
pub fn exact_tilt(scene: &Bound<'_, PyAny>, azimuth: &Bound<'_, PyAny>) -> PyResult<f64> {
    let py = scene.py();
    let (scene, azimuth) = (scene_of(scene)?, number("azimuth", azimuth)?);
    detached(py, || RigidTower::tilt(&scene, azimuth))?.map_err(unanswered)
}

#[derive(Serialize)]
struct ExactForces {
    id: u32,
    rise_m: f64,
    is_exact: bool,
    #[serde(flatten)]
    forces: Breakaway,
}

/// Exact breakaway forces of all blocks along their long axes, a list of dicts: id, straight_n and
/// turning_n, which bound the force from above and below (N), tipping_n, from which the tower rocks
/// before (None where it cannot), is_exact, where the bounds agree, and rise_m, how far the centre
/// of the rigid block rises from where it was built (m; below zero, as it comes down to rest).
///
/// Raises SceneError where rigid blocks cannot rest like this.
#[pyfunction]
pub fn exact_forces<'py>(scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = scene.py();
    let scene = scene_of(scene)?;
    let forces = detached(py, || {
        let tower = RigidTower::new(&scene)?;
        let rises = tower.displacements()?;
        let of = |(i, block): (usize, &teeter_scene::Block)| {
            let forces = tower.breakaway(i)?;
            Ok(ExactForces { id: block.id, rise_m: rises[i].x, is_exact: forces.is_exact(), forces })
        };
        scene.blocks.iter().enumerate().map(of).collect::<Result<Vec<_>, LimitError>>()
    })?;
    write(py, &forces.map_err(unanswered)?)
}

/// Definition of a fall: the blocks of a tower, and what bears each. Footing(scene, poses=None)
///
/// poses: float64 of shape (n, 7) where the blocks stand, as World.poses; by default as in the
/// scene. A block has fallen when it dropped from its bearers by a sixth of its height or tipped,
/// whichever engine moved it.
///
/// Raises SceneError or InputError.
#[pyclass(frozen, module = "teeter")]
#[derive(Debug)]
pub struct Footing {
    sizes: Vec<DVec3>,
    footing: teeter_study::Footing,
}

impl Footing {
    fn cuboids(sizes: &[DVec3], poses: &Bound<'_, PyAny>) -> PyResult<Vec<Cuboid>> {
        let wrong = || {
            let expected = format_args!("float64 of shape ({}, {POSE_STRIDE})", sizes.len());
            unexpected(Kind::Input, "poses", shown(poses), expected)
        };
        let poses: PyReadonlyArray2<'_, f64> = poses.extract().map_err(|_| wrong())?;
        if poses.shape() != [sizes.len(), POSE_STRIDE] {
            return Err(wrong());
        }
        let rows = poses.as_array();
        let cuboid = |(size, row): (&DVec3, numpy::ndarray::ArrayView1<'_, f64>)| {
            let orientation = DQuat::from_xyzw(row[3], row[4], row[5], row[6]);
            Cuboid::posed(*size, DVec3::new(row[0], row[1], row[2]), orientation.normalize())
        };
        Ok(sizes.iter().zip(rows.rows()).map(cuboid).collect())
    }
}

#[pymethods]
impl Footing {
    #[new]
    #[pyo3(signature = (scene, poses=None))]
    fn new(scene: &Bound<'_, PyAny>, poses: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let scene = scene_of(scene)?;
        let sizes: Vec<DVec3> = scene.blocks.iter().map(|block| block.size.into()).collect();
        let footing = match poses.filter(|poses| !poses.is_none()) {
            Some(poses) => teeter_study::Footing::new(&Self::cuboids(&sizes, poses)?),
            None => teeter_study::Footing::of_scene(&scene),
        };
        Ok(Self { sizes, footing })
    }

    /// Number of blocks.
    fn __len__(&self) -> usize {
        self.sizes.len()
    }

    /// True when any block has fallen.
    ///
    /// poses: float64 of shape (n, 7). Raises InputError.
    fn any_fallen(&self, poses: &Bound<'_, PyAny>) -> PyResult<bool> {
        Ok(self.footing.any_fallen_of(&Self::cuboids(&self.sizes, poses)?))
    }

    /// True when any block has fallen, or slid on its bearers by more than a quarter of a height: a
    /// tower on a floor that is tilted collapses in both manners.
    ///
    /// poses: float64 of shape (n, 7). Raises InputError.
    fn any_fallen_or_slid(&self, poses: &Bound<'_, PyAny>) -> PyResult<bool> {
        Ok(self.footing.any_fallen_or_slid_of(&Self::cuboids(&self.sizes, poses)?))
    }
}
