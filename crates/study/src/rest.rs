//! Definition of rest: the speeds and the time by which a study calls a tower or a pile at rest.

/// Speed of the fastest block below which a tower is at rest after [`REST_TIME`], m/s. In that time
/// a block moves by 25 µm at most, a quarter of the default scatter of heights.
pub const REST_SPEED: f64 = 1e-4;

/// Time below [`REST_SPEED`] that makes rest, s. A block that rocks has no speed at each end of its
/// swing, but not for so long.
pub const REST_TIME: f64 = 0.25;

/// Speed of the fastest block below which a collapsed pile is quiet, m/s. Blocks of a pile stand on
/// edges and corners and roll slowly for seconds; a pile that contacts drive apart is faster.
pub const PILE_SPEED: f64 = 5e-3;

/// Speed of the fastest block below which a tower in play has settled where the forces in its
/// contacts stay constant besides, m/s. Soft blocks sway for seconds above [`REST_SPEED`], with
/// forces that no longer change.
pub const SETTLED_SPEED: f64 = 1e-3;

/// Speed above which a block moves visibly, m/s.
pub const VISIBLE_SPEED: f64 = 4e-3;

/// Timer of rest.
///
/// ```
/// use teeter_study::{REST_SPEED, RestTimer};
///
/// let mut timer = RestTimer::default();
/// assert!(!timer.advance(0.2, 0.5 * REST_SPEED));
/// assert!(!timer.advance(0.2, 2.0 * REST_SPEED));
/// assert!(!timer.advance(0.2, 0.5 * REST_SPEED));
/// assert!(timer.advance(0.2, 0.5 * REST_SPEED));
/// assert_eq!(timer.elapsed(), 0.4);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RestTimer {
    elapsed: f64,
}

impl RestTimer {
    /// Advances by `seconds` in which the fastest block had `max_speed` (m/s); returns true if the
    /// tower is at rest. A speed that is not a number counts as motion.
    pub fn advance(&mut self, seconds: f64, max_speed: f64) -> bool {
        self.elapsed = if max_speed < REST_SPEED { self.elapsed + seconds } else { 0.0 };
        self.elapsed >= REST_TIME
    }

    /// Time since the last motion, s.
    pub fn elapsed(&self) -> f64 {
        self.elapsed
    }
}
