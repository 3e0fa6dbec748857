//! Errors of limit analysis.

/// Error of limit analysis.
///
/// ```
/// # use teeter_study::{LimitError, RigidTower};
/// let scene = teeter_scene::named("test-4").unwrap();
/// let error = RigidTower::new(&scene).unwrap_err();
/// assert_eq!(error, LimitError::NoEquilibrium);
/// assert_eq!(error.to_string(), "rigid blocks do not rest like this: the tower falls");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum LimitError {
    /// A block is tilted, or fixed in the air; the analysis is of upright blocks on a floor.
    #[error("block {id} is {state}: limit analysis is of upright blocks on a floor")]
    Unsuitable {
        /// Id of the block.
        id: u32,
        /// `tilted` or `fixed above the floor`.
        state: &'static str,
    },
    /// No forces hold every block in equilibrium.
    #[error("rigid blocks do not rest like this: the tower falls")]
    NoEquilibrium,
    /// The solver gave up.
    #[error("the linear programme was not solved")]
    Unsolved,
}
