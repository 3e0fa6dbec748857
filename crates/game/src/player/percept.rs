//! A block as a player sees and feels it, some time late.

use std::collections::VecDeque;

use glam::{DQuat, DVec3};
use teeter_physics::BodyId;

use crate::game::Game;
use crate::hand::grip::HoldGrip;
use crate::simulator::Simulator;

/// Block and hand as a player perceives them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Percept {
    /// Centre of the block, m.
    pub centre: DVec3,
    /// Orientation of the block.
    pub orientation: DQuat,
    /// Grip on the block; none where it is not held.
    pub grip: Option<HoldGrip>,
    /// Time for which the block has not moved under the full force of the hand, s.
    pub stuck_s: f64,
    /// Sum of the upward forces of what the block touches, N.
    pub upward: f64,
}

impl Percept {
    /// The block at this moment.
    pub fn now<S: Simulator>(game: &Game<S>, body: BodyId) -> Self {
        let hold = game.controller.hold().filter(|hold| hold.body == body);
        let contacts = game.world().contacts(body);
        Self {
            centre: game.blocks().position(body),
            orientation: game.blocks().orientation(body),
            grip: hold.map(|hold| hold.grip),
            stuck_s: hold.map_or(0.0, |hold| hold.stuck_s),
            upward: contacts.iter().map(|contact| contact.normal.z.max(0.0) * contact.force).sum(),
        }
    }
}

/// Percepts of the last moments.
#[derive(Debug, Clone, PartialEq)]
pub struct Senses {
    frames: usize,
    seen: VecDeque<Percept>,
}

impl Senses {
    /// Senses that are `lag` (s) late, at frames of `frame` (s).
    pub fn new(lag: f64, frame: f64) -> Self {
        Self { frames: (lag / frame).round().clamp(0.0, 600.0) as usize, seen: VecDeque::new() }
    }

    /// Takes in the present and returns the past that is noticed now.
    pub fn notice(&mut self, now: Percept) -> Percept {
        self.seen.push_back(now);
        while self.seen.len() > self.frames + 1 {
            self.seen.pop_front();
        }
        *self.seen.front().unwrap_or(&now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_senses_are_late_by_their_lag() {
        let at = |x: f64| Percept {
            centre: DVec3::X * x,
            orientation: DQuat::IDENTITY,
            grip: None,
            stuck_s: 0.0,
            upward: 0.0,
        };
        let mut senses = Senses::new(0.15, 1.0 / 60.0);
        let noticed: Vec<f64> = (0..30).map(|k| senses.notice(at(f64::from(k))).centre.x).collect();
        assert_eq!((noticed[8], noticed[9], noticed[29]), (0.0, 0.0, 20.0));
        assert_eq!(Senses::new(0.0, 1.0 / 60.0).notice(at(3.0)).centre.x, 3.0);
    }
}
