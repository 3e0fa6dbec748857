//! Analysis of moves: the chance that taking a block fells the tower, by rollouts.

pub mod candidate;
pub mod estimate;
pub mod freedom;
pub mod holders;
pub mod proportion;
pub mod rollout;
pub mod survey;
pub mod tower;
