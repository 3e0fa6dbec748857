//! A block in the hand.

use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::hand::grip::{GripMode, HoldGrip};
use crate::hand::limiter::TargetLimiter;
use crate::headroom::is_free;
use crate::orientation::{levelled, slide_axis};
use crate::tower_map::{CellId, Slot};

/// Largest angle by which a block is levelled when it begins to be carried, rad.
const MAX_LEVELLING: f64 = 0.3;
/// Largest distance of the goal from the grasped point while a block slides, m: reversing is felt
/// at once.
const MAX_STRETCH: f64 = 0.06;
/// Displacement up to which a block counts as not moved since it was grasped, m.
const UNMOVED: f64 = 0.004;
/// Vertical part of the axis from which a face is a top or a bottom, which is not poked.
const UPRIGHT: f64 = 0.5;
/// Displacement of the grasped point in a frame below which it is stuck, m.
const STUCK: f64 = 2e-5;

/// Activity of the hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Task {
    /// Follows the player's goal.
    Follow,
    /// Sets the block down in a slot.
    Place {
        /// The slot as it was when placing began.
        slot: Slot,
        /// Time since then, s.
        elapsed: f64,
    },
    /// Pokes the block.
    Poke {
        /// Time since the poke began, s.
        elapsed: f64,
    },
}

/// A held block and the player's goal for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hold {
    pub body: BodyId,
    /// Grasped point in the block's frame, m.
    pub anchor: DVec3,
    pub mode: GripMode,
    pub grip: HoldGrip,
    pub task: Task,
    /// Position that the player wants for the grasped point, m.
    pub goal: DVec3,
    /// Orientation that the player wants; none leaves it free.
    pub orientation: Option<DQuat>,
    /// Inward normal of the face that was touched, in the world.
    pub axis: DVec3,
    /// Grasped point when it was grasped, m.
    pub start: DVec3,
    /// True once the block has come clear of the tower, and is kept clear.
    pub is_clear: bool,
    /// Slot that attracts the block.
    pub slot: Option<CellId>,
    /// Horizontal direction to the viewer, unit vector.
    pub toward_viewer: Option<DVec2>,
    pub limiter: TargetLimiter,
    /// Grasped point at the end of the last frame, m.
    pub point: DVec3,
    /// Force of the hand in the last frame, N.
    pub force: DVec3,
    /// Time for which the point has not moved under the full force, s.
    pub stuck_s: f64,
}

impl Hold {
    /// Grasps a block at `anchor` (in its frame, m) on a face of inward normal `axis`.
    pub fn new(blocks: &Blocks, body: BodyId, anchor: DVec3, axis: DVec3, mode: GripMode) -> Self {
        let (point, orientation) = (blocks.point(body, anchor), blocks.orientation(body));
        let grip = match mode {
            GripMode::Push => HoldGrip::Push,
            GripMode::Carry => HoldGrip::Carry,
            GripMode::Slide => HoldGrip::Slide,
            GripMode::Auto if is_free(blocks, body) => HoldGrip::Carry,
            GripMode::Auto => HoldGrip::Slide,
        };
        let mut hold = Self {
            body,
            anchor,
            mode,
            grip,
            task: Task::Follow,
            goal: point,
            orientation: (grip != HoldGrip::Push).then_some(orientation),
            axis,
            start: point,
            is_clear: false,
            slot: None,
            toward_viewer: None,
            limiter: TargetLimiter::new(point, orientation),
            point,
            force: DVec3::ZERO,
            stuck_s: 0.0,
        };
        if grip == HoldGrip::Carry {
            hold.level(blocks);
        }
        hold
    }

    /// Directions in which the goal can be moved, unit vectors; none where it can go anywhere.
    pub fn axes(&self, blocks: &Blocks) -> Vec<DVec3> {
        match self.grip {
            HoldGrip::Carry => Vec::new(),
            HoldGrip::Push => vec![self.axis],
            HoldGrip::Slide => {
                let along = slide_axis(blocks.orientation(self.body));
                vec![along, DVec3::Z.cross(along).normalize_or(DVec3::Y)]
            }
        }
    }

    /// Moves the goal by the part of a displacement (m) that the grip allows.
    pub fn displace(&mut self, displacement: DVec3, blocks: &Blocks) {
        if self.grip == HoldGrip::Carry {
            self.goal += displacement;
            // The block stays above the floor.
            let lowest = self.goal.z - self.arm().z - blocks.half_extent(self.body, DVec3::Z);
            self.goal.z -= lowest.min(0.0);
            return;
        }
        self.goal += self.axes(blocks).iter().map(|axis| *axis * axis.dot(displacement)).sum::<DVec3>();
        let stretch = self.goal - self.point;
        if stretch.length() > MAX_STRETCH {
            self.goal = self.point + stretch * (MAX_STRETCH / stretch.length());
        }
    }

    /// Rotates the orientation wanted about the block's centre; the grasped point goes round with
    /// it.
    pub fn rotate(&mut self, rotation: DQuat) {
        let centre = self.goal - self.arm();
        self.orientation = self.orientation.map(|orientation| (rotation * orientation).normalize());
        self.goal = centre + self.arm();
    }

    /// From the centre to the grasped point in the orientation wanted, m.
    pub fn arm(&self) -> DVec3 {
        self.orientation.unwrap_or(DQuat::IDENTITY) * self.anchor
    }

    /// Returns true if a tap on the block pokes it: it was not moved before and was touched on a
    /// side.
    pub fn can_be_poked(&self) -> bool {
        let is_unmoved = self.goal.distance(self.start) < UNMOVED;
        is_unmoved && self.mode != GripMode::Carry && self.axis.z.abs() < UPRIGHT
    }

    /// Takes in the end of a frame of `dt` (s), with the force of the hand on the block (N).
    pub fn observe(&mut self, blocks: &Blocks, force: DVec3, is_capped: bool, dt: f64) {
        let point = blocks.point(self.body, self.anchor);
        let is_stuck = is_capped && point.distance(self.point) < STUCK;
        self.stuck_s = if is_stuck { self.stuck_s + dt } else { 0.0 };
        (self.point, self.force) = (point, force);
        match &mut self.task {
            Task::Follow => self.regrip(blocks),
            Task::Place { elapsed, .. } | Task::Poke { elapsed } => *elapsed += dt,
        }
    }

    /// A block that has come out of the tower is carried; one that is put back into it is slid.
    fn regrip(&mut self, blocks: &Blocks) {
        if self.mode != GripMode::Auto {
            return;
        }
        match (self.grip, is_free(blocks, self.body)) {
            (HoldGrip::Slide, true) => {
                self.grip = HoldGrip::Carry;
                self.goal = self.point;
                self.is_clear = true;
                self.level(blocks);
            }
            (HoldGrip::Carry, false) if self.slot.is_none() => {
                self.grip = HoldGrip::Slide;
                self.goal = self.point;
            }
            _ => {}
        }
    }

    /// Wants a block that lies nearly flat to lie flat.
    fn level(&mut self, blocks: &Blocks) {
        let orientation = self.orientation.unwrap_or_else(|| blocks.orientation(self.body));
        self.orientation = Some(levelled(orientation, MAX_LEVELLING));
        self.slot = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{blocks, push, tower};

    /// A tower of which every block leans by `angle` (rad) about the y-axis.
    fn leaning(angle: f64) -> Blocks {
        let upright = tower(&["xxx", "xxx", "xxx"], 0.0);
        let lean = DQuat::from_xyzw(0.0, libm::sin(0.5 * angle), 0.0, libm::cos(0.5 * angle));
        let mut poses = Vec::new();
        for body in upright.bodies() {
            push(&mut poses, lean * upright.position(body), lean * upright.orientation(body));
        }
        blocks(&poses)
    }

    #[test]
    fn a_block_of_a_leaning_tower_is_drawn_along_its_own_length() {
        for angle in [0.0, 0.02, -0.02, 0.1] {
            let blocks = leaning(angle);
            let body = BodyId(1);
            let anchor = DVec3::X * (0.5 * blocks.size(body).x);
            let mut hold = Hold::new(&blocks, body, anchor, DVec3::NEG_X, GripMode::Auto);
            assert_eq!((hold.grip, hold.orientation), (HoldGrip::Slide, Some(blocks.orientation(body))));
            let start = hold.goal;
            for _ in 0..10 {
                hold.displace(DVec3::new(0.004, 0.001, 0.018), &blocks);
            }
            let moved = hold.goal - start;
            assert!(moved.length() > 0.02);
            let bed = blocks.orientation(body) * DVec3::Z;
            assert!(moved.dot(bed).abs() < 1e-6, "out of the bed of the block: {} m", moved.dot(bed));
        }
    }

    #[test]
    fn a_goal_stays_near_a_block_that_does_not_follow() {
        let blocks = leaning(0.0);
        let mut hold = Hold::new(&blocks, BodyId(1), DVec3::ZERO, DVec3::NEG_X, GripMode::Auto);
        for _ in 0..100 {
            hold.displace(DVec3::X * 0.01, &blocks);
        }
        assert!((hold.goal.distance(hold.point) - MAX_STRETCH).abs() < 1e-9);
    }
}
