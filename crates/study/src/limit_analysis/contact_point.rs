//! Points at which blocks may touch.

use glam::DVec2;
use teeter_scene::Block;

use super::program::UNIT;
use crate::plan::{area, bottom, center, corners, inset, overlap, top};
use crate::torsion::torsion_ratio;

/// Vertical distance within which two blocks may touch, m.
pub(super) const MAX_GAP: f64 = 2e-3;
/// Force below which a point is unloaded, N.
pub(super) const MIN_FORCE: f64 = 1e-9;

/// Corner of a region in which two blocks, or a block and the floor, may touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPoint {
    /// Index of the lower block; none for the floor.
    pub below: Option<usize>,
    /// Index of the upper block.
    pub above: usize,
    /// Position in plan, m.
    pub position: DVec2,
    /// Vertical distance as built, m.
    pub gap: f64,
    /// Share of the area of the region, m².
    pub area: f64,
    /// Number of the region.
    pub region: usize,
    /// Torsion ratio of the region, see [`crate::torsion`].
    pub torsion_ratio: f64,
}

impl ContactPoint {
    /// Calls `act` for each body that the force acts on, with its sign: up on the upper one.
    pub fn for_each_body(&self, mut act: impl FnMut(usize, f64)) {
        act(self.above, 1.0);
        if let Some(below) = self.below {
            act(below, -1.0);
        }
    }

    /// Lever arm from the centre of a block, in units of the programmes.
    pub fn lever_arm(&self, block: &Block) -> DVec2 {
        (self.position - center(block)) / UNIT
    }
}

/// Returns every point at which blocks may touch, region after region. The edges of the regions are
/// moved inwards by `distance`, m.
pub(super) fn contact_points(blocks: &[Block], distance: f64) -> Vec<ContactPoint> {
    let mut points = Vec::new();
    let mut regions = 0;
    for (above, block) in blocks.iter().enumerate() {
        let lower =
            (0..blocks.len()).filter(|&i| i != above && (bottom(block) - top(&blocks[i])).abs() < MAX_GAP).map(Some);
        let floor = (bottom(block) < MAX_GAP).then_some(None);
        for below in lower.chain(floor) {
            let (polygon, base) = match below.map(|i| &blocks[i]) {
                Some(other) => (overlap(block, other), top(other)),
                None => (corners(block), 0.0),
            };
            let polygon = if distance == 0.0 || polygon.is_empty() { polygon } else { inset(&polygon, distance) };
            if polygon.is_empty() {
                continue;
            }
            let gap = bottom(block) - base;
            let (area, torsion_ratio) = (area(&polygon) / polygon.len() as f64, torsion_ratio(&polygon));
            let region = regions;
            regions += 1;
            points.extend(polygon.into_iter().map(|position| ContactPoint {
                below,
                above,
                position,
                gap,
                area,
                region,
                torsion_ratio,
            }));
        }
    }
    points
}

/// Largest area of a point, m².
pub(super) fn max_area(points: &[ContactPoint]) -> f64 {
    points.iter().map(|p| p.area).fold(0.0, f64::max)
}
