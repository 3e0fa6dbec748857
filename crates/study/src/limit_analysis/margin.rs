//! Margin of a tower: by how much its edges of support may be wrong.

use teeter_scene::Scene;

use super::equilibrium::{equilibrium, require_upright};
use super::error::LimitError;
use super::frictional::falls;
use super::tower::RigidTower;

/// Largest margin, m: three quarters of the width of a nominal block.
const MAX_MARGIN: f64 = 0.02;
/// Bisections of a margin: 20 mm become 0.3 um.
const BISECTIONS: usize = 16;

impl RigidTower<'_> {
    /// Returns by how much every edge of support may be wrong before the answer of statics
    /// changes, m: positive for a tower that stands, negative for one that falls, 0.02 in amount at
    /// most.
    ///
    /// # Errors
    /// When a block is tilted or fixed in the air, or the solver gives up.
    ///
    /// ```
    /// # use teeter_study::RigidTower;
    /// let column = teeter_scene::named("column").unwrap();
    /// // the narrower edge of the base is 26.8 mm long
    /// assert!((RigidTower::margin(&column)? - 0.0134).abs() < 1e-6);
    /// assert!(RigidTower::margin(&teeter_scene::named("test-4").unwrap())? < 0.0);
    /// # Ok::<(), teeter_study::LimitError>(())
    /// ```
    pub fn margin(scene: &Scene) -> Result<f64, LimitError> {
        let sign = if stands(scene, 0.0)? { 1.0 } else { -1.0 };
        let (mut same, mut other) = (0.0, MAX_MARGIN);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (same + other);
            let is_same = stands(scene, sign * middle)? == (sign > 0.0);
            if is_same { same = middle } else { other = middle }
        }
        Ok(sign * 0.5 * (same + other))
    }

    /// Returns true if the tower falls whatever friction does, on edges of support moved inwards by
    /// `inset`, m. The equilibrium of [`RigidTower::stands`] needs no friction; between the two lie
    /// towers that only friction holds.
    ///
    /// # Errors
    /// When a block is tilted or fixed in the air, or the solver gives up.
    ///
    /// ```
    /// # use teeter_study::RigidTower;
    /// let falls = |name| RigidTower::falls_despite_friction(&teeter_scene::named(name).unwrap(), 0.0);
    /// assert_eq!((falls("column"), falls("test-4")), (Ok(false), Ok(true)));
    /// ```
    pub fn falls_despite_friction(scene: &Scene, inset: f64) -> Result<bool, LimitError> {
        require_upright(scene)?;
        falls(scene, inset)
    }
}

/// Returns true if the tower can rest on edges moved inwards by `inset`, m.
fn stands(scene: &Scene, inset: f64) -> Result<bool, LimitError> {
    match equilibrium(scene, inset) {
        Ok(_) => Ok(true),
        Err(LimitError::NoEquilibrium) => Ok(false),
        Err(error) => Err(error),
    }
}
