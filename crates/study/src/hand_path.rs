//! Path of a hand: straight lines, and pauses between them.

use glam::DVec3;
use teeter_physics::{Grip, Hand};

/// Path of a hand's target, sampled at the end of each frame.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_physics::{BodyId, Grip, Hand};
/// use teeter_study::HandPath;
///
/// let hand = Hand::slide(BodyId(4), DVec3::ZERO, DVec3::ZERO, DQuat::IDENTITY);
/// // 2 cm outwards in half a second, then 3 cm upwards in a tenth of a second
/// let path = HandPath::new(hand, 1.0 / 60.0)
///     .line(DVec3::new(0.02, 0.0, 0.0), 0.04)
///     .with_grip(Grip::Carry)
///     .line(DVec3::new(0.02, 0.0, 0.03), 0.3);
/// let hands: Vec<Hand> = path.into_iter().collect();
/// assert_eq!((hands.len(), hands[14].target.x), (36, 0.01));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HandPath {
    /// Hand at the end of the path.
    end: Hand,
    /// Time that a frame covers, s.
    frame: f64,
    /// Hand in each frame.
    hands: Vec<Hand>,
}

impl HandPath {
    /// Creates a path that starts at the target of `hand`. A frame covers `frame` seconds.
    pub fn new(hand: Hand, frame: f64) -> Self {
        Self { end: hand, frame, hands: Vec::new() }
    }

    /// Sets the grip from here on.
    pub fn with_grip(mut self, grip: Grip) -> Self {
        self.end.grip = grip;
        self
    }

    /// Appends a line to `target` (m) at `speed` (m/s), in a time rounded up to whole frames.
    pub fn line(self, target: DVec3, speed: f64) -> Self {
        let frames = (target.distance(self.end.target) / speed / self.frame).ceil().max(1.0);
        self.straight(target, frames)
    }

    /// Appends a line to `target` (m) in `seconds`, rounded to whole frames.
    pub fn line_in(self, target: DVec3, seconds: f64) -> Self {
        let frames = self.frames(seconds);
        self.straight(target, frames)
    }

    /// Appends a line of `length` (m) along `axis` (unit vector) at `speed` (m/s), in a time
    /// rounded to whole frames.
    pub fn line_along(self, axis: DVec3, length: f64, speed: f64) -> Self {
        let (from, frames) = (self.end.target, self.frames(length / speed));
        self.extend(from + axis * length, frames, |frame| from + axis * (length * frame / frames))
    }

    /// Appends a pause of `seconds`, rounded to whole frames.
    pub fn pause(self, seconds: f64) -> Self {
        let (target, frames) = (self.end.target, self.frames(seconds));
        self.extend(target, frames, |_| target)
    }

    fn straight(self, target: DVec3, frames: f64) -> Self {
        let from = self.end.target;
        self.extend(target, frames, |frame| from.lerp(target, frame / frames))
    }

    /// Appends frames, counted from 1; the path then ends at `end` exactly.
    fn extend(mut self, end: DVec3, frames: f64, target: impl Fn(f64) -> DVec3) -> Self {
        let hand = |frame| Hand { target: target(f64::from(frame)), ..self.end.clone() };
        self.hands.extend((1..=frames as u32).map(hand));
        self.end.target = end;
        self
    }

    /// Number of frames that cover `seconds`, at least 1.
    fn frames(&self, seconds: f64) -> f64 {
        (seconds / self.frame).round().max(1.0)
    }
}

/// The hand in each frame.
impl IntoIterator for HandPath {
    type Item = Hand;
    type IntoIter = std::vec::IntoIter<Hand>;

    fn into_iter(self) -> Self::IntoIter {
        self.hands.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use teeter_physics::BodyId;

    use super::*;

    const FRAME: f64 = 0.1;

    fn path() -> HandPath {
        HandPath::new(Hand::slide(BodyId(1), DVec3::Y, DVec3::X, DQuat::IDENTITY), FRAME)
    }

    fn targets(path: HandPath) -> Vec<DVec3> {
        path.into_iter().map(|hand| hand.target).collect()
    }

    #[test]
    fn a_line_ends_at_its_target_and_is_no_faster_than_its_speed() {
        let targets = targets(path().line(DVec3::X * 2.0, 3.0));
        assert_eq!(targets.len(), 4);
        assert_eq!(targets[3], DVec3::X * 2.0);
        assert!(targets.windows(2).all(|pair| pair[1].distance(pair[0]) <= 3.0 * FRAME));
    }

    #[test]
    fn lines_and_pauses_follow_each_other() {
        let targets = targets(path().line_along(DVec3::Z, 0.2, 1.0).pause(0.2).line_in(DVec3::ZERO, 0.1));
        let [first, out, held, still, end] = targets[..] else { panic!("five frames: {targets:?}") };
        assert_eq!([first, out], [DVec3::new(1.0, 0.0, 0.1), DVec3::new(1.0, 0.0, 0.2)]);
        assert_eq!([held, still, end], [out, out, DVec3::ZERO]);
    }

    #[test]
    fn a_grip_holds_from_where_it_is_set() {
        let path = path().pause(0.1).with_grip(Grip::Carry).pause(0.1);
        let grips: Vec<Grip> = path.into_iter().map(|hand| hand.grip).collect();
        assert_eq!(grips, [Grip::Slide, Grip::Carry]);
    }
}
