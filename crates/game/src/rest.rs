//! Rest of a tower: no motion, no hand, and constant forces in the contacts.

use serde::{Deserialize, Serialize};
use teeter_study::SETTLED_SPEED;

use crate::stiffness_ramp::BlockForm;

/// Frames between two comparisons of the forces: a quarter of a second.
const INTERVAL: u32 = 15;
/// Difference of two forces at rest: so many newtons, or such a part of the force.
const MAX_CHANGE: f64 = 0.005;
const MAX_RELATIVE_CHANGE: f64 = 0.02;

/// Motion of a tower in a frame.
///
/// ```
/// use teeter_game::{BlockForm, Motion, RestDetector};
/// use teeter_scene::Form;
///
/// // a held block is no rest, however slow
/// let form = BlockForm { form: Form::Rigid, spring_stiffness: 1e6 };
/// let motion = Motion { max_speed: 0.0, held: true, form };
/// let mut detector = RestDetector::default();
/// for _ in 0..60 {
///     detector.advance(motion, || Some(vec![0.2]));
/// }
/// assert!(!detector.at_rest());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Speed of the fastest body, m/s.
    pub max_speed: f64,
    /// True when a hand holds a block.
    pub held: bool,
    /// Form of the blocks.
    pub form: BlockForm,
}

/// Detector of rest. A tower is at rest when its fastest body is slower than [`SETTLED_SPEED`] and
/// the forces in its contacts stay the same.
///
/// Low speed alone is not rest: gravity comes on over the first tenths of a second, and a block
/// that tips begins slowly.
///
/// ```
/// use teeter_game::{BlockForm, Motion, RestDetector};
/// use teeter_scene::Form;
///
/// let form = BlockForm { form: Form::Rigid, spring_stiffness: 1e6 };
/// let mut detector = RestDetector::default();
/// for _ in 0..45 {
///     detector.advance(Motion { max_speed: 0.0, held: false, form }, || Some(vec![0.2, 0.4]));
/// }
/// assert!(detector.at_rest());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RestDetector {
    at_rest: bool,
    frames: u32,
    /// Forces of the last comparison before rest began, N: creep must not go unseen.
    forces: Option<Vec<f64>>,
    form: Option<BlockForm>,
}

impl RestDetector {
    /// True when the tower is at rest.
    pub fn at_rest(&self) -> bool {
        self.at_rest
    }

    /// Advances by a frame; `forces` returns those in the contacts, N, or none where rest is not
    /// judged. Returns true if rest has begun or ended.
    pub fn advance(&mut self, motion: Motion, forces: impl FnOnce() -> Option<Vec<f64>>) -> bool {
        let before = self.at_rest;
        let same_form = self.form == Some(motion.form);
        self.form = Some(motion.form);
        let is_slow = motion.max_speed < SETTLED_SPEED;
        if !same_form || motion.held || !is_slow {
            (self.at_rest, self.frames, self.forces) = (false, 0, None);
        } else {
            self.frames = (self.frames + 1) % INTERVAL;
            if self.frames == 0 {
                let forces = forces();
                let pair = self.forces.as_ref().zip(forces.as_ref());
                self.at_rest = pair.is_some_and(|(before, now)| are_alike(before, now));
                if !before || !self.at_rest {
                    self.forces = forces;
                }
            }
        }
        self.at_rest != before
    }
}

/// Returns true if two lists hold the same forces; what is not a number must stay so.
fn are_alike(before: &[f64], now: &[f64]) -> bool {
    let alike = |(a, b): (&f64, &f64)| {
        (a.is_nan() && b.is_nan()) || (a - b).abs() <= MAX_CHANGE.max(MAX_RELATIVE_CHANGE * a.abs())
    };
    before.len() == now.len() && before.iter().zip(now).all(alike)
}

#[cfg(test)]
mod tests {
    use teeter_scene::Form;

    use super::*;

    const RIGID: BlockForm = BlockForm { form: Form::Rigid, spring_stiffness: 1e6 };
    const REST: Motion = Motion { max_speed: 1e-5, held: false, form: RIGID };

    /// Frames at which rest begins (positive) and ends (negative), for frames from 1 on.
    fn changes(frames: i32, motion: impl Fn(i32) -> Motion, forces: impl Fn(i32) -> Vec<f64>) -> Vec<i32> {
        let mut detector = RestDetector::default();
        let mut changes = Vec::new();
        for frame in 1..=frames {
            if detector.advance(motion(frame), || Some(forces(frame))) {
                changes.push(if detector.at_rest() { frame } else { -frame });
            }
        }
        changes
    }

    #[test]
    fn equal_forces_at_two_comparisons_are_rest_also_where_a_block_has_none() {
        let [begun] = changes(200, |_| REST, |_| vec![1.0, f64::NAN])[..] else { panic!("rest begins once") };
        assert!(begun <= 45);
    }

    #[test]
    fn a_tower_whose_load_grows_is_not_at_rest_however_slowly_it_moves() {
        let begun = changes(200, |_| REST, |frame| vec![f64::from(frame.min(100)) / 10.0])[0];
        assert!(begun > 100 && begun <= 145, "{begun}");
    }

    #[test]
    fn a_blow_a_hand_or_springs_end_rest_at_once_and_it_begins_again() {
        let springs = BlockForm { form: Form::Lattice, spring_stiffness: 1e6 };
        for change in [
            Motion { max_speed: 0.1, ..REST },
            Motion { held: true, ..REST },
            Motion { form: springs, ..REST },
            Motion { max_speed: f64::NAN, ..REST },
        ] {
            let seen = changes(200, |frame| if frame == 100 { change } else { REST }, |_| vec![1.0]);
            let [_, ended, begun] = seen[..] else { panic!("{change:?}: {seen:?}") };
            assert_eq!(ended, -100);
            assert!(begun > 115);
        }
    }

    #[test]
    fn forces_that_creep_are_seen() {
        assert!(changes(1000, |_| REST, |frame| vec![1.0 + f64::from(frame) * 1e-4]).len() > 3);
    }
}
