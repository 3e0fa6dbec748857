//! The hand: from commands to the force that the simulator applies. It moves no block itself; it
//! sets a target.

pub mod clearance;
pub mod controller;
pub mod grip;
pub mod hold;
pub mod limiter;
pub mod placement_path;
