//! Pictures of worlds.

use glam::Vec3;
use pyo3::prelude::*;
use teeter_physics::World;
use teeter_render::{Picture, Renderer, Size, StrainedPose, View};

use crate::argument::{count, numbers, within};
use crate::error::{Kind, unexpected};
use crate::pool::detached;

/// Largest width and height, px.
const MAX_SIDE: u64 = 4096;
/// Width and height where none is given, px.
const DEFAULT_SIZE: Size = Size { width: 640, height: 480 };
/// Largest distance of camera and target, m.
const MAX_DISTANCE: f64 = 1e4;

type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// Reads the size of a picture.
pub fn size(width: Given<'_, '_>, height: Given<'_, '_>) -> PyResult<Size> {
    let side = |field, given: Given<'_, '_>, default: u32| {
        given.map_or(Ok::<u32, PyErr>(default), |given| Ok(count(field, given, 1..=MAX_SIDE)? as u32))
    };
    Ok(Size { width: side("width", width, DEFAULT_SIZE.width)?, height: side("height", height, DEFAULT_SIZE.height)? })
}

/// Reads the parts of a view that are chosen.
pub fn view(
    azimuth: Given<'_, '_>,
    elevation: Given<'_, '_>,
    distance: Given<'_, '_>,
    target: Given<'_, '_>,
) -> PyResult<View> {
    let chosen = |field, given: Given<'_, '_>, min, max| {
        given.map(|given| Ok::<f32, PyErr>(within(field, given, min..=max)? as f32)).transpose()
    };
    let target = target.map(|target| numbers::<3>("target", target)).transpose()?;
    if target.is_some_and(|target| target.iter().any(|x| x.abs() > MAX_DISTANCE)) {
        return Err(unexpected(Kind::Input, "target", "too far away", format_args!("at most {MAX_DISTANCE} m")));
    }
    Ok(View {
        azimuth: chosen("azimuth", azimuth, -100.0, 100.0)?,
        elevation: chosen("elevation", elevation, -1.57, 1.57)?,
        distance: chosen("distance", distance, 0.001, MAX_DISTANCE)?,
        target: target.map(|target| Vec3::from_array(target.map(|x| x as f32))),
    })
}

/// Draws the present state of a world, without Python's lock.
pub fn draw(py: Python<'_>, world: &World, size: Size, view: &View) -> PyResult<Picture> {
    detached(py, || {
        let renderer = Renderer::new(world.scene());
        let poses: Vec<StrainedPose> = world.bodies().map(|body| StrainedPose::of(world, body)).collect();
        renderer.draw(&poses, &renderer.camera(view, &poses, size), size)
    })
}
