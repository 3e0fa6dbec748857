//! Fallen blocks of a tower in play.

use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;
use teeter_study::{Footing, VISIBLE_SPEED};

use crate::blocks::Blocks;

/// Time that a block is in the player's care after it was let go, s.
const CARE: f64 = 1.5;

/// State of a tower.
///
/// ```
/// use teeter_game::{Command, Game, TowerState};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default())?);
/// let update = (0..120).map(|_| game.step(&Command::Idle)).last().unwrap();
/// assert_eq!(update.tower, TowerState::Standing);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TowerState {
    /// Nothing moves visibly.
    Standing,
    /// A block moves visibly.
    Moving,
    /// A block has fallen.
    Fallen,
}

/// State at the end of a frame, beside the blocks.
///
/// ```
/// use teeter_game::{Blocks, FallDetector, FrameEnd};
/// use teeter_physics::{BodyId, Params, World};
///
/// // a block in the hand comes down, and that is no fall
/// let blocks = |name| {
///     let scene = teeter_scene::named(name).unwrap();
///     World::new(&scene, Params::default()).map(|world| Blocks::of(&world))
/// };
/// let mut detector = FallDetector::new(&blocks("block")?);
/// let frame = FrameEnd { time: 0.1, max_speed: 0.5, held: Some(BodyId(0)) };
/// assert!(detector.observe(&blocks("block")?, frame).is_empty());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameEnd {
    /// Simulated time, s.
    pub time: f64,
    /// Speed of the fastest block, m/s.
    pub max_speed: f64,
    /// Block in the hand.
    pub held: Option<BodyId>,
}

/// Detector of falls: a block that nobody holds and that drops from its bearers, or tips, has
/// fallen, see [`Footing`]; it stays fallen.
///
/// A block in the player's care, held or let go less than 1.5 s ago, has a new footing where it is
/// and bears nothing: putting it on the floor is no fall, and a block that loses it as its support
/// falls once it comes down on the next.
///
/// ```
/// use glam::DVec3;
/// use teeter_game::{Blocks, FallDetector, FrameEnd, TowerState};
///
/// let block = |z| Blocks::new(vec![DVec3::splat(0.02)], &[0.0, 0.0, z, 0.0, 0.0, 0.0, 1.0]);
/// let mut detector = FallDetector::new(&block(0.1));
/// let frame = FrameEnd { time: 0.1, max_speed: 0.5, held: None };
/// detector.observe(&block(0.01), frame);
/// assert_eq!(detector.state(), TowerState::Fallen);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FallDetector {
    footing: Footing,
    /// Simulated time until which each block is in the player's care, s.
    care_until: Vec<f64>,
    fallen: Vec<bool>,
    moving: bool,
}

impl FallDetector {
    /// A detector for blocks that stand as they are.
    pub fn new(blocks: &Blocks) -> Self {
        Self::with_footing(Footing::new(&blocks.cuboids()))
    }

    /// A detector for blocks that have stood as in a footing.
    pub fn with_footing(footing: Footing) -> Self {
        let count = footing.len();
        Self { footing, care_until: vec![-1.0; count], fallen: vec![false; count], moving: false }
    }

    /// Advances to the end of a frame and returns the blocks that fell in it.
    pub fn observe(&mut self, blocks: &Blocks, frame: FrameEnd) -> Vec<BodyId> {
        let FrameEnd { time, max_speed, held } = frame;
        if let Some(body) = held {
            self.care_until[body.index()] = time + CARE;
        }
        self.moving = max_speed > VISIBLE_SPEED;
        let cuboids = blocks.cuboids();
        for body in blocks.bodies().filter(|body| self.care_until[body.index()] >= time) {
            self.footing.renew(body, &cuboids);
        }
        let before = self.fallen.clone();
        let in_care = |body: BodyId| self.care_until[body.index()] >= time;
        self.footing.mark_fallen(&cuboids, in_care, &mut self.fallen);
        blocks.bodies().filter(|body| self.fallen[body.index()] && !before[body.index()]).collect()
    }

    /// State of the tower.
    pub fn state(&self) -> TowerState {
        if self.fallen.contains(&true) {
            TowerState::Fallen
        } else if self.moving {
            TowerState::Moving
        } else {
            TowerState::Standing
        }
    }

    /// Blocks that have fallen.
    pub fn fallen(&self) -> Vec<BodyId> {
        (0..).zip(&self.fallen).filter(|(_, fallen)| **fallen).map(|(body, _)| BodyId(body)).collect()
    }

    /// Returns true if the detector is one of `count` blocks.
    pub(crate) fn is_of(&self, count: usize) -> bool {
        [self.footing.len(), self.care_until.len(), self.fallen.len()].iter().all(|len| *len == count)
            && self.footing.is_valid()
    }
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};

    use super::*;
    use crate::blocks::samples::{SIZE, blocks, moved, push, tower};

    const IDLE: FrameEnd = FrameEnd { time: 0.1, max_speed: 0.0, held: None };

    fn lowered(blocks: &Blocks, body: u32, by: f64) -> Blocks {
        moved(blocks, body, DVec3::NEG_Z * by)
    }

    #[test]
    fn a_block_that_comes_down_by_itself_has_fallen_and_stays_fallen() {
        let standing = tower(&["xxx", "xxx"], 0.0);
        let mut detector = FallDetector::new(&standing);
        let mut state = |blocks: &Blocks, time, speed| {
            let fell = detector.observe(blocks, FrameEnd { time, max_speed: speed, held: None });
            (detector.state(), fell, detector.fallen())
        };
        assert_eq!(state(&standing, 0.0, 0.0), (TowerState::Standing, vec![], vec![]));
        assert_eq!(state(&standing, 0.1, 0.02), (TowerState::Moving, vec![], vec![]));
        // a sixth of 18 mm
        assert_eq!(state(&lowered(&standing, 5, 0.0029), 0.2, 0.0), (TowerState::Standing, vec![], vec![]));
        assert_eq!(
            state(&lowered(&standing, 5, 0.0031), 0.3, 0.1),
            (TowerState::Fallen, vec![BodyId(5)], vec![BodyId(5)])
        );
        assert_eq!(state(&standing, 0.4, 0.0), (TowerState::Fallen, vec![], vec![BodyId(5)]));
    }

    #[test]
    fn a_block_without_a_finite_position_has_fallen() {
        let tower = tower(&["xxx"], 0.0);
        let mut detector = FallDetector::new(&tower);
        assert_eq!(detector.observe(&lowered(&tower, 1, f64::NAN), IDLE), [BodyId(1)]);
        assert_eq!(detector.state(), TowerState::Fallen);
    }

    #[test]
    fn a_block_put_on_the_floor_by_the_hand_is_no_fall_and_others_that_fall_with_it_are() {
        let tower = tower(&["xxx", "xxx"], 0.0);
        let mut detector = FallDetector::new(&tower);
        detector.observe(&tower, FrameEnd { time: 1.0, max_speed: 0.1, held: Some(BodyId(4)) });
        let beside = moved(&tower, 4, DVec3::new(0.2, 0.0, -SIZE.z));
        detector.observe(&beside, FrameEnd { time: 1.5, max_speed: 0.1, held: None });
        assert_eq!(detector.state(), TowerState::Moving);
        detector.observe(&beside, FrameEnd { time: 4.0, ..IDLE });
        assert_eq!(detector.state(), TowerState::Standing);
        let both = moved(&beside, 3, DVec3::new(-0.2, 0.0, -SIZE.z));
        assert_eq!(detector.observe(&both, FrameEnd { time: 4.1, ..IDLE }), [BodyId(3)]);
        assert_eq!(detector.state(), TowerState::Fallen);
    }

    #[test]
    fn a_block_that_is_let_go_3_mm_above_its_slot_drops_into_place_without_a_fall() {
        let tower = tower(&["xxx", "xxx"], 0.0);
        let mut detector = FallDetector::new(&tower);
        let raised = lowered(&tower, 4, -0.003);
        detector.observe(&raised, FrameEnd { time: 1.0, max_speed: 0.1, held: Some(BodyId(4)) });
        detector.observe(&tower, FrameEnd { time: 1.2, ..IDLE });
        detector.observe(&tower, FrameEnd { time: 9.0, ..IDLE });
        assert_eq!(detector.state(), TowerState::Standing);
    }

    #[test]
    fn a_block_falls_that_drops_where_the_hand_drew_its_only_support_away() {
        let tower = tower(&["xxx", ".x.", ".x."], 0.0);
        let mut detector = FallDetector::new(&tower);
        let (support, above) = (3, 4);
        detector.observe(&tower, FrameEnd { time: 1.0, max_speed: 0.1, held: Some(BodyId(support)) });
        let drawn = moved(&tower, support, DVec3::Y * 0.1);
        let held = FrameEnd { time: 1.5, max_speed: 0.1, held: Some(BodyId(support)) };
        assert_eq!(detector.observe(&drawn, held), []);
        let dropped = lowered(&drawn, above, SIZE.z);
        assert_eq!(detector.observe(&dropped, FrameEnd { time: 1.6, ..held }), [BodyId(above)]);
    }

    #[test]
    fn a_block_that_tips_over_the_edge_of_its_row_has_fallen() {
        let tower = tower(&["xxx", "x.."], 0.0);
        let tipped = |angle: f64| {
            let mut poses = Vec::new();
            for body in tower.bodies() {
                let turn = if body == BodyId(3) { DQuat::from_rotation_y(angle) } else { DQuat::IDENTITY };
                push(&mut poses, tower.position(body), turn * tower.orientation(body));
            }
            blocks(&poses)
        };
        let mut detector = FallDetector::new(&tower);
        // across, its corners are 26.8 mm apart: half of 18 mm is 19.6 degrees
        assert_eq!(detector.observe(&tipped(0.33), IDLE), []);
        assert_eq!(detector.observe(&tipped(0.35), IDLE), [BodyId(3)]);
    }

    /// The paths along bearers that have fallen are three to the number of the rows.
    #[test]
    fn the_fall_of_a_tower_of_forty_rows_is_found_in_no_time() {
        let upright = tower(&["xxx"; 40], 0.0);
        let mut detector = FallDetector::new(&upright);
        let mut poses = Vec::new();
        for body in upright.bodies() {
            let position = upright.position(body);
            push(&mut poses, position.with_z(0.3 * position.z - 0.02), upright.orientation(body));
        }
        detector.observe(&blocks(&poses), IDLE);
        assert_eq!(detector.fallen().len(), 120);
    }

    #[test]
    fn a_tower_of_soft_blocks_that_sinks_has_not_fallen_and_a_block_that_falls_from_it_has() {
        let upright = tower(&["xxx"; 18], 0.0);
        let mut detector = FallDetector::new(&upright);
        let mut poses = Vec::new();
        for body in upright.bodies() {
            let position = upright.position(body);
            push(&mut poses, position.with_z(0.6 * position.z), upright.orientation(body));
        }
        // blocks of six tenths of their height
        let offset = 1.0 / 3f64.sqrt();
        let strained = |poses: &[f64]| {
            let mut sunk = blocks(poses);
            let point =
                |i: usize| DVec3::from([0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.5 * offset } else { -0.5 * offset }));
            let particles: Vec<[DVec3; 8]> = sunk
                .bodies()
                .map(|body| std::array::from_fn(|i| sunk.point(body, point(i) * SIZE * DVec3::new(1.0, 1.0, 0.6))))
                .collect();
            sunk.set_particles(&particles, offset);
            sunk
        };
        detector.observe(&strained(&poses), IDLE);
        assert_eq!(detector.state(), TowerState::Standing);
        poses[7 * 53 + 2] -= 0.0031;
        assert_eq!(detector.observe(&strained(&poses), IDLE), [BodyId(53)]);
    }
}
