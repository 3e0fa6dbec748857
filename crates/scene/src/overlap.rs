//! Overlap of upright blocks.
//!
//! A block that turns only about the vertical is a rectangle in plan times an interval in height.
//! The separating axis test on the four edge directions in plan and the vertical is exact for such
//! blocks.

use crate::scene::Block;

/// Plan and swept bounds of a block.
struct Prism {
    /// Unit vectors along length and width.
    axes: [[f64; 2]; 2],
    /// Half length and half width, m.
    half: [f64; 2],
    /// Centre in plan, m.
    centre: [f64; 2],
    /// Minimum of the bounds along x, y and z, m.
    min: [f64; 3],
    /// Maximum of the bounds along x, y and z, m.
    max: [f64; 3],
}

impl Prism {
    fn new(b: &Block) -> Self {
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
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn prism_depth(a: &Prism, b: &Prism) -> f64 {
    let mut depth = (a.max[2].min(b.max[2])) - (a.min[2].max(b.min[2]));
    let between = [b.centre[0] - a.centre[0], b.centre[1] - a.centre[1]];
    for axis in [a.axes[0], a.axes[1], b.axes[0], b.axes[1]] {
        depth = depth.min(a.half_width(axis) + b.half_width(axis) - dot(between, axis).abs());
    }
    depth
}

/// Returns the penetration depth of two blocks, m: the minimum distance that separates them.
///
/// A negative value means that they are apart; it is then not a distance.
///
/// ```
/// use teeter_scene::{Block, overlap};
///
/// let a = Block::new(0, [0.08, 0.03, 0.02], 0.02, [0.0, 0.0, 0.01]);
/// let b = Block { id: 1, pos: [0.0, 0.0, 0.029], ..a.clone() };
/// assert!((overlap::depth(&a, &b) - 0.001).abs() < 1e-12);
/// ```
pub fn depth(a: &Block, b: &Block) -> f64 {
    prism_depth(&Prism::new(a), &Prism::new(b))
}

/// Finds the first two blocks, in order of creation, that penetrate by more than `tolerance` (m).
/// Returns their indices and the depth (m).
pub fn first_pair(blocks: &[Block], tolerance: f64) -> Option<(usize, usize, f64)> {
    let prisms: Vec<Prism> = blocks.iter().map(Prism::new).collect();
    // Sweep along the axis of the largest extent: few intervals overlap there, in a column and in a
    // field.
    let spread = |k: usize| {
        let max = prisms.iter().map(|p| p.max[k]).fold(f64::NEG_INFINITY, f64::max);
        max - prisms.iter().map(|p| p.min[k]).fold(f64::INFINITY, f64::min)
    };
    let along = (0..3).max_by(|&a, &b| spread(a).total_cmp(&spread(b))).unwrap_or(0);
    let mut order: Vec<usize> = (0..prisms.len()).collect();
    order.sort_by(|&a, &b| prisms[a].min[along].total_cmp(&prisms[b].min[along]).then(a.cmp(&b)));
    let mut found: Option<(usize, usize, f64)> = None;
    for (rank, &i) in order.iter().enumerate() {
        for &j in &order[rank + 1..] {
            if prisms[j].min[along] > prisms[i].max[along] - tolerance {
                break;
            }
            let pair = (i.min(j), i.max(j));
            if found.is_some_and(|(a, b, _)| (a, b) <= pair) {
                continue;
            }
            let depth = prism_depth(&prisms[i], &prisms[j]);
            if depth > tolerance {
                found = Some((pair.0, pair.1, depth));
            }
        }
    }
    found
}
