//! Jenga3D, the simulator of chapters 4 and 5: blocks are particles and springs, and nothing is ever at rest but collides very often.

pub mod block;
pub mod bounds;
pub mod boxes;
pub mod collide;
pub mod constants;
pub mod contact;
pub mod counters;
pub mod cubic;
pub mod disable;
pub mod edge_edge;
pub mod face;
pub mod floor;
pub mod forces;
pub mod friction;
pub mod hand;
pub mod ini;
pub mod integrate;
pub mod model;
pub mod particle;
pub mod pick;
pub mod point_face;
pub mod response;
pub mod simulator;
pub mod spring;
pub mod static_friction;

pub use collide::{Culling, Order};
pub use constants::Constants;
pub use disable::Disabling;
pub use hand::{Hand, HandMode};
pub use ini::IniError;
pub use integrate::Method;
pub use simulator::{BuildError, FrameReport, Jenga3D};
