//! Upright blocks with sharp edges.
//!
//! A block that turns only about the vertical is a rectangle in plan times an interval in height.
//! The separating axis test on the four edge directions in plan and the vertical is exact for such
//! blocks.

use glam::DVec3;

use crate::scene::Block;

/// Plan and height of an upright block.
pub struct Prism {
    /// Unit vectors along length and width.
    axes: [[f64; 2]; 2],
    /// Half length and half width, m.
    half: [f64; 2],
    /// Centre in plan, m.
    centre: [f64; 2],
    /// Minimum of the bounds along x, y and z, m.
    pub min: [f64; 3],
    /// Maximum of the bounds along x, y and z, m.
    pub max: [f64; 3],
}

impl Prism {
    /// Prism of a block, of which only the yaw is used.
    pub fn new(b: &Block) -> Self {
        let (s, c) = libm::sincos(b.yaw);
        let half = [b.size[0] / 2.0, b.size[1] / 2.0];
        let extent = [c.abs() * half[0] + s.abs() * half[1], s.abs() * half[0] + c.abs() * half[1], b.size[2] / 2.0];
        let min = std::array::from_fn(|k| b.pos[k] - extent[k]);
        let max = std::array::from_fn(|k| b.pos[k] + extent[k]);
        Self { axes: [[c, s], [-s, c]], half, centre: [b.pos[0], b.pos[1]], min, max }
    }

    /// Half the width of the plan's projection on a unit vector, m.
    fn half_width(&self, axis: [f64; 2]) -> f64 {
        self.half[0] * dot(self.axes[0], axis).abs() + self.half[1] * dot(self.axes[1], axis).abs()
    }

    /// Penetration depth of two prisms (m), and the unit vector along which the second one leaves
    /// the first. The depth is negative where they are apart; it is then not a distance.
    pub fn depth(&self, other: &Self) -> (f64, DVec3) {
        let mut depth = (self.max[2].min(other.max[2])) - (self.min[2].max(other.min[2]));
        let is_above = other.min[2] + other.max[2] >= self.min[2] + self.max[2];
        let mut direction = if is_above { DVec3::Z } else { DVec3::NEG_Z };
        let between = [other.centre[0] - self.centre[0], other.centre[1] - self.centre[1]];
        for axis in [self.axes[0], self.axes[1], other.axes[0], other.axes[1]] {
            let along = dot(between, axis);
            let overlap = self.half_width(axis) + other.half_width(axis) - along.abs();
            if overlap < depth {
                depth = overlap;
                direction = DVec3::new(axis[0], axis[1], 0.0) * if along < 0.0 { -1.0 } else { 1.0 };
            }
        }
        (depth, direction)
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
