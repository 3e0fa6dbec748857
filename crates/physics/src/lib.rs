#![doc = include_str!("../README.md")]

mod actuator;
mod body;
mod body_id;
mod bounded;
mod build_error;
mod cluster;
mod collision;
mod constants;
mod contact_spring;
mod derived;
mod energy;
mod energy_balance;
#[doc(hidden)]
pub mod envelope;
mod input;
mod kernel;
mod lattice;
mod overload;
mod params;
mod pose;
mod report;
mod restitution;
#[cfg_attr(
    all(target_arch = "wasm32", target_feature = "simd128"),
    allow(dead_code, reason = "the portable registers are then only a reference")
)]
mod simd;
mod snapshot;
mod start;
mod step;
mod step_io;
mod valid_state;
mod warning;
mod world;

pub use body_id::BodyId;
#[doc(hidden)]
pub use bounded::numbers_within;
pub use build_error::BuildError;
pub use constants::REFERENCE_AREA;
pub use energy::Energy;
pub use energy_balance::EnergyBalance;
pub use input::{AppliedForce, Drive, Grip, Hand, Input};
pub use params::{Params, Precision, Width};
pub use pose::{POSE_STRIDE, Pose, Twist};
pub use report::{ContactReport, HandReport, LatticeReport, StepReport};
pub use restitution::restitution;
pub use snapshot::SnapshotError;
pub use warning::Warning;
pub use world::World;
