#![doc = include_str!("../README.md")]

pub use glam::{DQuat, DVec3};
pub use teeter_game as game;
pub use teeter_game::{Command, Game, Update};
pub use teeter_physics::{
    AppliedForce, BodyId, BuildError, ContactReport, Drive, Grip, Hand, HandReport, Input, LatticeReport, POSE_STRIDE,
    Params, Pose, Precision, REFERENCE_AREA, SnapshotError, StepReport, Twist, Width, World, restitution,
};
pub use teeter_scene as scene;
pub use teeter_scene::{Block, Form, Scene, SceneError, TowerOptions};
pub use teeter_study as study;

/// Tests the examples of the repository's front page and of the documents.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../../README.md")]
    struct FrontPage;
    #[doc = include_str!("../../../docs/opponents.md")]
    struct Opponents;
    #[doc = include_str!("../../../docs/python.md")]
    struct Python;
    #[doc = include_str!("../../../docs/tutorial.md")]
    struct Tutorial;
    #[doc = include_str!("../../../python/docs/index.md")]
    struct Manual;
}
