//! Static friction, which the dissertation leaves for later (section 6.3).
//!
//! A contact is a sequence of collisions, so friction is a part of each impulse. Tangentially it
//! stops the contact point if static friction suffices (Eq. 2.17), and otherwise slows it by
//! kinetic friction (Eq. 2.18). The tangential displacement of the step is reduced in the same
//! ratio, as the normal one is.

use glam::DVec3;

/// Coefficients of friction of a collision.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::static_friction::Coefficients;
///
/// let friction = Coefficients { static_friction: 0.5, kinetic_friction: 0.25 };
/// assert_eq!(friction.impulse(DVec3::X, 4.0, 1.0), -DVec3::X); // sticks
/// assert_eq!(friction.impulse(4.0 * DVec3::X, 4.0, 1.0), -DVec3::X); // slips
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// Coefficient of static friction.
    pub static_friction: f64,
    /// Coefficient of kinetic friction, limited by the static one.
    pub kinetic_friction: f64,
}

impl Coefficients {
    /// Tangential impulse, N s, for the tangential velocity `across` (m/s) and the normal impulse
    /// `along` (N s) at a contact point of this inverse mass (1/kg). Displacements (m) in place of
    /// velocities give displacements times a mass, kg m.
    pub fn impulse(&self, across: DVec3, along: f64, inverse_mass: f64) -> DVec3 {
        let needed = -across / inverse_mass;
        let size = needed.length();
        if size <= self.static_friction * along {
            needed // Eq. 2.17
        } else {
            needed * (self.kinetic_friction.min(self.static_friction) * along / size) // Eq. 2.18
        }
    }
}
