//! Part of a ray within a convex solid.

use glam::IVec3;

use crate::ray::Entry;

/// Part of a ray that lies between pairs of parallel planes.
#[derive(Debug, Clone, Copy)]
pub struct Span {
    from: f32,
    to: f32,
    /// Plane at which it begins; none where it begins inside.
    first: Option<IVec3>,
}

impl Span {
    /// Returns the part from 0 to `max`.
    pub fn new(max: f32) -> Self {
        Self { from: 0.0, to: max, first: None }
    }

    /// Keeps the part in which a coordinate is within `bound` of 0: it is `start` at the origin of
    /// the ray and changes by `slope` per distance. `part` has the signs of the plane on its
    /// positive side. Returns none where nothing is left.
    pub fn clip(&mut self, part: IVec3, start: f32, slope: f32, bound: f32) -> Option<()> {
        if slope == 0.0 {
            return (start.abs() <= bound).then_some(());
        }
        let inv = 1.0 / slope;
        let (near, far) = ((-bound * slope.signum() - start) * inv, (bound * slope.signum() - start) * inv);
        if near > self.from {
            self.from = near;
            self.first = Some(if slope > 0.0 { -part } else { part });
        }
        self.to = self.to.min(far);
        (self.from <= self.to).then_some(())
    }

    /// Start of the span; none where the ray begins inside.
    pub fn entry(&self) -> Option<Entry> {
        self.first.map(|part| Entry { distance: self.from, normal: part.as_vec3(), part })
    }
}
