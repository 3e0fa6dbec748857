//! Shape of a block: a box whose edges are chamfered or rounded.

mod chamfer;
mod round;
mod span;

use glam::{IVec3, Vec3};

use crate::ray::{Entry, Ray};
use span::Span;

/// Width of the chamfer of blocks, m, as on the page. A larger edge radius is drawn as it is, a
/// smaller one as a chamfer, or the edges of a tower would not show.
const CHAMFER: f32 = 0.0009;
/// Maximum width of a chamfer as a fraction of the smallest half edge.
const MAX_CHAMFER: f32 = 0.3;

/// Box around the origin of its frame.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// Half edges, m.
    half: Vec3,
    edge: Edge,
}

/// Edges of a box, with the distance from the edge at which the flat part of a face ends, m.
#[derive(Debug, Clone, Copy)]
enum Edge {
    Chamfered(f32),
    Round(f32),
}

impl Edge {
    fn inset(self) -> f32 {
        match self {
            Self::Chamfered(width) | Self::Round(width) => width,
        }
    }
}

impl Shape {
    /// Returns a box of full edges `size`, m, whose edges have a radius, m.
    pub fn new(size: Vec3, radius: f32) -> Self {
        let half = 0.5 * size;
        let thin = half.min_element();
        let edge = if radius > CHAMFER {
            Edge::Round(radius.min(thin))
        } else {
            Edge::Chamfered(CHAMFER.min(MAX_CHAMFER * thin))
        };
        Self { half, edge }
    }

    /// Half edges, m.
    pub fn half(&self) -> Vec3 {
        self.half
    }

    /// Returns the point at which a ray enters between the distances 0 and `max`.
    pub fn entry(&self, ray: &Ray, max: f32) -> Option<Entry> {
        let mut span = Span::new(max);
        for axis in 0..3 {
            let part = IVec3::AXES[axis];
            span.clip(part, ray.origin[axis], ray.direction[axis], self.half[axis])?;
        }
        let flat = |entry: &Entry| {
            let beside = ray.at(entry.distance).abs() - (self.half - Vec3::splat(self.edge.inset()));
            (0..3).all(|axis| entry.part[axis] != 0 || beside[axis] <= 0.0)
        };
        match (span.entry(), self.edge) {
            (Some(entry), _) if flat(&entry) => Some(entry),
            (_, Edge::Chamfered(width)) => chamfer::entry(self.half, width, ray, span),
            (_, Edge::Round(radius)) => round::entry(self.half, radius, ray, max),
        }
    }

    /// Returns true if a point is within the shape.
    pub fn contains(&self, point: Vec3) -> bool {
        // The shape is symmetric, so one of eight corners stands for all.
        let beyond = point.abs() - (self.half - Vec3::splat(self.edge.inset()));
        if beyond.max_element() > self.edge.inset() {
            return false;
        }
        match self.edge {
            Edge::Chamfered(width) => {
                let pair = beyond.element_sum() - beyond.min_element();
                pair <= width && beyond.element_sum() <= width
            }
            Edge::Round(radius) => beyond.max(Vec3::ZERO).length() <= radius,
        }
    }

    /// Returns true if a ray begins within the shape or enters it.
    pub fn is_met(&self, ray: &Ray) -> bool {
        self.entry(ray, f32::INFINITY).is_some() || self.contains(ray.origin)
    }
}

#[cfg(test)]
mod tests;
