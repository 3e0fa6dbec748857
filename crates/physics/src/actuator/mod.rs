//! Actuators: the player's hand, drives and applied forces.

pub mod cluster_input;
pub mod drive;
pub mod hand;
pub mod limits;
pub mod work;
