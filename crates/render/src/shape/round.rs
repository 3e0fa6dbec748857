//! A box with round edges: the union of three boxes, each without the edges along one axis, twelve
//! cylinders and eight spheres.

use glam::{IVec3, Vec3};

use super::span::Span;
use crate::ray::{Entry, Ray};

/// Returns the point at which a ray enters between the distances 0 and `max`.
pub fn entry(half: Vec3, radius: f32, ray: &Ray, max: f32) -> Option<Entry> {
    let core = half - Vec3::splat(radius);
    let mut first: Option<Entry> = None;
    let mut add = |found: Option<Entry>| {
        if let Some(entry) = found
            && first.is_none_or(|other| entry.distance < other.distance)
        {
            first = Some(entry);
        }
    };
    for axis in 0..3 {
        add(slab(core + radius * Vec3::AXES[axis], axis, ray, max));
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (su, sv) in [(-1, -1), (-1, 1), (1, -1), (1, 1)] {
            let mut part = IVec3::ZERO;
            (part[u], part[v]) = (su, sv);
            // Along the axis a cylinder has the length of the core.
            let across = Vec3::ONE - Vec3::AXES[axis];
            let cylinder = Ball { centre: core * part.as_vec3(), radius, across, part };
            let found = cylinder.entry(ray, max);
            add(found.filter(|entry| ray.at(entry.distance)[axis].abs() <= core[axis]));
        }
    }
    for bits in 0..8 {
        let sign = |k: i32| ((bits >> k) & 1) * 2 - 1;
        let part = IVec3::new(sign(0), sign(1), sign(2));
        add(Ball { centre: core * part.as_vec3(), radius, across: Vec3::ONE, part }.entry(ray, max));
    }
    first
}

/// Entry through a face of a box across `axis`. The other sides of that box lie within the solid.
fn slab(half: Vec3, axis: usize, ray: &Ray, max: f32) -> Option<Entry> {
    let mut span = Span::new(max);
    for k in 0..3 {
        span.clip(IVec3::AXES[k], ray.origin[k], ray.direction[k], half[k])?;
    }
    span.entry().filter(|entry| entry.part[axis] != 0)
}

/// Ball, or with a zero in `across` the cylinder along that axis.
struct Ball {
    centre: Vec3,
    radius: f32,
    across: Vec3,
    part: IVec3,
}

impl Ball {
    fn entry(&self, ray: &Ray, max: f32) -> Option<Entry> {
        let (o, d) = ((ray.origin - self.centre) * self.across, ray.direction * self.across);
        let a = d.dot(d);
        if a == 0.0 {
            return None;
        }
        // From the point nearest to the centre, or a distant origin loses digits.
        let middle = -o.dot(d) / a;
        let nearest = o + middle * d;
        let depth = self.radius * self.radius - nearest.dot(nearest);
        if depth < 0.0 {
            return None;
        }
        let distance = middle - (depth / a).sqrt();
        (0.0..=max).contains(&distance).then(|| Entry { distance, normal: o + distance * d, part: self.part })
    }
}
