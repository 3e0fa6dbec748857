//! Constants of the springs of contacts.

/// Constants of the springs of all contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactSpring {
    /// Normal stiffness of a contact of [`REFERENCE_AREA`](crate::constants::REFERENCE_AREA), N/m.
    pub stiffness: f64,
    /// Damping ratio.
    pub zeta: f64,
    /// Substep, s.
    pub h: f64,
    /// Gravity of the scene, m/s².
    pub gravity: f64,
}
