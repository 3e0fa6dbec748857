//! Which pairs may touch: bounds of the boxes, grown by their margins.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, FLOOR, Shapes};

/// Axis-aligned bounds of a body, grown by its margin, m.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct Bound {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bound {
    pub fn new(shapes: &Shapes, bodies: &Bodies, i: usize) -> Self {
        let axes = DMat3::from_quat(bodies.orientation[i]);
        let half = shapes.half[i];
        let reach = axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z;
        let reach = reach + DVec3::splat(bodies.margin[i]);
        Self { min: bodies.position[i] - reach, max: bodies.position[i] + reach }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

/// The pairs (lower index first, or the floor) of the bodies in `due` with all others whose bounds overlap, each once.
pub fn overlapping(bounds: &[Bound], due: &[u32], is_due: &[bool]) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    for &i in due {
        let bound = &bounds[i as usize];
        if bound.min.z <= 0.0 {
            pairs.push((FLOOR, i));
        }
        for (j, other) in bounds.iter().enumerate() {
            let j = j as u32;
            // a pair of two due bodies is seen from its lower one
            if j == i || (is_due[j as usize] && j < i) {
                continue;
            }
            if bound.overlaps(other) {
                pairs.push((i.min(j), i.max(j)));
            }
        }
    }
    pairs
}
