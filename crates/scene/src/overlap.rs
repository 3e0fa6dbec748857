//! Whether upright blocks are inside each other.
//!
//! Blocks that are only turned about the vertical are rectangles in plan times an interval in height. Rectangles are parted by the separating
//! axis test on their four edge directions, so the depth found here is exact: the least distance that parts the two blocks.

use crate::Block;

/// A block's plan and height.
struct Prism {
    /// Unit vectors along length and width.
    axes: [[f64; 2]; 2],
    /// Half length and half width, m.
    half: [f64; 2],
    /// Centre in plan, m.
    centre: [f64; 2],
    /// Interval that it covers along x, y and z, m.
    low: [f64; 3],
    high: [f64; 3],
}

impl Prism {
    fn new(b: &Block) -> Self {
        let (s, c) = libm::sincos(b.yaw);
        let half = [b.size[0] / 2.0, b.size[1] / 2.0];
        let reach = [c.abs() * half[0] + s.abs() * half[1], s.abs() * half[0] + c.abs() * half[1], b.size[2] / 2.0];
        let low = std::array::from_fn(|k| b.pos[k] - reach[k]);
        let high = std::array::from_fn(|k| b.pos[k] + reach[k]);
        Self { axes: [[c, s], [-s, c]], half, centre: [b.pos[0], b.pos[1]], low, high }
    }

    /// Half the width of the plan's shadow on a unit vector, m.
    fn reach(&self, axis: [f64; 2]) -> f64 {
        self.half[0] * dot(self.axes[0], axis).abs() + self.half[1] * dot(self.axes[1], axis).abs()
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn depth_of(a: &Prism, b: &Prism) -> f64 {
    let mut least = (a.high[2].min(b.high[2])) - (a.low[2].max(b.low[2]));
    let between = [b.centre[0] - a.centre[0], b.centre[1] - a.centre[1]];
    for axis in [a.axes[0], a.axes[1], b.axes[0], b.axes[1]] {
        least = least.min(a.reach(axis) + b.reach(axis) - dot(between, axis).abs());
    }
    least
}

/// The least distance that would part two blocks, m; negative where they are apart (then it is no distance).
pub fn depth(a: &Block, b: &Block) -> f64 {
    depth_of(&Prism::new(a), &Prism::new(b))
}

/// The first two blocks, in order of creation, that are inside each other by more than `tolerance`, and by how much (m).
pub fn first(blocks: &[Block], tolerance: f64) -> Option<(usize, usize, f64)> {
    let prisms: Vec<Prism> = blocks.iter().map(Prism::new).collect();
    // Swept along the axis on which the blocks are spread furthest: few then share an interval, be they a column or a field.
    let spread = |k: usize| {
        let high = prisms.iter().map(|p| p.high[k]).fold(f64::NEG_INFINITY, f64::max);
        high - prisms.iter().map(|p| p.low[k]).fold(f64::INFINITY, f64::min)
    };
    let along = (0..3).max_by(|&a, &b| spread(a).total_cmp(&spread(b))).unwrap_or(0);
    let mut order: Vec<usize> = (0..prisms.len()).collect();
    order.sort_by(|&a, &b| prisms[a].low[along].total_cmp(&prisms[b].low[along]).then(a.cmp(&b)));
    let mut found: Option<(usize, usize, f64)> = None;
    for (place, &i) in order.iter().enumerate() {
        for &j in &order[place + 1..] {
            if prisms[j].low[along] > prisms[i].high[along] - tolerance {
                break;
            }
            let pair = (i.min(j), i.max(j));
            if found.is_some_and(|(a, b, _)| (a, b) <= pair) {
                continue;
            }
            let depth = depth_of(&prisms[i], &prisms[j]);
            if depth > tolerance {
                found = Some((pair.0, pair.1, depth));
            }
        }
    }
    found
}
