//! Axis-aligned boxes of moving parts (section 4.4.3): each encloses the current state, the next
//! state and all between.

use glam::DVec3;
use wide::f64x4;

/// Bits of a comparison that holds in each lane. One branch on them is faster than `f64x4::all`,
/// which has one for each half of a register.
const ALL_LANES: u32 = 0b1111;

/// Axis-aligned box. A register holds a corner, with zero behind its coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Minimum corner, m.
    min: f64x4,
    /// Maximum corner, m.
    max: f64x4,
}

impl Bounds {
    /// Box of all space.
    pub const ALL: Self = Self {
        min: f64x4::new([f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0]),
        max: f64x4::new([f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0]),
    };

    /// Returns the box of a straight path.
    #[inline]
    pub fn of_path(from: DVec3, to: DVec3) -> Self {
        let [from, to] = [from, to].map(|v| f64x4::new([v.x, v.y, v.z, 0.0]));
        Self { min: from.fast_min(to), max: from.fast_max(to) }
    }

    /// Returns the box of two boxes.
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.fast_min(other.min), max: self.max.fast_max(other.max) }
    }

    /// Returns the box enlarged on every side by `margin`, m.
    pub fn enlarged(self, margin: f64) -> Self {
        let margin = f64x4::new([margin, margin, margin, 0.0]);
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Length of its longest edge, m.
    pub fn max_extent(&self) -> f64 {
        (self.max - self.min).to_array().into_iter().fold(0.0, f64::max)
    }

    /// Returns true if two boxes share a point.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (self.min.simd_le(other.max) & other.min.simd_le(self.max)).to_bitmask() == ALL_LANES
    }

    /// Returns true if another box lies within.
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        (self.min.simd_le(other.min) & other.max.simd_le(self.max)).to_bitmask() == ALL_LANES
    }
}

/// Returns a mask of the boxes, at most sixteen, that overlap another.
#[inline]
pub fn overlapping(boxes: &[Bounds], with: &Bounds) -> u16 {
    boxes.iter().enumerate().fold(0, |mask, (n, part)| mask | u16::from(part.overlaps(with)) << n)
}
