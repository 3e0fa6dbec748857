//! Static friction, which the dissertation leaves for later (section 6.3).
//!
//! A contact here is a row of blows, so its friction is a part of each blow: across the normal it stops the contact point if static friction
//! allows (Eq. 2.17), and otherwise brakes it by kinetic friction (Eq. 2.18). What came aside in the step goes back in the same share, as
//! what came near does along the normal. There is no force between the blows, and no balance of forces to be found.

use glam::DVec3;

/// Coefficients of friction of a blow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// Static.
    pub at_rest: f64,
    /// Kinetic; no more than the static one counts.
    pub sliding: f64,
}

impl Coefficients {
    /// The impulse across the normal, N s, for a velocity across (m/s), of a blow of `along` (N s) on a point of that inverse mass (1/kg).
    /// The same law takes ways in place of velocities, and then gives a way times a mass.
    pub fn impulse(&self, across: DVec3, along: f64, inverse_mass: f64) -> DVec3 {
        let needed = -across / inverse_mass;
        let size = needed.length();
        if size <= self.at_rest * along {
            needed // Eq. 2.17
        } else {
            needed * (self.sliding.min(self.at_rest) * along / size) // Eq. 2.18
        }
    }
}
