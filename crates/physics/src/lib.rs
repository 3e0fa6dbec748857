//! The engine of Teeter: a tower of blocks in which everything is a spring.
//!
//! Contact is a spring per area with a damper and a Maxwell element, friction is a tangential spring that gives way at Coulomb's
//! cone (Cundall and Strack 1979), and time goes in many small explicit steps. There is no iterative solver and no resting case.
//! [`World::step`] is the whole of it; `step.rs` is its table of contents.
//!
//! No input or output, no clock, no random numbers, no global state, no thread of its own: with the feature `parallel`, bodies that
//! cannot meet are stepped side by side in rayon's current pool. SI units; z is up, the floor is z = 0.
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

mod acts;
mod batch;
mod body;
mod body_id;
mod box_box;
mod broad_phase;
mod cluster;
mod constants;
mod contacts;
mod drive;
mod form;
mod frame;
mod hand;
mod input;
mod island;
mod kernel;
mod lattice;
mod manifold;
mod moved;
mod pack;
mod params;
mod polygon;
mod pose;
mod regroup;
mod report;
mod rest;
mod restitution;
mod rigid;
mod setup;
#[cfg_attr(
    all(target_arch = "wasm32", target_feature = "simd128"),
    allow(dead_code, reason = "the portable lanes are then only a reference")
)]
mod simd;
mod snapshot;
mod step;
mod step_io;
mod sync;
mod ways;
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
