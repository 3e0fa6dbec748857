#![doc = include_str!("../README.md")]

mod fit;
mod plane;
mod space;

pub use plane::Plane;
pub use space::{Space, SpaceGame};
