//! Part of space that the grid covers.

use glam::Vec3;

use crate::bounds::Bounds;

/// Edge of a cell, m: three to a block's height.
pub const CELL: f32 = 0.006;
/// Number of grids, each with half the resolution of the one before.
pub const LEVELS: usize = 4;
/// Cells along an edge of the coarsest grid's cell, and of the unit by which the grid grows.
pub const UNIT: usize = 1 << (LEVELS - 1);
/// Maximum number of cells. A larger scene gets larger cells.
const MAX_CELLS: usize = 1 << 24;
/// Offset of the page's grid, m: cells are aligned with it.
const ORIGIN: f32 = -0.21;

/// Region that the grid covers.
#[derive(Debug, Clone, Copy)]
pub struct Region {
    /// Corner with the smallest coordinates, m.
    pub origin: Vec3,
    /// Edge of a cell, m.
    pub cell: f32,
    /// Cells along each axis: a multiple of [`UNIT`].
    pub count: [usize; 3],
}

impl Region {
    /// Returns a region around these bounds with `margin` beside and `above` them, m.
    pub fn new(bounds: Bounds, margin: f32, above: f32) -> Self {
        let bounds = if bounds.min.is_finite() { bounds } else { Bounds { min: Vec3::ZERO, max: Vec3::ZERO } };
        let mut cell = CELL;
        loop {
            let unit = UNIT as f32 * cell;
            let from = |x: f32| ORIGIN + ((x - margin - ORIGIN) / unit).floor() * unit;
            let origin = Vec3::new(from(bounds.min.x), from(bounds.min.y), 0.0);
            let extent = (bounds.max + Vec3::new(margin, margin, above) - origin).max(Vec3::ZERO);
            let count = extent.to_array().map(|x| ((x / unit).ceil() as usize).max(1) * UNIT);
            if count.iter().product::<usize>() <= MAX_CELLS {
                return Self { origin, cell, count };
            }
            cell *= 2.0;
        }
    }
}
