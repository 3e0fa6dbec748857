//! Parts of the region that are near a block. Elsewhere nothing takes light of the sky.

use glam::Vec3;

use super::region::{Region, UNIT};
use crate::solids::Solid;

/// Coarse grid of flags.
#[derive(Debug)]
pub struct Nearby {
    origin: Vec3,
    /// Inverse of the edge of a cell, 1/m.
    inv: f32,
    count: [usize; 3],
    cells: Vec<bool>,
}

impl Nearby {
    /// Marks all cells that are within `distance` of a block's bounds, m.
    pub fn new(region: &Region, solids: &[Solid], distance: f32) -> Self {
        let count = region.count.map(|n| n / UNIT);
        let inv = 1.0 / (region.cell * UNIT as f32);
        let mut all = Self { origin: region.origin, inv, count, cells: vec![false; count.iter().product()] };
        for solid in solids {
            let bounds = solid.bounds();
            let range = |k: usize| {
                let cell = |x: f32| ((x - all.origin[k]) * inv).floor().clamp(-1.0, count[k] as f32);
                let (from, to) = (cell(bounds.min[k] - distance), cell(bounds.max[k] + distance));
                from.max(0.0) as usize..((to + 1.0) as usize).min(count[k])
            };
            let (xs, ys, zs) = (range(0), range(1), range(2));
            for (z, y) in zs.flat_map(|z| ys.clone().map(move |y| (z, y))) {
                let row = count[0] * (y + count[1] * z);
                all.cells[row + xs.start..row + xs.end.max(xs.start)].fill(true);
            }
        }
        all
    }

    /// Returns true if a point, m, is near a block.
    pub fn contains(&self, point: Vec3) -> bool {
        let at = (point - self.origin) * self.inv;
        // A point of the table may have a height just below 0.
        let at = at.with_z(at.z.max(0.0));
        let [x, y, z] = at.to_array().map(|x| x as usize);
        let [nx, ny, nz] = self.count;
        at.min_element() >= 0.0 && x < nx && y < ny && z < nz && self.cells[x + nx * (y + ny * z)]
    }
}
