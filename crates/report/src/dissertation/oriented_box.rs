//! Box that fits the corners of a block.

use glam::DVec3;

/// Box with its axes.
pub struct OrientedBox {
    /// Centre, m.
    pub centre: DVec3,
    /// Half of the edge lengths, m.
    pub half: [f64; 3],
    /// Unit vectors along the edges.
    pub axes: [DVec3; 3],
}

impl OrientedBox {
    /// Box of the affine motion of corners (m). Bits 0, 1 and 2 of an index give the side.
    pub fn of(corners: &[DVec3; 8]) -> Self {
        let half = [0, 1, 2]
            .map(|bit| (0..8).map(|c| if c >> bit & 1 == 1 { corners[c] } else { -corners[c] }).sum::<DVec3>() / 8.0);
        Self {
            centre: corners.iter().sum::<DVec3>() / 8.0,
            half: half.map(DVec3::length),
            axes: half.map(DVec3::normalize_or_zero),
        }
    }

    /// Depth of a point inside the box, m; negative outside.
    pub fn depth(&self, point: DVec3) -> f64 {
        let depths = [0, 1, 2].map(|n| self.half[n] - (point - self.centre).dot(self.axes[n]).abs());
        depths.into_iter().fold(f64::INFINITY, f64::min)
    }
}
