//! Grid of the filled fractions of cells.

use glam::Vec3;

use super::region::Region;
use crate::shading::mix;
use crate::solids::Solid;

/// Filled fractions of cells.
#[derive(Debug)]
pub struct Grid {
    /// Cells along each axis, without the border.
    count: [usize; 3],
    /// Fractions, 255 for all; x runs first. A border of one cell repeats the outer ones, so that
    /// the neighbours of each cell exist.
    cells: Vec<u8>,
}

impl Grid {
    /// Returns an empty grid.
    pub fn new(count: [usize; 3]) -> Self {
        Self { count, cells: vec![0; count.iter().map(|n| n + 2).product()] }
    }

    /// Numbers of cells from a row to the next, and from a layer to the next.
    fn strides(&self) -> (usize, usize) {
        let [nx, ny, _] = self.count;
        (nx + 2, (nx + 2) * (ny + 2))
    }

    /// Index of a cell, the border included: the first cell of an axis has the coordinate 1.
    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        let (row, layer) = self.strides();
        x + row * y + layer * z
    }

    /// Adds the part of each cell that a block fills.
    pub fn fill(&mut self, region: &Region, solid: &Solid) {
        let bounds = solid.bounds();
        let cell = |x: f32, k: usize| (x - region.origin[k]) / region.cell;
        let range = |k: usize| {
            let from = (cell(bounds.min[k], k) - 0.5).floor().max(0.0) as usize;
            let to = (cell(bounds.max[k], k).ceil() + 1.0).clamp(0.0, self.count[k] as f32) as usize;
            from..to
        };
        let (xs, ys, zs) = (range(0), range(1), range(2));
        for z in zs {
            for y in ys.clone() {
                for x in xs.clone() {
                    let centre = region.origin + region.cell * (Vec3::new(x as f32, y as f32, z as f32) + 0.5);
                    let depth = (solid.half() - solid.local_point(centre).abs()) / region.cell + 0.5;
                    let filled = depth.clamp(Vec3::ZERO, Vec3::ONE).element_product();
                    let index = self.index([x + 1, y + 1, z + 1]);
                    self.cells[index] = (f32::from(self.cells[index]) + 255.0 * filled).min(255.0) as u8;
                }
            }
        }
    }

    /// Repeats the outer cells in the border.
    pub fn close(&mut self) {
        let [nx, ny, nz] = self.count;
        for z in 0..nz + 2 {
            for y in 0..ny + 2 {
                let inner = |x: usize| [x.clamp(1, nx), y.clamp(1, ny), z.clamp(1, nz)];
                let outer_row = y == 0 || z == 0 || y > ny || z > nz;
                let step = if outer_row { 1 } else { nx + 1 };
                for x in (0..nx + 2).step_by(step) {
                    let (to, from) = (self.index([x, y, z]), self.index(inner(x)));
                    self.cells[to] = self.cells[from];
                }
            }
        }
    }

    /// Returns the grid with half the resolution.
    pub fn halved(&self) -> Self {
        let mut coarse = Self::new(self.count.map(|n| n / 2));
        let (row, layer) = self.strides();
        let [nx, ny, nz] = coarse.count;
        for z in 0..nz {
            for y in 0..ny {
                let from = self.index([1, 2 * y + 1, 2 * z + 1]);
                let to = coarse.index([1, y + 1, z + 1]);
                let pairs = |offset: usize| self.cells[from + offset..][..2 * nx].chunks_exact(2);
                let rows = pairs(0).zip(pairs(row)).zip(pairs(layer).zip(pairs(layer + row)));
                for (cell, ((a, b), (c, d))) in coarse.cells[to..][..nx].iter_mut().zip(rows) {
                    let sum: u32 = [a, b, c, d].iter().map(|pair| u32::from(pair[0]) + u32::from(pair[1])).sum();
                    *cell = ((sum + 4) / 8) as u8;
                }
            }
        }
        coarse.close();
        coarse
    }

    /// Fraction between the centres of the cells, at a position within the grid, in cells.
    pub fn interpolate(&self, at: Vec3) -> f32 {
        // The centre of the first cell is at 0.5 and has the coordinate 1.
        let p = at + 0.5;
        let (x, y, z) = (p.x as usize, p.y as usize, p.z as usize);
        let (tx, ty, tz) = (p.x - x as f32, p.y - y as f32, p.z - z as f32);
        let (row, layer) = self.strides();
        let from = self.index([x, y, z]);
        let along = |offset: usize| {
            let pair = &self.cells[from + offset..][..2];
            mix(f32::from(pair[0]), f32::from(pair[1]), tx)
        };
        mix(mix(along(0), along(row), ty), mix(along(layer), along(layer + row), ty), tz) / 255.0
    }

    /// Sum of the fractions of all cells.
    #[cfg(test)]
    pub fn sum(&self) -> f32 {
        let [nx, ny, nz] = self.count;
        let rows = (1..=nz).flat_map(|z| (1..=ny).map(move |y| [1, y, z]));
        rows.flat_map(|row| &self.cells[self.index(row)..][..nx]).map(|&x| f32::from(x) / 255.0).sum()
    }
}
