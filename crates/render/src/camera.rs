//! The camera: orbits a point, as on the page.

use glam::{DVec3, Vec3};

use crate::picture::Size;
use crate::ray::Ray;

/// Vertical field of view, rad.
const FIELD_OF_VIEW: f32 = 34.0 * core::f32::consts::PI / 180.0;
/// Direction of the default view, rad: a corner, so that ends and sides are visible.
const AZIMUTH: f32 = -0.95;
const ELEVATION: f32 = 0.36;
/// Minimum height of the camera above the table, m.
const MIN_HEIGHT: f32 = 0.012;
/// Minimum height of the default target, m.
const MIN_TARGET: f32 = 0.01;
/// Fraction of the picture's half width and height within which the blocks are framed.
const FRAME: f32 = 0.94;

/// Direction from which a picture is taken, and the point in its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Angle about the vertical from x to the camera, rad.
    pub azimuth: f32,
    /// Angle of the camera above the horizontal, rad.
    pub elevation: f32,
    /// Distance from the target, m.
    pub distance: f32,
    /// Point in the centre of the picture, m.
    pub target: Vec3,
}

/// Parts of a view that are chosen; the others frame all blocks.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct View {
    /// Angle about the vertical from x to the camera, rad.
    pub azimuth: Option<f32>,
    /// Angle of the camera above the horizontal, rad.
    pub elevation: Option<f32>,
    /// Distance from the target, m.
    pub distance: Option<f32>,
    /// Point in the centre of the picture, m.
    pub target: Option<Vec3>,
}

impl View {
    /// Returns the camera of this view for blocks with these corners, m, in a picture of this size.
    ///
    /// It frames a tower as the page does, with room for a row above it, and other scenes so that
    /// all corners are in the picture.
    pub fn camera(&self, corners: &[Vec3], size: Size) -> Camera {
        let (min, max) = corners
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &corner| (min.min(corner), max.max(corner)));
        let top = if corners.is_empty() { 0.0 } else { max.z.max(0.0) };
        let centre = if corners.is_empty() { Vec3::ZERO } else { 0.5 * (min + max) };
        let middle = Vec3::new(centre.x, centre.y, (top / 2.0 + 0.005).max(MIN_TARGET));
        let mut camera = Camera {
            azimuth: self.azimuth.unwrap_or(AZIMUTH),
            elevation: self.elevation.unwrap_or(ELEVATION),
            distance: 0.0,
            target: self.target.unwrap_or(middle),
        };
        camera.distance = self.distance.unwrap_or_else(|| camera.framing(corners, top, size));
        camera
    }
}

impl Camera {
    /// Distance from which all corners are in the picture.
    fn framing(&self, corners: &[Vec3], top: f32, size: Size) -> f32 {
        let slope = libm::tanf(FIELD_OF_VIEW / 2.0);
        let aspect = size.width as f32 / size.height as f32;
        // Room for a new row and for the hand above it, and for the panel beside it.
        let (tall, wide) = (top + 0.12, 0.26);
        let page = tall.max(wide / aspect) / (2.0 * slope) * 1.12 + 0.06;
        let [forward, right, up] = self.axes_along(-self.outward());
        let needed = corners.iter().map(|&corner| {
            let p = corner - self.target;
            let (x, y) = (p.dot(right).abs() / aspect, p.dot(up).abs());
            x.max(y) / (FRAME * slope) - p.dot(forward)
        });
        needed.fold(page, f32::max)
    }

    /// Unit vector from the target to the camera.
    fn outward(&self) -> Vec3 {
        let (sin, cos) = libm::sincosf(self.elevation);
        let (east, north) = (libm::cosf(self.azimuth), libm::sinf(self.azimuth));
        Vec3::new(cos * east, cos * north, sin)
    }

    /// Position, m; never below the table.
    pub fn position(&self) -> Vec3 {
        let position = self.target + self.distance * self.outward();
        position.with_z(position.z.max(MIN_HEIGHT))
    }

    /// Unit vectors forward, to the right and up in the picture.
    fn axes(&self) -> [Vec3; 3] {
        self.axes_along((self.target - self.position()).try_normalize().unwrap_or(-self.outward()))
    }

    fn axes_along(&self, forward: Vec3) -> [Vec3; 3] {
        let right = Vec3::new(-libm::sinf(self.azimuth), libm::cosf(self.azimuth), 0.0);
        [forward, right, right.cross(forward)]
    }

    /// Returns the lens for a picture of a size.
    pub fn lens(&self, size: Size) -> Lens {
        let [forward, right, up] = self.axes();
        let pixel = 2.0 * libm::tanf(FIELD_OF_VIEW / 2.0) / size.height as f32;
        let corner = forward - 0.5 * pixel * (size.width as f32 * right - size.height as f32 * up);
        Lens { position: self.position(), corner, right: pixel * right, down: -pixel * up }
    }
}

/// Camera of a picture: maps pixels to rays.
#[derive(Debug, Clone, Copy)]
pub struct Lens {
    /// Position, m.
    pub position: Vec3,
    /// Direction through the upper left corner of the picture.
    corner: Vec3,
    /// Change of the direction from a pixel to the next one.
    right: Vec3,
    down: Vec3,
}

impl Lens {
    /// Returns the lens in coordinates with another origin, m.
    pub(crate) fn seen_from(self, origin: DVec3) -> Self {
        Self { position: (self.position.as_dvec3() - origin).as_vec3(), ..self }
    }

    /// Returns the ray through a point of the picture, px from the upper left corner.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        Ray { origin: self.position, direction: (self.corner + x * self.right + y * self.down).normalize() }
    }

    /// Returns the point of the picture at which a point of the world appears, px from the upper
    /// left corner; none behind the camera.
    pub fn project(&self, point: Vec3) -> Option<(f32, f32)> {
        let p = point - self.position;
        // The three directions form a basis: p is in proportion to corner + x right + y down.
        let normal = self.right.cross(self.down);
        let depth = p.dot(normal) / self.corner.dot(normal);
        let q = p / depth - self.corner;
        let (x, y) = (q.dot(self.right), q.dot(self.down));
        (depth > 0.0).then(|| (x / self.right.length_squared(), y / self.down.length_squared()))
    }
}
