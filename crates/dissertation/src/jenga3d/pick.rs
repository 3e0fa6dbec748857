//! Selection of a block by a ray through a point of the screen (section 4.8.1), and the camera of
//! the ray.

use glam::DVec3;

use super::model::Model;
use super::particle::State;

/// Ray.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::pick::{Ray, pick};
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("column").expect("the list has it");
/// let column = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// let down = Ray { origin: DVec3::new(0.01, 0.0, 1.0), direction: -DVec3::Z };
/// let (block, _) = pick(&column.model, &column.curr, &down).expect("a block below");
/// assert_eq!(block, 9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Origin, m.
    pub origin: DVec3,
    /// Direction, of any length.
    pub direction: DVec3,
}

/// Camera that orbits a target (section 6.2.1).
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::pick::Camera;
///
/// let camera = Camera { target: DVec3::ZERO, distance: 2.0, azimuth: 0.0, elevation: 0.0, half_height: 0.5 };
/// assert_eq!(camera.eye(), 2.0 * DVec3::X);
/// let point = DVec3::new(0.0, 0.3, 0.2);
/// let on_screen = camera.project(point);
/// let ray = camera.ray(on_screen.x, on_screen.y);
/// assert!((ray.origin + on_screen.z * ray.direction).distance(point) < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Target, m.
    pub target: DVec3,
    /// Distance from the target, m.
    pub distance: f64,
    /// Rotation about the vertical, rad; at 0 the view is along -x.
    pub azimuth: f64,
    /// Elevation above the horizon, rad, between -π/2 and π/2.
    pub elevation: f64,
    /// Half the height of the picture at unit distance, m.
    pub half_height: f64,
}

impl Camera {
    /// Unit vector from the target to the camera.
    pub fn towards_viewer(&self) -> DVec3 {
        let level = libm::cos(self.elevation);
        DVec3::new(level * libm::cos(self.azimuth), level * libm::sin(self.azimuth), libm::sin(self.elevation))
    }

    /// Unit vectors to the right and upwards in the picture.
    pub fn right_and_up(&self) -> [DVec3; 2] {
        let right = DVec3::new(-libm::sin(self.azimuth), libm::cos(self.azimuth), 0.0);
        [right, self.towards_viewer().cross(right)]
    }

    /// Position of the camera, m.
    pub fn eye(&self) -> DVec3 {
        self.target + self.distance * self.towards_viewer()
    }

    /// Ray through a point of the picture. Coordinates are in half heights from its centre, to the
    /// right and upwards.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let [right, up] = self.right_and_up();
        Ray { origin: self.eye(), direction: self.half_height * (x * right + y * up) - self.towards_viewer() }
    }

    /// Position of a point in the picture, in the coordinates of [`Camera::ray`], and its distance
    /// in front of the camera, m.
    pub fn project(&self, point: DVec3) -> DVec3 {
        let [right, up] = self.right_and_up();
        let from_eye = point - self.eye();
        let depth = -from_eye.dot(self.towards_viewer());
        let scale = depth * self.half_height;
        DVec3::new(from_eye.dot(right) / scale, from_eye.dot(up) / scale, depth)
    }
}

/// Returns the index of the first block on a ray, and its distance in lengths of the direction.
pub fn pick(model: &Model, states: &[State], ray: &Ray) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for face in &model.faces {
        let [p1, p2, p3] = face.corners().map(|p| states[p as usize].position);
        if let Some(t) = ray_triangle(ray, [p1, p2, p3])
            && nearest.is_none_or(|(_, best)| t < best)
        {
            nearest = Some((model.particles[face.p1 as usize].block, t));
        }
    }
    nearest
}

/// Intersection of a ray with a triangle from either side, in lengths of the direction (Möller and
/// Trumbore, 1997).
fn ray_triangle(ray: &Ray, [p1, p2, p3]: [DVec3; 3]) -> Option<f64> {
    let (a, b, from) = (p2 - p1, p3 - p1, ray.origin - p1);
    let across = ray.direction.cross(b);
    let volume = a.dot(across);
    if volume == 0.0 {
        return None;
    }
    let u = from.dot(across) / volume;
    let turned = from.cross(a);
    let v = ray.direction.dot(turned) / volume;
    let t = b.dot(turned) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
}
