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
        let mut ranking = Ranking::new(world, bodies, count);
        while !ranking.is_done() {
            ranking.finish_round();
        }
        ranking.finish()
    }

    /// Plan of the move.
    pub fn plan(&self) -> MovePlan {
        MovePlan::pull(self.body, self.toward)
    }
}

/// A ranking in progress, block by block: [`Candidate::best`] for a caller that has other work in
/// between.
#[derive(Debug, Clone)]
pub struct Ranking {
    /// The tower for limit analysis.
    scene: Scene,
    count: usize,
    /// Candidates in their order, the loosest first or by another cost; the first of them are
    /// analysed.
    candidates: Vec<Candidate>,
    analysed: usize,
}

impl Ranking {
    /// Begins to rank blocks: by the X-ray alone.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn new(world: &World, bodies: &[BodyId], count: usize) -> Self {
        Self::by(world, bodies, count, |candidate| candidate.tightness_n)
    }

    /// Begins to rank blocks by a cost that is known without limit analysis, the smallest first.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn by(world: &World, bodies: &[BodyId], count: usize, cost: impl Fn(&Candidate) -> f64) -> Self {
        let loads = xray(world, world.scene().friction);
        let candidate = |body: &BodyId| Candidate {
            body: *body,
            toward: outward(world, *body),
            tightness_n: loads[body.index()].tightness_n,
            falls: None,
        };
        let mut candidates: Vec<(f64, Candidate)> = bodies.iter().map(candidate).map(|c| (cost(&c), c)).collect();
        candidates.sort_by(|(a, of_a), (b, of_b)| a.total_cmp(b).then(of_a.body.cmp(&of_b.body)));
        let candidates = candidates.into_iter().map(|(_, candidate)| candidate).collect();
        Self { scene: levelled(world), count: count.max(1), candidates, analysed: 0 }
    }

    /// Returns true if a round has ended with enough blocks without which the tower stands, or all
    /// are analysed.
    pub fn is_done(&self) -> bool {
        let standing = self.candidates[..self.analysed].iter().filter(|candidate| candidate.falls != Some(true));
        let is_round = self.analysed.is_multiple_of(self.count);
        self.analysed == self.candidates.len() || (is_round && standing.count() >= self.count)
    }

    /// Part of the blocks that is analysed, 0 to 1.
    pub fn progress(&self) -> f64 {
        if self.is_done() { 1.0 } else { self.analysed as f64 / self.candidates.len() as f64 }
    }

    /// Analyses the next block, where the ranking is not done.
    pub fn step(&mut self) {
        if !self.is_done() {
            self.candidates[self.analysed].falls = self.falls(&self.candidates[self.analysed]);
            self.analysed += 1;
        }
    }

    /// Analyses the other blocks of the round side by side.
    pub fn finish_round(&mut self) {
        let end = ((self.analysed / self.count + 1) * self.count).min(self.candidates.len());
        let falls = par_map(&self.candidates[self.analysed..end], |candidate| self.falls(candidate));
        for (candidate, falls) in self.candidates[self.analysed..end].iter_mut().zip(falls) {
            candidate.falls = falls;
        }
        self.analysed = end;
    }

    /// Ends with the candidates that were analysed: those without which the tower stands first, at
    /// most as many as were wanted.
    pub fn finish(mut self) -> Vec<Candidate> {
        self.candidates.truncate(self.analysed);
        // The sort is stable: they stay in their order.
        self.candidates.sort_by_key(|candidate| candidate.falls == Some(true));
        self.candidates.truncate(self.count);
        self.candidates
    }

    fn falls(&self, candidate: &Candidate) -> Option<bool> {
        RigidTower::falls(&without_block(&self.scene, candidate.body.index()))
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
