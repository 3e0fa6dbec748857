//! Disabling blocks that hardly move (sections 4.7 and 5.7.1, appendix 2.5).

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::block::{Block, CORNERS};
use super::constants::Constants;
use super::model::Model;
use super::particle::State;

/// How blocks are disabled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Disabling {
    /// Never.
    Off,
    /// As in appendix 2.5: by the ways of the particles in the one step.
    Listed,
    /// By the rigid motion of the block over a time; disabled blocks stay so, take no steps and are not tested against each other.
    Rigid,
}

/// Disables the blocks whose particles went less than the threshold in this step, and puts them back to where they were; appendix 2.5 as it
/// is. It leaves the velocities, so what has only just been let go is late by a step and does not hang in the air.
///
/// Its fault is what it measures: a block that breathes on its springs counts as moving, one that begins to tip slowly does not.
pub fn disable_motionless(
    model: &mut Model,
    constants: &Constants,
    held: Option<u32>,
    curr: &[State],
    next: &mut [State],
) -> Vec<usize> {
    let mut disabled = Vec::new();
    for (n, block) in model.blocks.iter_mut().enumerate() {
        if held == Some(n as u32) {
            continue;
        }
        let ways: f64 = block.corners().map(|p| next[p].position.distance(curr[p].position)).sum();
        if ways < constants.disable_threshold {
            block.active = false;
            for p in block.corners() {
                next[p].position = curr[p].position;
            }
            disabled.push(n);
        }
    }
    disabled
}

/// What of a block moves as a whole: its centre and two of its axes, so that what breathes stays where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pose {
    centre: DVec3,
    axes: [DVec3; 2],
}

impl Pose {
    fn of(block: &Block, states: &[State]) -> Self {
        let corners = &states[block.corners()];
        // Along an axis, the mean of the corners on one side less that on the other.
        let axis = |bit: usize| {
            let signed = |c: usize| if c >> bit & 1 == 1 { corners[c].position } else { -corners[c].position };
            (0..CORNERS).map(signed).sum::<DVec3>().normalize_or_zero()
        };
        Self { centre: block.centre(states), axes: [axis(0), axis(1)] }
    }

    /// How far a corner at `reach` (m) from the centre is at most from where another pose puts it, m.
    fn distance(&self, other: &Self, reach: f64) -> f64 {
        let turn = self.axes[0].distance(other.axes[0]).max(self.axes[1].distance(other.axes[1]));
        self.centre.distance(other.centre) + turn * reach
    }
}

/// Watches the rigid motion of blocks over time: the test that section 6.3 asks for.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    /// Where each block was when its time began, and how long that is ago, s.
    since: Vec<(Pose, f64)>,
    /// Half the diagonal of each block, m.
    reach: Vec<f64>,
}

impl Watch {
    /// Begins to watch.
    pub fn new(model: &Model, states: &[State]) -> Self {
        let since = model.blocks.iter().map(|b| (Pose::of(b, states), 0.0)).collect();
        let reach = |b: &Block| states[b.corners().start].position.distance(b.centre(states));
        Self { since, reach: model.blocks.iter().map(reach).collect() }
    }

    /// Begins the time of a block anew.
    pub fn wake(&mut self, block: usize) {
        self.since[block].1 = 0.0;
    }

    /// After a step: disables what has been still for long enough, with all that could push it still too, and enables the neighbours of what
    /// moves.
    pub fn update(
        &mut self,
        model: &mut Model,
        constants: &Constants,
        held: Option<u32>,
        neighbours: &[[u32; 2]],
        states: &mut [State],
    ) {
        let mut moved = vec![false; model.blocks.len()];
        for (n, block) in model.blocks.iter().enumerate() {
            let pose = Pose::of(block, states);
            let (start, time) = &mut self.since[n];
            *time += constants.step();
            if pose.distance(start, self.reach[n]) > constants.rest_distance || held == Some(n as u32) {
                (*start, *time) = (pose, 0.0);
                moved[n] = block.active;
            }
        }
        for &[a, b] in neighbours {
            for (mover, other) in [(a as usize, b as usize), (b as usize, a as usize)] {
                if moved[mover] && !model.blocks[other].active {
                    model.blocks[other].active = true;
                    self.since[other].1 = 0.0;
                }
            }
        }
        for (n, block) in model.blocks.iter_mut().enumerate() {
            if block.active && self.since[n].1 >= constants.rest_time {
                block.active = false;
                for p in block.corners() {
                    states[p].velocity = DVec3::ZERO;
                }
            }
        }
    }
}
