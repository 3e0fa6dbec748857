//! Physics engine of Teeter: a tower of blocks in which everything is a spring.
//!
//! A contact is a spring per area with a damper and a Maxwell element; friction is a tangential
//! spring that slips at Coulomb's cone (Cundall and Strack 1979). Time advances in many small
//! explicit steps, without an iterative solver and without a special case for rest. [`World::step`]
//! is one frame; `step.rs` is the table of contents.
//!
//! The crate has no input or output, no clock, no random numbers, no global state and no threads of
//! its own: with the feature `parallel`, bodies that cannot touch are stepped in rayon's current
//! thread pool. Units are SI; z is up, the floor is z = 0.
//!
//! ```
//! use teeter_physics::{Input, Params, World};
//!
//! let scene = teeter_scene::named("column").unwrap();
//! let mut world = World::new(&scene, Params::default())?;
//! let report = (0..60).map(|_| world.step(&Input::default())).last().unwrap();
//! assert!(report.rms_speed < 1e-3 && report.penetration < 1e-5);
//! # Ok::<(), teeter_physics::BuildError>(())
//! ```

mod actuator;
mod body;
mod body_id;
mod cluster;
mod collision;
mod constants;
mod derived;
mod input;
mod kernel;
mod lattice;
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
mod step;
mod step_io;
mod world;

pub use body_id::BodyId;
pub use constants::REFERENCE_AREA;
pub use input::{AppliedForce, Drive, Grip, Hand, Input};
pub use params::{Params, Precision, Width};
pub use pose::{POSE_STRIDE, Pose, Twist};
pub use report::{ContactReport, HandReport, LatticeReport, StepReport};
pub use restitution::restitution;
pub use snapshot::SnapshotError;
pub use world::{BuildError, World};
