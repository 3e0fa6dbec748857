//! Opponents: players that choose a move by trying it on copies of the tower, and carry it out by
//! commands with the hand that people have.

pub mod contest;
pub mod halving;
pub mod player;
pub mod strength;
pub mod thought;
