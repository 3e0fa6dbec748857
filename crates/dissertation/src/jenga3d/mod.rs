//! Jenga3D, the simulator of chapters 4 and 5: blocks are particles and springs, and nothing is
//! ever at rest but collides very often.

pub mod block;
mod bounds;
mod boxes;
mod changes;
mod collide;
mod constant;
pub mod constants;
pub mod contact;
pub mod counters;
mod create;
pub mod cubic;
mod disable;
pub mod edge_edge;
pub mod face;
mod field;
mod floor;
pub mod forces;
mod friction;
pub mod hand;
pub mod ini;
pub mod integrate;
pub mod model;
mod near;
pub mod options;
mod part_pair;
pub mod particle;
pub mod path;
pub mod pick;
pub mod point_face;
pub mod response;
pub mod simulator;
pub mod spring;
mod spring_lanes;
mod stability;
pub mod static_friction;
mod table;

pub use constant::{Constant, ConstantError, Range, Value};
pub use constants::Constants;
pub use hand::Hand;
pub use ini::IniError;
pub use options::{Culling, Disabling, HandMode, Method, Order, SpringSet};
pub use simulator::{BuildError, FrameReport, Jenga3D};
pub use table::TABLE;
