//! Force map: the breakaway force of each block of a tower, beside the exact one.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, BuildError, Params, World};
use teeter_scene::Scene;

use crate::breakaway_force::breakaway_force;
use crate::limit_analysis::{Breakaway, RigidTower};
use crate::par_map::par_map;
use crate::plan::pull_axis;
use crate::settle::settled;
use crate::xray::{Load, xray};

/// Relative difference of two exact forces up to which they agree.
const AGREEMENT: f64 = 0.01;

/// Forces of a block.
///
/// ```
/// # use teeter_physics::Params;
/// # use teeter_scene::{TowerOptions, config};
/// let scene = config("(1L1)-(010)", &TowerOptions::exact()).unwrap();
/// let loose = &teeter_study::force_map(&scene, Params::default(), || ())?[1];
/// assert!(loose.id == 1 && loose.is_generic() && loose.load.is_loose());
/// let exact = loose.exact.unwrap().straight_n;
/// assert!(loose.both().into_iter().flatten().all(|force| (force / exact - 1.0).abs() < 0.01));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlockForces {
    /// Id of the block.
    pub id: u32,
    /// Breakaway force along the long axis, N; none above 10 N.
    #[serde(rename = "forward_N")]
    pub forward_n: Option<f64>,
    /// Breakaway force against the long axis, N; none above 10 N.
    #[serde(rename = "backward_N")]
    pub backward_n: Option<f64>,
    /// Exact forces for rigid blocks; none where they cannot rest like this.
    pub exact: Option<Breakaway>,
    /// Exact force of straight sliding on contacts as stiff as the scene's, N; see
    /// [`RigidTower::on_springs`].
    #[serde(rename = "on_springs_N")]
    pub on_springs_n: Option<f64>,
    /// Load in the settled state.
    pub load: Load,
}

impl BlockForces {
    /// Breakaway forces along and against the long axis, N.
    pub fn both(&self) -> [Option<f64>; 2] {
        [self.forward_n, self.backward_n]
    }

    /// Returns true if the heights of the blocks determine the load: rigid contacts and contacts of
    /// the scene's stiffness agree within 1 %. Where heights differ by less than contacts give, the
    /// forces of rigid blocks do not apply.
    pub fn is_generic(&self) -> bool {
        self.exact
            .zip(self.on_springs_n)
            .is_some_and(|(exact, soft)| (soft - exact.straight_n).abs() <= AGREEMENT * exact.straight_n)
    }
}

/// Builds `scene`, lets it settle and measures the forces of each block from that one state. Calls
/// `measured` after each block.
///
/// # Errors
/// When the world cannot be built.
///
/// ```
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let blocks = teeter_study::force_map(&scene, Params::default(), || ())?;
/// let weight = scene.blocks[0].mass * scene.gravity;
/// assert!((blocks[9].forward_n.unwrap() / (scene.friction * weight) - 1.0).abs() < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn force_map(scene: &Scene, params: Params, measured: impl Fn() + Sync) -> Result<Vec<BlockForces>, BuildError> {
    let world = settled(scene, params)?;
    Ok(force_map_from(scene, &world, measured))
}

/// Measures the forces of each block from a settled world of `scene`. Calls `measured` after each
/// block.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::{force_map_from, settled};
///
/// let scene = teeter_scene::named("block").unwrap();
/// let blocks = force_map_from(&scene, &settled(&scene, Params::default())?, || ());
/// assert!(blocks[0].load.is_loose());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn force_map_from(scene: &Scene, world: &World, measured: impl Fn() + Sync) -> Vec<BlockForces> {
    let loads = xray(world, scene.friction);
    let rigid = RigidTower::new(scene).ok();
    let springs = rigid.as_ref().and_then(|r| r.on_springs().ok());
    let blocks: Vec<usize> = (0..scene.blocks.len()).collect();
    par_map(&blocks, |&i| {
        let axis = pull_axis(&scene.blocks[i]);
        let force = |axis: DVec3| breakaway_force(world, BodyId(i as u32), axis);
        let forces = BlockForces {
            id: scene.blocks[i].id,
            forward_n: force(axis),
            backward_n: force(-axis),
            exact: rigid.as_ref().and_then(|r| r.breakaway(i).ok()),
            on_springs_n: springs.as_ref().map(|s| s.straight_force(i)),
            load: loads[i],
        };
        measured();
        forces
    })
}
