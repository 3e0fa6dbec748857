//! Disabling blocks that hardly move (sections 4.7 and 5.7.1, appendix 2.5).

use glam::DVec3;

use super::block::{Block, CORNERS};
use super::constants::Constants;
use super::model::Model;
use super::particle::State;

/// Disables the blocks whose particles moved less than the threshold in this step, and restores
/// their positions (appendix 2.5). Returns their indices.
///
/// Velocities stay, so a block that was just released falls one step late. The rule measures the
/// wrong motion: a block that vibrates on its springs counts as moving, one that tips slowly does
/// not.
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
        let travel: f64 = block.corners().map(|p| next[p].position.distance(curr[p].position)).sum();
        if travel < constants.disable_threshold {
            block.active = false;
            for p in block.corners() {
                next[p].position = curr[p].position;
            }
            disabled.push(n);
        }
    }
    disabled
}

/// Rigid pose of a block: its centre and two of its axes, which vibration on the springs leaves in
/// place.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pose {
    centre: DVec3,
    axes: [DVec3; 2],
}

impl Pose {
    fn of(block: &Block, states: &[State]) -> Self {
        let corners = &states[block.corners()];
        // Along an axis: the mean of the corners on one side minus that on the other.
        let axis = |bit: usize| {
            let signed = |c: usize| if c >> bit & 1 == 1 { corners[c].position } else { -corners[c].position };
            (0..CORNERS).map(signed).sum::<DVec3>().normalize_or_zero()
        };
        Self { centre: block.centre(states), axes: [axis(0), axis(1)] }
    }

    /// Upper bound on the displacement between two poses of a corner at `radius` (m) from the
    /// centre, m.
    fn distance(&self, other: &Self, radius: f64) -> f64 {
        let rotation = self.axes[0].distance(other.axes[0]).max(self.axes[1].distance(other.axes[1]));
        self.centre.distance(other.centre) + rotation * radius
    }
}

/// Detector of rest by the rigid motion of blocks over time: the test that section 6.3 asks for.
#[derive(Debug, Clone, Default)]
pub struct RestDetector {
    /// Reference pose of each block, and its age, s.
    references: Vec<(Pose, f64)>,
    /// Half the diagonal of each block, m.
    radii: Vec<f64>,
}

/// Influences on the blocks in a step.
#[derive(Debug, Clone, Copy)]
pub struct Activity<'a> {
    /// Index of the block in the hand.
    pub held: Option<u32>,
    /// Pairs of blocks in contact.
    pub neighbours: &'a [[u32; 2]],
}

impl RestDetector {
    /// Creates a detector with the current poses as references.
    pub fn new(model: &Model, states: &[State]) -> Self {
        let references = model.blocks.iter().map(|b| (Pose::of(b, states), 0.0)).collect();
        let radius = |b: &Block| states[b.corners().start].position.distance(b.centre(states));
        Self { references, radii: model.blocks.iter().map(radius).collect() }
    }

    /// Resets the time of a block.
    pub fn wake(&mut self, block: usize) {
        self.references[block].1 = 0.0;
    }

    /// Disables the blocks that have rested for long enough, and enables the neighbours of moving
    /// blocks.
    pub fn update(&mut self, model: &mut Model, constants: &Constants, activity: Activity, states: &mut [State]) {
        let Activity { held, neighbours } = activity;
        let mut moved = vec![false; model.blocks.len()];
        for (n, block) in model.blocks.iter().enumerate() {
            let pose = Pose::of(block, states);
            let (start, time) = &mut self.references[n];
            *time += constants.step();
            if pose.distance(start, self.radii[n]) > constants.rest_distance || held == Some(n as u32) {
                (*start, *time) = (pose, 0.0);
                moved[n] = block.active;
            }
        }
        for &[a, b] in neighbours {
            for (mover, other) in [(a as usize, b as usize), (b as usize, a as usize)] {
                if moved[mover] && !model.blocks[other].active {
                    model.blocks[other].active = true;
                    self.references[other].1 = 0.0;
                }
            }
        }
        for (n, block) in model.blocks.iter_mut().enumerate() {
            if block.active && self.references[n].1 >= constants.rest_time {
                block.active = false;
                for p in block.corners() {
                    states[p].velocity = DVec3::ZERO;
                }
            }
        }
    }
}
