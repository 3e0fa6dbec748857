//! Penetration of a block into another one or the floor, relative to its size.

use crate::overlap;
use crate::scene::{Block, Scene};

/// Penetration of a block into another one or the floor.
///
/// ```
/// use teeter_scene::{named, Penetration};
///
/// let mut scene = named("block").expect("the list has it");
/// let edge = scene.blocks[0].size[2];
/// scene.blocks[0].pos[2] -= 0.25 * edge;
/// let deepest = Penetration::deepest(&scene, 0.1).expect("it is in the floor");
/// assert_eq!((deepest.block, deepest.other), (0, None));
/// assert!((deepest.depth() - 0.25 * edge).abs() < 1e-12);
/// assert!(Penetration::deepest(&scene, 0.3).is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Penetration {
    /// Index of the block in the scene.
    pub block: usize,
    /// Index of the other block; none for the floor.
    pub other: Option<usize>,
    /// Depth over the edge.
    pub share: f64,
    /// Smallest edge of the two blocks, m.
    pub edge: f64,
}

impl Penetration {
    /// Returns the penetration depth, m.
    pub fn depth(&self) -> f64 {
        self.share * self.edge
    }

    /// Finds the deepest penetration, relative to the smallest edge of the two blocks, that is more
    /// than `share` of it. Fixed blocks may be in each other and in the floor.
    pub fn deepest(scene: &Scene, share: f64) -> Option<Self> {
        let edges: Vec<f64> = scene.blocks.iter().map(Block::smallest_edge).collect();
        let movable = scene.blocks.iter().enumerate().filter(|(_, block)| !block.fixed);
        let in_floor = movable.map(|(i, block)| {
            let depth = -overlap::lowest_point(block, scene.edge_radius);
            Self { block: i, other: None, share: depth / edges[i], edge: edges[i] }
        });
        let tolerance = share * edges.iter().copied().fold(f64::INFINITY, f64::min);
        let in_others = overlap::pairs(scene, tolerance).into_iter().map(|pair| {
            let edge = edges[pair.first].min(edges[pair.second]);
            Self { block: pair.first, other: Some(pair.second), share: pair.depth / edge, edge }
        });
        in_floor.chain(in_others).filter(|found| found.share > share).max_by(|a, b| a.share.total_cmp(&b.share))
    }
}
