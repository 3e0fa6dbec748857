#![doc = include_str!("../README.md")]

mod bounds;
mod bvh;
mod camera;
mod file;
mod picture;
mod pixel;
mod ray;
mod renderer;
mod shading;
mod shape;
mod solids;
mod stage;
mod strained_pose;

pub use camera::{Camera, Lens, View};
pub use file::{Film, FilmError, Format, GIF_FPS, MP4_SIDES};
pub use picture::{MAX_SIDE, Picture, Size};
pub use renderer::Renderer;
pub use strained_pose::{StrainedPose, poses};
