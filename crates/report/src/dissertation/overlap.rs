//! Overlap of blocks.

use glam::DVec3;
use teeter_dissertation::jenga3d::block::EDGE_CORNERS;

use super::oriented_box::OrientedBox;
use super::tower::Tower;

/// Maximum depth of a corner or the middle of an edge in another block, m.
pub fn max_depth(tower: &Tower) -> f64 {
    let corners: Vec<[DVec3; 8]> = (0..tower.len()).map(|block| tower.corners(block)).collect();
    let boxes: Vec<OrientedBox> = corners.iter().map(OrientedBox::of).collect();
    let mut depth = 0.0f64;
    for (block, corners) in corners.iter().enumerate() {
        let middles = EDGE_CORNERS.map(|[p, q]| 0.5 * (corners[p] + corners[q]));
        for point in corners.iter().chain(&middles) {
            let others = boxes.iter().enumerate().filter(|(other, _)| *other != block);
            depth = others.map(|(_, other)| other.depth(*point)).fold(depth, f64::max);
        }
    }
    depth
}
