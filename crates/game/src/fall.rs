//! Fallen blocks of a tower in play.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;
use teeter_study::{VISIBLE_SPEED, has_dropped};

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

/// State at the end of a frame, beside the positions.
///
/// ```
/// use glam::DVec3;
/// use teeter_game::{FallDetector, FrameEnd};
/// use teeter_physics::BodyId;
///
/// // a block in the hand comes down, and that is no fall
/// let mut detector = FallDetector::new(&[DVec3::Z]);
/// let frame = FrameEnd { time: 0.1, max_speed: 0.5, held: Some(BodyId(0)) };
/// assert!(detector.observe(&[DVec3::Z * 0.9], None, frame).is_empty());
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

/// Detector of falls: a block that nobody holds and that comes down by more than
/// [`FELL_DROPPED`](crate::FELL_DROPPED) has fallen, and stays fallen.
///
/// A hand moves blocks sideways, so only the drop counts. A block in the player's care, held or let
/// go less than 1.5 s ago, takes its new height with it: putting it on the floor is no fall.
///
/// ```
/// use glam::DVec3;
/// use teeter_game::{FallDetector, FrameEnd, TowerState};
///
/// let mut detector = FallDetector::new(&[DVec3::Z]);
/// let frame = FrameEnd { time: 0.1, max_speed: 0.5, held: None };
/// detector.observe(&[DVec3::Z * 0.99], None, frame);
/// assert_eq!(detector.state(), TowerState::Fallen);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FallDetector {
    /// Heights of the centres if no block were strained, m.
    heights: Vec<f64>,
    /// Simulated time until which each block is in the player's care, s.
    care_until: Vec<f64>,
    fallen: Vec<bool>,
    moving: bool,
}

impl FallDetector {
    /// A detector for blocks that stand at `positions`, m.
    pub fn new(positions: &[DVec3]) -> Self {
        let count = positions.len();
        Self {
            heights: positions.iter().map(|p| p.z).collect(),
            care_until: vec![-1.0; count],
            fallen: vec![false; count],
            moving: false,
        }
    }

    /// Heights of the centres if no block were strained, m.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Advances to the end of a frame and returns the blocks that fell in it. `settled` is the
    /// distance by which strain lets each block be lower (m).
    pub fn observe(&mut self, positions: &[DVec3], settled: Option<&[f64]>, frame: FrameEnd) -> Vec<BodyId> {
        let FrameEnd { time, max_speed, held } = frame;
        if let Some(body) = held {
            self.care_until[body.index()] = time + CARE;
        }
        self.moving = max_speed > VISIBLE_SPEED;
        let mut fell = Vec::new();
        for (body, position) in positions.iter().enumerate() {
            let height = position.z + settled.map_or(0.0, |settled| settled[body]);
            if self.care_until[body] >= time {
                self.heights[body] = height;
            } else if !self.fallen[body] && has_dropped(self.heights[body] - height) {
                self.fallen[body] = true;
                fell.push(BodyId(body as u32));
            }
        }
        fell
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
        [self.heights.len(), self.care_until.len(), self.fallen.len()].iter().all(|len| *len == count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{SIZE, blocks, push, tower};
    use crate::settlement::settlement;

    fn lowered(positions: &[DVec3], body: usize, by: f64) -> Vec<DVec3> {
        let mut positions = positions.to_vec();
        positions[body].z -= by;
        positions
    }

    #[test]
    fn a_block_that_comes_down_by_itself_has_fallen_and_stays_fallen() {
        let tower = tower(&["xxx", "xxx"], 0.0);
        let mut detector = FallDetector::new(tower.positions());
        let mut state = |positions: &[DVec3], time, speed| {
            let fell = detector.observe(positions, None, FrameEnd { time, max_speed: speed, held: None });
            (detector.state(), fell, detector.fallen())
        };
        let standing = tower.positions();
        assert_eq!(state(standing, 0.0, 0.0), (TowerState::Standing, vec![], vec![]));
        assert_eq!(state(standing, 0.1, 0.02), (TowerState::Moving, vec![], vec![]));
        assert_eq!(state(&lowered(standing, 5, 0.0029), 0.2, 0.0), (TowerState::Standing, vec![], vec![]));
        assert_eq!(
            state(&lowered(standing, 5, 0.0031), 0.3, 0.1),
            (TowerState::Fallen, vec![BodyId(5)], vec![BodyId(5)])
        );
        assert_eq!(state(standing, 0.4, 0.0), (TowerState::Fallen, vec![], vec![BodyId(5)]));
    }

    #[test]
    fn a_block_without_a_finite_position_has_fallen() {
        let tower = tower(&["xxx"], 0.0);
        let mut detector = FallDetector::new(tower.positions());
        assert_eq!(
            detector.observe(
                &lowered(tower.positions(), 1, f64::NAN),
                None,
                FrameEnd { time: 0.1, max_speed: 0.0, held: None }
            ),
            [BodyId(1)]
        );
        assert_eq!(detector.state(), TowerState::Fallen);
    }

    #[test]
    fn a_block_put_on_the_floor_by_the_hand_is_no_fall_and_others_that_fall_with_it_are() {
        let tower = tower(&["xxx", "xxx"], 0.0);
        let mut detector = FallDetector::new(tower.positions());
        let mut positions = tower.positions().to_vec();
        detector.observe(&positions, None, FrameEnd { time: 1.0, max_speed: 0.1, held: Some(BodyId(4)) });
        positions[4].z = 0.009;
        detector.observe(&positions, None, FrameEnd { time: 1.5, max_speed: 0.1, held: None });
        assert_eq!(detector.state(), TowerState::Moving);
        detector.observe(&positions, None, FrameEnd { time: 4.0, max_speed: 0.0, held: None });
        assert_eq!(detector.state(), TowerState::Standing);
        positions[3].z = 0.009;
        assert_eq!(detector.observe(&positions, None, FrameEnd { time: 4.1, max_speed: 0.0, held: None }), [BodyId(3)]);
        assert_eq!(detector.state(), TowerState::Fallen);
    }

    #[test]
    fn a_tower_of_soft_blocks_that_sinks_has_not_fallen_and_a_block_that_falls_from_it_has() {
        let upright = tower(&["xxx"; 18], 0.0);
        let mut detector = FallDetector::new(upright.positions());
        assert_eq!(settlement(&upright, detector.heights()), None);
        let mut poses = Vec::new();
        for body in upright.bodies() {
            let position = upright.position(body);
            push(&mut poses, position.with_z(0.9 * position.z), upright.orientation(body));
        }
        let mut sunk = blocks(&poses);
        // Blocks of nine tenths of their height.
        let offset = 1.0 / 3f64.sqrt();
        let particles: Vec<[DVec3; 8]> = sunk
            .bodies()
            .map(|body| {
                std::array::from_fn(|i| {
                    let side =
                        DVec3::from([0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.5 * offset } else { -0.5 * offset }));
                    sunk.point(body, side * SIZE * DVec3::new(1.0, 1.0, 0.9))
                })
            })
            .collect();
        sunk.set_particles(&particles, offset);
        let settled = settlement(&sunk, detector.heights()).expect("the blocks are strained");
        assert!((settled[53] - 0.1 * 17.5 * SIZE.z).abs() < 5e-6, "of the top row: {} m", settled[53]);
        assert!((settled[0] - 0.05 * SIZE.z).abs() < 5e-6, "of the lowest: {} m", settled[0]);
        detector.observe(sunk.positions(), Some(&settled), FrameEnd { time: 1.0, max_speed: 0.0, held: None });
        assert_eq!(detector.state(), TowerState::Standing);
        detector.observe(
            &lowered(sunk.positions(), 53, 0.006),
            Some(&settled),
            FrameEnd { time: 1.1, max_speed: 0.0, held: None },
        );
        assert_eq!((detector.state(), detector.fallen()), (TowerState::Fallen, vec![BodyId(53)]));
    }
}
