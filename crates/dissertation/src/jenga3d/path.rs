//! Straight paths of particles over a step (Eq. 4.8).

use glam::DVec3;

/// Straight path of a particle while t goes from 0 to 1 (Eq. 4.8).
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::path::Path;
///
/// let path = Path::between(DVec3::ZERO, 2.0 * DVec3::X);
/// assert_eq!(path.at(0.25), 0.5 * DVec3::X);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Path {
    /// Position at t = 0, m.
    pub start: DVec3,
    /// Displacement from t = 0 to 1, m (Eq. 4.8b).
    pub step: DVec3,
}

impl Path {
    /// Creates the path between two positions, m.
    #[inline]
    pub fn between(start: DVec3, end: DVec3) -> Self {
        Self { start, step: end - start } // Eq. 4.8b
    }

    /// Position at t, m.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.start + self.step * t // Eq. 4.8a
    }
}
