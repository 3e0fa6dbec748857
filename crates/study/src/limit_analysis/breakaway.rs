//! Exact breakaway force of a block: straight sliding, turning and tipping.

use glam::DVec2;
use serde::Serialize;

use super::contact_point::{ContactPoint, MAX_GAP, MIN_FORCE};
use super::error::LimitError;
use super::tower::RigidTower;
use crate::plan::{bottom, center, convex_hull, distance_to_edge, long_axis};

/// Relative difference up to which two forces agree: twice the error of the friction polygon.
const AGREEMENT: f64 = 0.01;

/// Exact forces that start a block sliding along its long axis, the same forwards and backwards.
///
/// ```
/// # use teeter_study::RigidTower;
/// let mut scene = teeter_scene::named("column").unwrap();
/// let top = RigidTower::new(&scene)?.breakaway(9)?;
/// // nothing lies on the top block, so nothing turns
/// assert!(top.is_exact() && top.straight_n == top.turning_n);
///
/// scene.friction = 3.0;
/// let rough = RigidTower::new(&scene)?.breakaway(9)?;
/// assert!(rough.rocks() && rough.tipping_n == top.tipping_n);
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Breakaway {
    /// Force if the blocks above can slide on the block or go along, but not turn, N.
    pub straight_n: f64,
    /// Force if blocks can turn about the vertical as well, with the normal forces of rest, N.
    pub turning_n: f64,
    /// Force from which the tower rocks about the edge of its bearers, N; none where the block is
    /// too low for the tower to rock.
    pub tipping_n: Option<f64>,
}

impl Breakaway {
    /// Returns true if the force is exact: straight and turning agree, and the tower does not rock
    /// before.
    pub fn is_exact(&self) -> bool {
        self.straight_n - self.turning_n <= AGREEMENT * self.straight_n && !self.rocks()
    }

    /// Returns true if the tower rocks before the block slides.
    pub fn rocks(&self) -> bool {
        self.tipping_n.is_some_and(|tipping| tipping < self.straight_n)
    }
}

impl RigidTower<'_> {
    /// Returns the exact forces for a block.
    ///
    /// # Errors
    /// When the solver gives up.
    ///
    /// # Panics
    /// When the tower has no block of that index.
    pub fn breakaway(&self, block: usize) -> Result<Breakaway, LimitError> {
        let straight_n = self.straight_force(block);
        // without load nothing can turn
        let turning_n = if self.force_above(block) < MIN_FORCE { straight_n } else { self.turning_force(block)? };
        Ok(Breakaway { straight_n, turning_n, tipping_n: self.tipping_force(block) })
    }

    /// Returns the force along its long axis that starts a block sliding when nothing turns, N:
    /// mu (N below + the smaller of N above and of N above its row mates).
    ///
    /// # Panics
    /// When the tower has no block of that index.
    pub fn straight_force(&self, block: usize) -> f64 {
        let blocks = &self.scene.blocks;
        let mates =
            (0..blocks.len()).filter(|&j| j != block && (bottom(&blocks[j]) - bottom(&blocks[block])).abs() < MAX_GAP);
        self.scene.friction
            * (self.force_below(block) + self.force_above(block).min(mates.map(|j| self.force_above(j)).sum()))
    }

    /// Returns the smallest force along its long axis, in either direction, at which the tower
    /// begins to rock, N; none where the block is too low for the tower to rock.
    ///
    /// # Panics
    /// When the tower has no block of that index.
    pub fn tipping_force(&self, block: usize) -> Option<f64> {
        let blocks = &self.scene.blocks;
        let (axis, pulled) = (long_axis(&blocks[block]), &blocks[block]);
        let mut min: Option<f64> = None;
        for cut in blocks.iter().map(bottom).filter(|&cut| cut < pulled.pos[2]) {
            let (mut mass, mut moment) = (0.0, DVec2::ZERO);
            for block in blocks.iter().filter(|b| bottom(b) > cut - MAX_GAP) {
                mass += block.mass;
                moment += block.mass * center(block);
            }
            let support = convex_hull(&self.loaded_points(cut));
            for direction in [axis, -axis] {
                let distance = distance_to_edge(&support, moment / mass, direction).unwrap_or(0.0);
                let force = distance * mass * self.scene.gravity / (pulled.pos[2] - cut);
                min = Some(min.map_or(force, |m| m.min(force)));
            }
        }
        min
    }

    /// Positions of the loaded points at which the blocks above the height `cut` rest on others, m.
    fn loaded_points(&self, cut: f64) -> Vec<DVec2> {
        let above = |i: usize| bottom(&self.scene.blocks[i]) > cut - MAX_GAP;
        let bears = |p: &ContactPoint| above(p.above) && !p.below.is_some_and(above);
        let loaded = self.points.iter().zip(&self.forces).filter(|&(p, &f)| bears(p) && f > MIN_FORCE);
        loaded.map(|(p, _)| p.position).collect()
    }
}
