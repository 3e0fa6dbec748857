#![doc = include_str!("../README.md")]

pub mod flat;
pub mod jenga3d;
