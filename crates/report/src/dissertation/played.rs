//! Results of the twelve moves.

use maud::Markup;
use teeter_dissertation::jenga3d::counters::Rounds;

/// Result of a move.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Maximum displacement of a block of the tower, m.
    pub max_displacement: f64,
    /// Mean displacement of the blocks of the tower, m.
    pub mean_displacement: f64,
    /// Distance of the moved block from its target at the end, m: of one taken from the hand, of
    /// one put from its position, level.
    pub error: f64,
    /// True while all blocks have stayed in their rows since the first move.
    ///
    /// A block leaves its row when its centre comes down below the lower face of the row. The
    /// footing of `teeter_study` is too narrow here: blocks of the dissertation's method sink into
    /// each other under load.
    pub stands: bool,
}

/// Twelve moves in a column, until the tower falls.
#[derive(Debug, Clone)]
pub struct Played {
    /// Outcomes of the moves.
    pub outcomes: Vec<Outcome>,
    /// Pictures after the moves.
    pub pictures: Vec<Markup>,
    /// Maximum depth of a block in another after any of the moves, m.
    pub max_depth: f64,
    /// Rounds over the pairs.
    pub rounds: Rounds,
    /// Number of frames.
    pub frames: u64,
}
