//! Ambient occlusion from a coarse grid of the wood, as on the page.
//!
//! Each cell has the fraction of it that is filled. A march from a surface into the grid in seven
//! directions darkens gaps and the table under the tower.

mod grid;
mod nearby;
mod region;

use core::f32::consts::TAU;

use glam::Vec3;

use super::mix;
use crate::bounds::Bounds;
use crate::solids::Solids;
use grid::Grid;
use nearby::Nearby;
use region::{CELL, LEVELS, Region};

/// Distance from the surface at which a march begins, m.
const START: f32 = 0.0035;
/// Steps of a march: distance, m, part of the light that a filled cell takes, and level.
const STEPS: [(f32, f32, f32); 4] = [(0.005, 0.75, 0.0), (0.012, 0.85, 0.6), (0.026, 0.8, 1.6), (0.06, 0.7, 2.6)];

/// Distance within which a block takes light, m.
const REACH: f32 = START + STEPS[STEPS.len() - 1].0;
/// Cells around the blocks in which they take light. The coarsest grid is interpolated between
/// cells.
const MARGIN: usize = (REACH / CELL) as usize + 1 + (1 << LEVELS);
/// Directions beside the normal.
const BESIDE: usize = 6;

/// Filled fractions of the cells, at several resolutions.
#[derive(Debug)]
pub struct Occlusion {
    region: Region,
    nearby: Nearby,
    levels: Vec<Grid>,
    /// Cosine and sine of the directions beside the normal.
    circle: [(f32, f32); BESIDE],
}

impl Occlusion {
    /// Fills the grid.
    ///
    /// Blocks outside of `limits` take no light, or one that runs away would need an endless grid.
    pub fn new(solids: &Solids, limits: Bounds) -> Self {
        let region = Region::new(solids.bounds().intersection(limits), MARGIN);
        let mut grid = Grid::new(region.count);
        solids.list().iter().for_each(|solid| grid.fill(&region, solid));
        grid.close();
        let mut levels = vec![grid];
        for _ in 1..LEVELS {
            let coarse = levels[levels.len() - 1].halved();
            levels.push(coarse);
        }
        let distance = MARGIN as f32 * region.cell;
        let nearby = Nearby::new(&region, solids.list(), distance);
        let angle = |i: usize| TAU / BESIDE as f32 * (i as f32 + 0.5);
        let circle = core::array::from_fn(|i| (libm::cosf(angle(i)), libm::sinf(angle(i))));
        Self { region, nearby, levels, circle }
    }

    /// Returns the visible fraction of the sky at a point of a surface.
    pub fn sky(&self, point: Vec3, normal: Vec3) -> f32 {
        if !self.nearby.contains(point) {
            return 1.0;
        }
        let from = point + START * normal;
        let side = if normal.z.abs() < 0.9 { normal.cross(Vec3::Z) } else { normal.cross(Vec3::X) };
        let a = side.normalize();
        let b = normal.cross(a);
        let mut seen = 0.25 * self.seen(from, normal);
        for (cos, sin) in self.circle {
            let direction = (normal + 1.2 * (cos * a + sin * b)).normalize();
            seen += 0.125 * self.seen(from, direction);
        }
        seen
    }

    /// Returns true if a point of the table is within a cell of a block that stands on it.
    pub fn is_foot(&self, point: Vec3) -> bool {
        self.nearby.contains(point) && self.filled(point + START * Vec3::Z, 0.0) > 0.0
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

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};
    use teeter_physics::Pose;

    use super::*;
    use crate::shape::Shape;
    use crate::solids::Solid;

    fn cube_at(x: f64) -> Occlusion {
        let pose = Pose { position: DVec3::new(x, 0.0, 0.03), orientation: DQuat::IDENTITY };
        let solids = Solids::new(vec![Solid::new(Shape::new(Vec3::splat(0.06), 0.0), &pose.into())]);
        Occlusion::new(&solids, solids.bounds())
    }

    #[test]
    fn cells_hold_the_volume_of_the_block_at_every_level() {
        let occlusion = cube_at(0.0013);
        for (level, grid) in occlusion.levels.iter().enumerate() {
            let cell = CELL * (1 << level) as f32;
            let volume = grid.sum() * cell * cell * cell;
            assert!((volume / 0.000_216 - 1.0).abs() < 0.05, "level {level}: {volume}");
        }
    }

    /// The march finds nothing there.
    #[test]
    fn points_that_are_not_nearby_see_the_whole_sky() {
        let occlusion = cube_at(0.0013);
        let mut far = 0;
        for i in 0..1000 {
            let point = 0.03 * Vec3::new((i % 20) as f32 - 10.0, (i / 20 % 10) as f32, (i / 200) as f32);
            if occlusion.nearby.contains(point) {
                continue;
            }
            far += 1;
            for normal in [Vec3::X, Vec3::NEG_X, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z] {
                assert_eq!(occlusion.seen(point + START * normal, normal), 1.0, "{point}");
            }
        }
        assert!(far > 100, "{far}");
    }

    #[test]
    fn the_sky_is_free_far_from_a_block_and_half_taken_at_its_foot() {
        let occlusion = cube_at(0.0);
        assert_eq!(occlusion.sky(Vec3::new(0.15, 0.0, 0.0), Vec3::Z), 1.0);
        assert!(!occlusion.is_foot(Vec3::new(0.15, 0.0, 0.0)) && occlusion.is_foot(Vec3::new(0.0302, 0.0, 0.0)));
        let foot = occlusion.sky(Vec3::new(0.0302, 0.0, 0.0), Vec3::Z);
        assert!((0.2..0.7).contains(&foot), "{foot}");
        // A rounding error of the height changes nothing.
        let below = occlusion.sky(Vec3::new(0.0302, 0.0, -1e-8), Vec3::Z);
        assert!((below - foot).abs() < 1e-4, "{below}");
        // Above the block nothing takes light.
        assert!(occlusion.sky(Vec3::new(0.0, 0.0, 0.06), Vec3::Z) > 0.97);
    }
}
