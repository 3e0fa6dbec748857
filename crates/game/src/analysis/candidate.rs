//! Moves worth trying: blocks ranked by the X-ray, and by limit analysis of the tower without them.

use glam::{DQuat, DVec2, DVec3};
use teeter_physics::{BodyId, World};
use teeter_scene::Scene;
use teeter_study::{RigidTower, par_map, without_block, xray};

use crate::orientation::slide_axis;
use crate::player::stage::MovePlan;

/// A block that could be taken.
///
/// ```
/// use teeter_game::Candidate;
/// use teeter_physics::{BodyId, Params};
///
/// let world = teeter_study::settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let ranked = Candidate::ranked(&world, &[BodyId(2), BodyId(9)]);
/// // the top block is free, and the column falls without the other
/// assert_eq!((ranked[0].body, ranked[0].falls), (BodyId(9), Some(false)));
/// assert_eq!((ranked[1].body, ranked[1].falls), (BodyId(2), Some(true)));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The block.
    pub body: BodyId,
    /// Direction in which it leaves the tower: by the end that stands out.
    pub toward: DVec3,
    /// Force that starts it sliding, by the X-ray, N.
    pub tightness_n: f64,
    /// True when rigid blocks fall without it; none where they have no exact answer.
    pub falls: Option<bool>,
}

impl Candidate {
    /// Candidates of blocks: those without which the tower stands first, and of these the loosest
    /// first.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn ranked(world: &World, bodies: &[BodyId]) -> Vec<Self> {
        Self::best(world, bodies, bodies.len())
    }

    /// The first `count` of [`Candidate::ranked`]. Limit analysis takes the blocks from the loosest
    /// on, and ends once it has so many without which the tower stands.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn best(world: &World, bodies: &[BodyId], count: usize) -> Vec<Self> {
        let loads = xray(world, world.scene().friction);
        let tightness = |body: BodyId| loads[body.index()].tightness_n;
        let mut bodies = bodies.to_vec();
        bodies.sort_by(|a, b| tightness(*a).total_cmp(&tightness(*b)).then(a.cmp(b)));
        let scene = levelled(world);
        let mut candidates: Vec<Self> = Vec::new();
        for chunk in bodies.chunks(count.max(1)) {
            candidates.extend(par_map(chunk, |body| Self {
                body: *body,
                toward: outward(world, *body),
                tightness_n: tightness(*body),
                falls: RigidTower::falls(&without_block(&scene, body.index())),
            }));
            if candidates.iter().filter(|candidate| candidate.falls != Some(true)).count() >= count {
                break;
            }
        }
        // The sort is stable: the loosest stay first.
        candidates.sort_by_key(|candidate| candidate.falls == Some(true));
        candidates.truncate(count);
        candidates
    }

    /// Plan of the move.
    pub fn plan(&self) -> MovePlan {
        MovePlan::pull(self.body, self.toward)
    }
}

/// The present state with every block upright, as limit analysis has it: the tilts of a tower that
/// stands are those of contacts that give.
fn levelled(world: &World) -> Scene {
    let mut scene = world.to_scene();
    for block in &mut scene.blocks {
        let along = DQuat::from_array(block.rotation()) * DVec3::X;
        (block.yaw, block.orientation) = (libm::atan2(along.y, along.x), None);
    }
    scene
}

/// Direction along a block, away from the middle of all blocks.
fn outward(world: &World, body: BodyId) -> DVec3 {
    let along = slide_axis(world.pose(body).orientation);
    let plan = |body: BodyId| world.pose(body).position.truncate();
    let middle = world.bodies().map(plan).sum::<DVec2>() / world.len() as f64;
    // Settling moves a block by less.
    if (plan(body) - middle).dot(along.truncate()) < -1e-3 { -along } else { along }
}
