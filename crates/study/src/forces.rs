//! The force map: for each block of a tower the force that starts it sliding, both ways along its long axis, and beside it the exact answer.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, BuildError, Params, World};
use teeter_scene::Scene;

use crate::each::each;
use crate::exact::{Answer, Rigid};
use crate::plan::long_axis;
use crate::settle::settled;
use crate::start::starting_force;
use crate::xray::{Load, xray};

/// What there is to say of a block.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlockForces {
    /// Its id.
    pub id: u32,
    /// The force along its long axis that starts it sliding, N; none where 10 N does not.
    #[serde(rename = "forward_N")]
    pub forward_n: Option<f64>,
    /// The same against its long axis, N.
    #[serde(rename = "backward_N")]
    pub backward_n: Option<f64>,
    /// What rigid blocks would need; none where they cannot rest like this.
    pub exact: Option<Answer>,
    /// What sliding straight would need on contacts as stiff as the scene's, N; see [`Rigid::on_springs`].
    #[serde(rename = "on_springs_N")]
    pub on_springs_n: Option<f64>,
    /// What it carries in the settled state.
    pub load: Load,
}

impl BlockForces {
    /// The force of each direction, N.
    pub fn both(&self) -> [Option<f64>; 2] {
        [self.forward_n, self.backward_n]
    }

    /// Whether heights decide what the block carries: contacts that give as the scene's do say what rigid ones say, within 1 %. Where heights differ by
    /// less than contacts give, rigid blocks are no answer.
    pub fn is_generic(&self) -> bool {
        self.exact
            .zip(self.on_springs_n)
            .is_some_and(|(exact, soft)| (soft - exact.straight_n).abs() <= 0.01 * exact.straight_n)
    }
}

/// The force map of `scene`: all forces are measured from one settled state. `done` is called after each block.
///
/// # Errors
/// When the world cannot be built.
pub fn forces(scene: &Scene, params: Params, done: impl Fn() + Sync) -> Result<Vec<BlockForces>, BuildError> {
    let world = settled(scene, params)?;
    Ok(forces_from(scene, &world, done))
}

/// The same from a world of `scene` that has settled.
pub fn forces_from(scene: &Scene, world: &World, done: impl Fn() + Sync) -> Vec<BlockForces> {
    let loads = xray(world, scene.friction);
    let rigid = Rigid::new(scene).ok();
    let springs = rigid.as_ref().and_then(|r| r.on_springs().ok());
    let blocks: Vec<usize> = (0..scene.blocks.len()).collect();
    each(&blocks, |&i| {
        let axis = long_axis(&scene.blocks[i]).extend(0.0);
        let pull = |axis: DVec3| starting_force(world, BodyId(i as u32), axis);
        let of = BlockForces {
            id: scene.blocks[i].id,
            forward_n: pull(axis),
            backward_n: pull(-axis),
            exact: rigid.as_ref().and_then(|r| r.answer(i).ok()),
            on_springs_n: springs.as_ref().map(|s| s.straight_pull(i)),
            load: loads[i],
        };
        done();
        of
    })
}
