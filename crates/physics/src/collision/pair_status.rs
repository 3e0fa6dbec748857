//! Result of testing a pair.

/// Separations that decide what a test of a pair finds, m.
#[derive(Debug, Clone, Copy)]
pub struct Range {
    /// Separation from which the pair is apart.
    pub limit: f64,
    /// Separation up to which it may have a manifold.
    pub reach: f64,
}

/// Result of testing a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PairStatus {
    /// Separated by more than the limit.
    Apart,
    /// Near, without a manifold: beyond the reach, or with no part of one box in front of a face of
    /// the other, so that they may yet touch with their edges. The pair is tested again before the
    /// bodies have travelled by this much against each other, m.
    Near(f64),
    /// Within reach: the pair has a manifold, which holds until the bodies have travelled by this
    /// much against each other, m; infinite where the reach alone decides.
    Touching(f64),
}
