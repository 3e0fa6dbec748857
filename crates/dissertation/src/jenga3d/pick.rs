//! Selecting a block by a ray through a point of the screen (section 4.8.1), and the camera that the ray comes from.

use glam::DVec3;

use super::model::Model;
use super::particle::State;

/// A half line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it begins, m.
    pub origin: DVec3,
    /// Its direction, of any length.
    pub direction: DVec3,
}

/// A camera that goes round a point and always looks at it (section 6.2.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// What it looks at, m.
    pub target: DVec3,
    /// How far from there it is, m.
    pub distance: f64,
    /// Turn about the vertical, rad; 0 looks along -x.
    pub azimuth: f64,
    /// Height above the horizon, rad, less than a quarter turn either way.
    pub elevation: f64,
    /// Half the height of the picture at unit distance.
    pub half_height: f64,
}

impl Camera {
    /// Unit vector from what it looks at towards it.
    pub fn towards_viewer(&self) -> DVec3 {
        let level = libm::cos(self.elevation);
        DVec3::new(level * libm::cos(self.azimuth), level * libm::sin(self.azimuth), libm::sin(self.elevation))
    }

    /// Unit vectors to the right and up in the picture.
    pub fn right_and_up(&self) -> [DVec3; 2] {
        let right = DVec3::new(-libm::sin(self.azimuth), libm::cos(self.azimuth), 0.0);
        [right, self.towards_viewer().cross(right)]
    }

    /// Where it is, m.
    pub fn eye(&self) -> DVec3 {
        self.target + self.distance * self.towards_viewer()
    }

    /// The ray through a point of the picture; both coordinates in half heights of the picture from its middle, right and up.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let [right, up] = self.right_and_up();
        Ray { origin: self.eye(), direction: self.half_height * (x * right + y * up) - self.towards_viewer() }
    }

    /// Where a point is in the picture, as [`Camera::ray`] counts, and how far in front of the camera it is, m.
    pub fn project(&self, point: DVec3) -> DVec3 {
        let [right, up] = self.right_and_up();
        let from_eye = point - self.eye();
        let depth = -from_eye.dot(self.towards_viewer());
        let scale = depth * self.half_height;
        DVec3::new(from_eye.dot(right) / scale, from_eye.dot(up) / scale, depth)
    }
}

/// The block whose face the ray meets first, and how far along the ray, in lengths of its direction.
pub fn pick(model: &Model, states: &[State], ray: &Ray) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for face in &model.faces {
        let [p1, p2, p3] = face.corners().map(|p| states[p as usize].position);
        if let Some(t) = meets(ray, p1, p2, p3)
            && nearest.is_none_or(|(_, best)| t < best)
        {
            nearest = Some((model.particles[face.p1 as usize].block, t));
        }
    }
    nearest
}

/// Where a ray meets a triangle, in lengths of its direction; from both sides (Möller and Trumbore, 1997).
fn meets(ray: &Ray, p1: DVec3, p2: DVec3, p3: DVec3) -> Option<f64> {
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
