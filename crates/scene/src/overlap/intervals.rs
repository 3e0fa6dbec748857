//! Intervals of the blocks along the direction in which few of them overlap.

use glam::{DQuat, DVec3};

use crate::scene::Block;

/// Directions that are tried: the axes, and diagonals for long blocks that lie side by side at an
/// angle.
const DIRECTIONS: [[f64; 3]; 13] = [
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [2.0, 1.0, 0.0],
    [1.0, 2.0, 0.0],
    [2.0, -1.0, 0.0],
    [1.0, -2.0, 0.0],
];

/// Interval of a block along a direction, m.
#[derive(Debug, Clone, Copy)]
pub struct Interval {
    pub min: f64,
    pub max: f64,
}

/// Intervals along the direction in which they cover their whole span the fewest times.
pub fn sparsest(blocks: &[Block]) -> Vec<Interval> {
    let axes: Vec<[DVec3; 3]> = blocks.iter().map(half_axes).collect();
    let candidates = DIRECTIONS.map(|direction| along(blocks, &axes, DVec3::from_array(direction).normalize()));
    let best = candidates.into_iter().min_by(|a, b| cover(a).total_cmp(&cover(b)));
    best.expect("there is a direction")
}

/// Half edges of a block as vectors, m.
fn half_axes(block: &Block) -> [DVec3; 3] {
    let q = DQuat::from_array(block.rotation());
    let [x, y, z] = block.size.map(|edge| 0.5 * edge);
    [q * (DVec3::X * x), q * (DVec3::Y * y), q * (DVec3::Z * z)]
}

fn along(blocks: &[Block], axes: &[[DVec3; 3]], direction: DVec3) -> Vec<Interval> {
    let interval = |(block, axes): (&Block, &[DVec3; 3])| {
        let (centre, half) = (DVec3::from_array(block.pos).dot(direction), axes.map(|a| a.dot(direction).abs()));
        let half = half[0] + half[1] + half[2];
        Interval { min: centre - half, max: centre + half }
    };
    blocks.iter().zip(axes).map(interval).collect()
}

/// Sum of the lengths over the span: the mean number of intervals at a point.
fn cover(intervals: &[Interval]) -> f64 {
    let min = intervals.iter().map(|i| i.min).fold(f64::INFINITY, f64::min);
    let max = intervals.iter().map(|i| i.max).fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = intervals.iter().map(|i| i.max - i.min).sum();
    // A cover that is no number, of an empty list, is as good as any.
    if max > min { sum / (max - min) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rods_at_an_angle_hardly_overlap_along_a_diagonal() {
        let rod = |i: u32, yaw: f64| {
            let d = 0.02 * f64::from(i);
            let pos = [-libm::sin(yaw) * d, libm::cos(yaw) * d, 0.005];
            Block { yaw, ..Block::new(i, [10.0, 0.01, 0.01], 0.5, pos) }
        };
        for yaw in [0.0, std::f64::consts::FRAC_PI_4, -std::f64::consts::FRAC_PI_4, libm::atan(0.5)] {
            let rods: Vec<Block> = (0..1000).map(|i| rod(i, yaw)).collect();
            assert!(cover(&sparsest(&rods)) < 1.0, "yaw {yaw}: {}", cover(&sparsest(&rods)));
        }
    }
}
