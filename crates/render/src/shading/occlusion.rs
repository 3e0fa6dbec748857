//! Ambient occlusion from a coarse grid of the wood, as on the page.
//!
//! Each cell has the fraction of it that is filled. A march from a surface into the grid in seven
//! directions darkens gaps and the table under the tower.

use core::f32::consts::TAU;

use glam::Vec3;

use super::mix;
use crate::bounds::Bounds;
use crate::solids::{Solid, Solids};

/// Edge of a cell, m: three to a block's height.
const CELL: f32 = 0.006;
/// Number of grids, each with half the resolution of the one before.
const LEVELS: usize = 4;
/// Cells along an edge of the coarsest grid's cell, and of the unit by which the grid grows.
const UNIT: usize = 1 << (LEVELS - 1);
/// Maximum number of cells. A larger scene gets larger cells.
const MAX_CELLS: usize = 1 << 24;
/// Offset of the page's grid, m: cells are aligned with it.
const ORIGIN: f32 = -0.21;
/// Distance from the surface at which a march begins, m.
const START: f32 = 0.0035;
/// Steps of a march: distance, m, part of the light that a filled cell takes, and level.
const STEPS: [(f32, f32, f32); 4] = [(0.005, 0.75, 0.0), (0.012, 0.85, 0.6), (0.026, 0.8, 1.6), (0.06, 0.7, 2.6)];

/// Region that the grid covers.
#[derive(Debug, Clone, Copy)]
pub struct Region {
    origin: Vec3,
    cell: f32,
    /// Cells along each axis.
    count: [usize; 3],
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

/// Filled fractions of the cells, at several resolutions.
#[derive(Debug)]
pub struct Occlusion {
    region: Region,
    levels: Vec<Grid>,
}

#[derive(Debug)]
struct Grid {
    count: [usize; 3],
    /// Filled fractions, 255 for all; x runs first.
    cells: Vec<u8>,
}

impl Occlusion {
    /// Fills the grid.
    pub fn new(region: Region, solids: &Solids) -> Self {
        let mut grid = Grid { count: region.count, cells: vec![0; region.count.iter().product()] };
        solids.list().iter().for_each(|solid| grid.fill(&region, solid));
        let mut levels = vec![grid];
        for _ in 1..LEVELS {
            let coarse = levels[levels.len() - 1].halved();
            levels.push(coarse);
        }
        Self { region, levels }
    }

    /// Returns the visible fraction of the sky at a point of a surface.
    pub fn sky(&self, point: Vec3, normal: Vec3) -> f32 {
        let from = point + START * normal;
        let side = if normal.z.abs() < 0.9 { normal.cross(Vec3::Z) } else { normal.cross(Vec3::X) };
        let a = side.normalize();
        let b = normal.cross(a);
        let mut seen = 0.25 * self.seen(from, normal);
        for i in 0..6 {
            let (sin, cos) = libm::sincosf(TAU / 6.0 * (i as f32 + 0.5));
            let direction = (normal + 1.2 * (cos * a + sin * b)).normalize();
            seen += 0.125 * self.seen(from, direction);
        }
        seen
    }

    /// Light that arrives along a direction.
    fn seen(&self, from: Vec3, direction: Vec3) -> f32 {
        STEPS.iter().fold(1.0, |seen, &(distance, part, level)| {
            seen * (1.0 - part * self.filled(from + distance * direction, level))
        })
    }

    /// Filled fraction around a point, between two levels.
    fn filled(&self, point: Vec3, level: f32) -> f32 {
        let at = (point - self.region.origin) / self.region.cell;
        let count = Vec3::from_array(self.region.count.map(|n| n as f32));
        if at.cmplt(Vec3::ZERO).any() || at.cmpgt(count).any() {
            return 0.0;
        }
        let fine = level as usize;
        let value = |level: usize| self.levels[level].interpolate(at / (1u32 << level) as f32);
        let part = level - fine as f32;
        if part == 0.0 { value(fine) } else { mix(value(fine), value(fine + 1), part) }
    }
}

impl Grid {
    /// Adds the part of each cell that a block fills.
    fn fill(&mut self, region: &Region, solid: &Solid) {
        let [nx, ny, _] = self.count;
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
                    let sum = &mut self.cells[x + nx * (y + ny * z)];
                    *sum = (f32::from(*sum) + 255.0 * filled).min(255.0) as u8;
                }
            }
        }
    }

    /// Returns the grid with half the resolution.
    fn halved(&self) -> Self {
        let [nx, ny, _] = self.count;
        let count = self.count.map(|n| n / 2);
        let mut cells = Vec::with_capacity(count.iter().product());
        for z in 0..count[2] {
            for y in 0..count[1] {
                for x in 0..count[0] {
                    let at = |i: usize, j: usize, k: usize| {
                        u32::from(self.cells[2 * x + i + nx * (2 * y + j + ny * (2 * z + k))])
                    };
                    let plane = |k| at(0, 0, k) + at(1, 0, k) + at(0, 1, k) + at(1, 1, k);
                    cells.push(((plane(0) + plane(1) + 4) / 8) as u8);
                }
            }
        }
        Self { count, cells }
    }

    /// Value between the centres of the cells, at a position in cells.
    fn interpolate(&self, at: Vec3) -> f32 {
        let [nx, ny, _] = self.count;
        let axis = |k: usize| {
            let p = at[k] - 0.5;
            let last = self.count[k] - 1;
            let low = p.floor();
            let index = |x: f32| (x.max(0.0) as usize).min(last);
            (index(low), index(low + 1.0), p - low)
        };
        let ((x0, x1, tx), (y0, y1, ty), (z0, z1, tz)) = (axis(0), axis(1), axis(2));
        let row = |y: usize, z: usize| {
            let at = |x: usize| f32::from(self.cells[x + nx * (y + ny * z)]);
            mix(at(x0), at(x1), tx)
        };
        mix(mix(row(y0, z0), row(y1, z0), ty), mix(row(y0, z1), row(y1, z1), ty), tz) / 255.0
    }
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};
    use teeter_physics::Pose;

    use super::*;
    use crate::shape::Shape;

    fn cube_at(x: f64) -> Occlusion {
        let pose = Pose { position: DVec3::new(x, 0.0, 0.03), orientation: DQuat::IDENTITY };
        let solids = Solids::new(vec![Solid::new(Shape::new(Vec3::splat(0.06), 0.0), &pose)]);
        Occlusion::new(Region::new(solids.bounds(), 0.2, 0.1), &solids)
    }

    #[test]
    fn cells_hold_the_volume_of_the_block_at_every_level() {
        let occlusion = cube_at(0.0013);
        for (level, grid) in occlusion.levels.iter().enumerate() {
            let cell = CELL * (1 << level) as f32;
            let volume = grid.cells.iter().map(|&x| f32::from(x) / 255.0).sum::<f32>() * cell * cell * cell;
            assert!((volume / 0.000_216 - 1.0).abs() < 0.05, "level {level}: {volume}");
        }
    }

    #[test]
    fn the_sky_is_free_far_from_a_block_and_half_taken_at_its_foot() {
        let occlusion = cube_at(0.0);
        assert_eq!(occlusion.sky(Vec3::new(0.15, 0.0, 0.0), Vec3::Z), 1.0);
        let foot = occlusion.sky(Vec3::new(0.0302, 0.0, 0.0), Vec3::Z);
        assert!((0.2..0.7).contains(&foot), "{foot}");
        // Above the block nothing takes light.
        assert!(occlusion.sky(Vec3::new(0.0, 0.0, 0.06), Vec3::Z) > 0.97);
    }
}
