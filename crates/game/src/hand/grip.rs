//! Grips of the hand.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_physics::Grip;

/// Grip that the player asks for.
///
/// ```
/// use teeter_game::GripMode;
///
/// assert_eq!(serde_json::from_str::<GripMode>(r#""auto""#).unwrap(), GripMode::Auto);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GripMode {
    /// Slide in the tower, carry beside it, changed as the block comes out or goes back in.
    Auto,
    /// Always slide.
    Slide,
    /// Always carry.
    Carry,
    /// Fingertip that pushes along the inward normal.
    Push,
}

/// Present grip.
///
/// ```
/// use teeter_game::HoldGrip;
///
/// assert_eq!(serde_json::to_string(&HoldGrip::Carry)?, r#""carry""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HoldGrip {
    /// Fingers on a block in the tower.
    Slide,
    /// A block in the air.
    Carry,
    /// Fingertip.
    Push,
}

impl HoldGrip {
    /// The grip of the physics; `axis` is the direction of a push, unit vector in the world.
    pub(crate) fn to_physics(self, axis: DVec3) -> Grip {
        match self {
            HoldGrip::Slide => Grip::Slide,
            HoldGrip::Carry => Grip::Carry,
            HoldGrip::Push => Grip::Push { axis },
        }
    }
}
