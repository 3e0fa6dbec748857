//! The renderer: casts rays through the pixels of a picture and colours what they meet.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use teeter_physics::Pose;
use teeter_scene::Scene;

use crate::bounds::Bounds;
use crate::camera::{Camera, View};
use crate::picture::{Picture, Size};
use crate::pixel::PixelGrid;
use crate::shading::light::Lights;
use crate::shading::occlusion::Occlusion;
use crate::shading::shadow::SunDisc;
use crate::shading::table::Table;
use crate::shading::wood::Log;
use crate::shape::Shape;
use crate::solids::{Solid, Solids};
use crate::stage::{Materials, Stage};
use crate::strained_pose::{StrainedPose, poses};

/// Distance from the first poses within which blocks darken their surroundings, m: far beyond the
/// blocks of a tower that falls.
const SURROUNDINGS: f32 = 2.0;
/// Distance of a scene from the origin up to which it is drawn there, m. Single precision has too
/// few digits for the grain of blocks that are farther away.
const NEAR: f64 = 8.0;

/// Draws the blocks of a scene.
///
/// ```
/// use teeter_render::{Renderer, Size, View, poses};
///
/// let scene = teeter_scene::named("tower").expect("a named scene");
/// let renderer = Renderer::new(&scene);
/// let size = Size { width: 64, height: 48 };
/// let camera = renderer.camera(&View::default(), &poses(&scene), size);
/// let picture = renderer.draw(&poses(&scene), &camera, size);
/// // Wood in the middle is redder than blue.
/// let [red, _, blue] = picture.pixel(32, 24);
/// assert!(red > blue + 30);
/// ```
#[derive(Debug)]
pub struct Renderer {
    shapes: Vec<Shape>,
    /// Origin of the coordinates in which the scene is drawn, m.
    origin: DVec3,
    materials: Materials,
    /// Bounds within which blocks darken their surroundings, m.
    limits: Bounds,
}

impl Renderer {
    /// Prepares the blocks of a scene.
    pub fn new(scene: &Scene) -> Self {
        let shape = |block: &teeter_scene::Block| {
            Shape::new(Vec3::from_array(block.size.map(|x| x as f32)), scene.edge_radius as f32)
        };
        let shapes: Vec<Shape> = scene.blocks.iter().map(shape).collect();
        let logs = (0..shapes.len() as u32).map(Log::new).collect();
        let lights = Lights::new();
        let poses = poses(scene);
        let middle = solids(&shapes, &poses, DVec3::ZERO).bounds().centre().as_dvec3();
        let far = middle.is_finite() && middle.abs().max_element() > NEAR;
        let origin = if far { middle.round().with_z(0.0) } else { DVec3::ZERO };
        let bounds = solids(&shapes, &poses, origin).bounds();
        Self {
            shapes,
            origin,
            materials: Materials { logs, lights, sun: SunDisc::new(lights.sun_direction), table: Table::new(bounds) },
            limits: bounds.grown(SURROUNDINGS),
        }
    }

    /// Returns the camera of a view of blocks in these poses.
    ///
    /// # Panics
    /// When there is not one pose a block.
    pub fn camera(&self, view: &View, poses: &[StrainedPose], size: Size) -> Camera {
        let solids = solids(&self.shapes, poses, DVec3::ZERO);
        let corners: Vec<Vec3> = solids.list().iter().flat_map(Solid::corners).collect();
        view.camera(&corners, size)
    }

    /// Draws the blocks in these poses, in rayon's current thread pool. The picture is the same in
    /// any number of threads.
    ///
    /// # Panics
    /// When there is not one pose a block.
    pub fn draw(&self, poses: &[StrainedPose], camera: &Camera, size: Size) -> Picture {
        let solids = solids(&self.shapes, poses, self.origin);
        let occlusion = Occlusion::new(&solids, self.limits);
        let stage = Stage { solids, occlusion };
        let grid = PixelGrid {
            materials: &self.materials,
            stage: &stage,
            lens: camera.lens(size).seen_from(self.origin),
            size,
        };
        let mut rgb = vec![0; 3 * size.width as usize * size.height as usize];
        rgb.par_chunks_exact_mut(3 * size.width as usize).enumerate().for_each_init(Vec::new, |groups, (y, row)| {
            for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
                pixel.copy_from_slice(&grid.colour(groups, x as u32, y as u32));
            }
        });
        Picture { size, rgb }
    }
}

/// Returns the blocks in these poses, relative to an origin.
fn solids(shapes: &[Shape], poses: &[StrainedPose], origin: DVec3) -> Solids {
    assert_eq!(shapes.len(), poses.len(), "there is one pose a block");
    let solid = |(&shape, strained): (&Shape, &StrainedPose)| {
        let pose = Pose { position: strained.pose.position - origin, ..strained.pose };
        Solid::new(shape, &StrainedPose { pose, ..*strained })
    };
    Solids::new(shapes.iter().zip(poses).map(solid).collect())
}
