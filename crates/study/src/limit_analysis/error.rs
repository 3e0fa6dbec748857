//! Errors of limit analysis.

/// Error of limit analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum LimitError {
    /// No forces hold every block in equilibrium.
    #[error("rigid blocks do not rest like this: the tower falls")]
    NoEquilibrium,
    /// The solver gave up.
    #[error("the linear programme was not solved")]
    Unsolved,
}
