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
    /// Returns a region around blocks with these bounds, with `margin` cells beside and above them.
    pub fn new(bounds: Bounds, margin: usize) -> Self {
        let bounds =
            if bounds.min.cmple(bounds.max).all() { bounds } else { Bounds { min: Vec3::ZERO, max: Vec3::ZERO } };
        let mut cell = CELL;
        loop {
            let (unit, margin) = (UNIT as f32 * cell, Vec3::splat(margin as f32 * cell));
            let from = (bounds.min - margin - ORIGIN) / unit;
            let origin = (Vec3::splat(ORIGIN) + from.floor() * unit).with_z(0.0);
            let extent = (bounds.max + margin - origin).max(Vec3::ZERO);
            let count = extent.to_array().map(|x| ((x / unit).ceil() as usize).max(1) * UNIT);
            if count.iter().product::<usize>() <= MAX_CELLS {
                return Self { origin, cell, count };
            }
            cell *= 2.0;
        }
    }
}
