//! Analysis of moves: the chance that taking a block fells the tower, by rollouts.

pub mod breakdown;
pub mod calibration;
pub mod candidate;
pub mod collapse_cause;
pub mod estimate;
pub mod freedom;
pub mod holders;
pub mod move_log;
pub mod proportion;
pub mod prospect;
pub mod rollout;
pub mod survey;
pub mod tower;
