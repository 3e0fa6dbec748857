//! Blocks in their poses, as the rays meet them.

use glam::{IVec3, Mat3, Vec3};

use crate::bounds::Bounds;
use crate::bvh::Bvh;
use crate::ray::Ray;
use crate::shape::Shape;
use crate::strained_pose::StrainedPose;

/// Block in its pose.
#[derive(Debug, Clone, Copy)]
pub struct Solid {
    shape: Shape,
    /// Centre, m.
    centre: Vec3,
    /// Map of directions of the block's frame to the world, and its inverse.
    axes: Mat3,
    inverse: Mat3,
}

/// Point at which a ray enters a block.
#[derive(Debug, Clone, Copy)]
pub struct Hit {
    /// Index of the block.
    pub block: u32,
    /// Distance along the ray.
    pub distance: f32,
    /// Outward unit normal.
    pub normal: Vec3,
    /// Normal in the block's frame, of unit length.
    pub local_normal: Vec3,
    /// Part of the block's surface.
    pub part: IVec3,
}

impl Solid {
    /// Returns a block in a pose.
    pub fn new(shape: Shape, pose: &StrainedPose) -> Self {
        let axes = pose.axes();
        Self { shape, centre: pose.pose.position.as_vec3(), axes: axes.as_mat3(), inverse: axes.inverse().as_mat3() }
    }

    /// Returns a point of the world in the block's frame, m.
    pub fn local_point(&self, point: Vec3) -> Vec3 {
        self.local_direction(point - self.centre)
    }

    /// Returns a direction of the world in the block's frame.
    pub fn local_direction(&self, direction: Vec3) -> Vec3 {
        self.inverse * direction
    }

    /// Half edges, m.
    pub fn half(&self) -> Vec3 {
        self.shape.half()
    }

    /// Bounds in the world.
    pub fn bounds(&self) -> Bounds {
        let half = self.half();
        let extent =
            self.axes.x_axis.abs() * half.x + self.axes.y_axis.abs() * half.y + self.axes.z_axis.abs() * half.z;
        Bounds { min: self.centre - extent, max: self.centre + extent }
    }

    /// Corners of the box around the block, m.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> {
        (0..8).map(|bits| {
            let sign = |k: i32| ((bits >> k) & 1) as f32 * 2.0 - 1.0;
            self.centre + self.axes * (self.half() * Vec3::new(sign(0), sign(1), sign(2)))
        })
    }

    fn local(&self, ray: &Ray) -> Ray {
        Ray { origin: self.local_point(ray.origin), direction: self.local_direction(ray.direction) }
    }
}

/// All blocks of a picture.
#[derive(Debug)]
pub struct Solids {
    list: Vec<Solid>,
    tree: Bvh,
}

impl Solids {
    /// Sorts blocks for the rays.
    pub fn new(list: Vec<Solid>) -> Self {
        let boxes: Vec<Bounds> = list.iter().map(Solid::bounds).collect();
        Self { list, tree: Bvh::new(&boxes) }
    }

    /// Bounds of all blocks.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    /// All blocks, in order.
    pub fn list(&self) -> &[Solid] {
        &self.list
    }

    /// Returns the first block that a ray meets.
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut first = None;
        self.tree.visit(ray, f32::INFINITY, |block, max| {
            let solid = &self.list[block as usize];
            match solid.shape.entry(&solid.local(ray), max) {
                Some(entry) => {
                    first = Some((block, entry));
                    entry.distance
                }
                None => max,
            }
        });
        first.map(|(block, entry)| {
            let local_normal = entry.normal.normalize();
            let normal = (self.list[block as usize].inverse.transpose() * local_normal).normalize();
            Hit { block, distance: entry.distance, normal, local_normal, part: entry.part }
        })
    }

    /// Returns true if a ray begins in a block or meets one.
    pub fn is_blocked(&self, ray: &Ray) -> bool {
        let mut blocked = false;
        self.tree.visit(ray, f32::INFINITY, |block, max| {
            let solid = &self.list[block as usize];
            blocked = solid.shape.is_met(&solid.local(ray));
            if blocked { -1.0 } else { max }
        });
        blocked
    }
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};
    use teeter_physics::Pose;

    use super::*;

    /// A field of cubes in a fixed pseudo-random order and orientation.
    fn cubes() -> Vec<Solid> {
        let shape = Shape::new(Vec3::splat(0.03), 0.0);
        (0..200u32)
            .map(|i| {
                let n = f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0;
                let position = DVec3::new(f64::from(i % 10) * 0.07, f64::from(i / 10) * 0.05, 0.3 * n);
                let axis = DVec3::new(1.0, n, 2.0 - 3.0 * n).normalize();
                let orientation = DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
                Solid::new(shape, &Pose { position, orientation }.into())
            })
            .collect()
    }

    #[test]
    fn the_tree_finds_the_hit_of_a_search_through_all_blocks() {
        let list = cubes();
        let solids = Solids::new(list.clone());
        let mut hits = 0;
        for i in 0..30 {
            for j in 0..30 {
                let origin = Vec3::new(0.03 * i as f32 - 0.1, -0.5, 0.6);
                let ray =
                    Ray { origin, direction: Vec3::new(0.2 - 0.01 * i as f32, 0.9, -0.03 * j as f32).normalize() };
                let all = list.iter().enumerate().filter_map(|(block, solid)| {
                    let entry = solid.shape.entry(&solid.local(&ray), f32::INFINITY)?;
                    Some((entry.distance, block as u32))
                });
                let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
                let found = solids.first_hit(&ray).map(|hit| (hit.distance, hit.block));
                assert_eq!(found, nearest);
                assert_eq!(solids.is_blocked(&ray), nearest.is_some());
                hits += u32::from(nearest.is_some());
            }
        }
        assert!((100..800).contains(&hits), "{hits}");
    }

    #[test]
    fn no_blocks_stop_no_ray() {
        let solids = Solids::new(Vec::new());
        assert!(solids.first_hit(&Ray { origin: Vec3::Z, direction: Vec3::NEG_Z }).is_none());
    }
}
