//! Result of testing a pair.

/// Result of testing a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PairStatus {
    /// Separated by more than the limit.
    Apart,
    /// Near, with no part of one box in front of a face of the other: they may yet touch with their
    /// edges. The pair is tested again before either body has travelled by this much, m.
    Near(f64),
    /// Within the limit: the pair has a manifold, which holds until either body has travelled by
    /// this much, m; infinite where the margins alone decide.
    Touching(f64),
}
