//! Boxes along the axes of the world.

use glam::Vec3;

/// Box along the axes of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Corner with the smallest coordinates, m.
    pub min: Vec3,
    /// Corner with the largest coordinates, m.
    pub max: Vec3,
}

impl Bounds {
    /// Box that contains nothing.
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// Returns the smallest box that contains both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns the box that both contain. Where they have nothing in common, a side is negative.
    pub fn intersection(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Returns the box with a margin on all sides, m.
    pub fn grown(self, margin: f32) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Centre, m.
    pub fn centre(&self) -> Vec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the distance at which a ray enters, 0 where it begins inside; none where it does not
    /// enter within `max`. `inv` is one over the ray's direction, finite in each coordinate.
    pub fn entry(&self, origin: Vec3, inv: Vec3, max: f32) -> Option<f32> {
        let (a, b) = ((self.min - origin) * inv, (self.max - origin) * inv);
        let from = a.min(b).max_element().max(0.0);
        let to = a.max(b).min_element().min(max);
        (from <= to).then_some(from)
    }
}
