//! Blocks pushed apart until none overlaps another.

use glam::DVec3;

use crate::error::SceneError;
use crate::overlap::{self, Overlap};
use crate::scene::{Block, Scene};

/// Overlap that is left as it is, m: rounding of files that give six digits.
const TOLERANCE: f64 = 1e-6;
/// Maximum number of sweeps over all overlaps. A tower takes one for the heights; blocks side by
/// side take more, as each push can press a block into its neighbour on the other side.
const MAX_SWEEPS: usize = 2000;
/// Vertical part of a direction from which the push lifts the upper block: that of 45 degrees.
const LIFT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Blocks that [`settle`] has moved.
///
/// ```
/// use teeter_scene::{named, settle};
///
/// let mut scene = named("column").expect("the list has it");
/// scene.blocks[9].pos[2] -= 0.001;
/// let settlement = settle(&mut scene)?;
/// assert_eq!(settlement.moves.len(), 1);
/// assert_eq!(settlement.to_string(), "pushed 1 block apart, by up to 1 mm");
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settlement {
    /// Moved blocks in the order of the scene.
    pub moves: Vec<Move>,
}

/// Displacement of a block by [`settle`].
///
/// ```
/// let moved = teeter_scene::Move { id: 7, distance: 2e-4 };
/// assert_eq!(moved, moved.clone());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Id of the block.
    pub id: u32,
    /// Distance from its position before, m.
    pub distance: f64,
}

impl Settlement {
    /// Maximum distance, m; zero where no block was moved.
    pub fn max_distance(&self) -> f64 {
        self.moves.iter().map(|one| one.distance).fold(0.0, f64::max)
    }
}

impl std::fmt::Display for Settlement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let blocks = if self.moves.len() == 1 { "block" } else { "blocks" };
        // Two digits of the distance.
        let mm: f64 = format!("{:.1e}", 1e3 * self.max_distance()).parse().unwrap_or(f64::NAN);
        write!(f, "pushed {} {blocks} apart, by up to {mm} mm", self.moves.len())
    }
}

/// Pushes overlapping blocks apart, along the direction of the least depth, until no overlap is
/// deeper than a micrometre. Orientations stay, and so do fixed blocks.
///
/// Where blocks overlap in height the upper one is lifted, and a block in the floor is raised, so
/// that a tower grows upwards. Side by side, each block moves by the share of the other's mass.
/// The result depends on the scene alone.
///
/// # Errors
/// When a field of the scene is invalid, or blocks cannot be pushed apart: between fixed blocks, or
/// in too large a heap. The scene is then as far as it came.
///
/// ```
/// use teeter_scene::{named, settle};
///
/// // Two blocks beside each other, 1 mm inside; the right one has three times the mass.
/// let mut scene = named("block").expect("the list has it");
/// let mut right = scene.blocks[0].clone();
/// (right.id, right.mass) = (1, 3.0 * right.mass);
/// right.pos[1] += right.size[1] - 0.001;
/// scene.blocks.push(right);
/// let settlement = settle(&mut scene)?;
/// assert!((settlement.moves[0].distance - 0.75e-3).abs() < 1e-9);
/// assert!((settlement.moves[1].distance - 0.25e-3).abs() < 1e-9);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
pub fn settle(scene: &mut Scene) -> Result<Settlement, SceneError> {
    scene.validate_fields()?;
    let start: Vec<[f64; 3]> = scene.blocks.iter().map(|block| block.pos).collect();
    for _ in 0..MAX_SWEEPS {
        let raised = raise_from_floor(scene);
        let overlaps = from_below(scene);
        if overlaps.is_empty() && !raised {
            break;
        }
        let radius = scene.edge_radius;
        overlaps.iter().for_each(|overlap| push(&mut scene.blocks, overlap, radius));
    }
    scene.validate()?;
    let distance = |block: &Block, pos: &[f64; 3]| (DVec3::from(block.pos) - DVec3::from(*pos)).length();
    let moves =
        scene.blocks.iter().zip(&start).map(|(block, pos)| Move { id: block.id, distance: distance(block, pos) });
    Ok(Settlement { moves: moves.filter(|one| one.distance > 0.0).collect() })
}

/// Raises the blocks that are in the floor; returns true if there was one.
fn raise_from_floor(scene: &mut Scene) -> bool {
    let mut raised = false;
    for block in scene.blocks.iter_mut().filter(|block| !block.fixed) {
        let lowest = overlap::lowest_point(block, scene.edge_radius);
        if lowest < -TOLERANCE {
            block.pos[2] -= lowest;
            raised = true;
        }
    }
    raised
}

/// Overlaps from the lowest to the highest, so that one sweep lifts a whole tower.
fn from_below(scene: &Scene) -> Vec<Overlap> {
    let mut overlaps = overlap::pairs(scene, TOLERANCE);
    let height = |overlap: &Overlap| scene.blocks[overlap.first].pos[2] + scene.blocks[overlap.second].pos[2];
    // The sort is stable: pairs of equal height stay in the order of the blocks.
    overlaps.sort_by(|a, b| height(a).total_cmp(&height(b)));
    overlaps
}

/// Pushes two blocks apart by their present depth.
fn push(blocks: &mut [Block], overlap: &Overlap, edge_radius: f64) {
    let (a, b) = (&blocks[overlap.first], &blocks[overlap.second]);
    // Earlier pushes of the sweep may have changed it.
    let depth = overlap::rounded_depth(a, b, edge_radius);
    if depth <= 0.0 {
        return;
    }
    let direction = DVec3::from(overlap.direction);
    let share = if a.fixed || b.fixed {
        f64::from(u8::from(a.fixed))
    } else if direction.z.abs() >= LIFT {
        f64::from(u8::from(direction.z > 0.0))
    } else {
        a.mass / (a.mass + b.mass)
    };
    let mut shift = |i: usize, displacement: DVec3| {
        let block: &mut Block = &mut blocks[i];
        block.pos = (DVec3::from(block.pos) + displacement).to_array();
    };
    shift(overlap.second, direction * (depth * share));
    shift(overlap.first, direction * (depth * (share - 1.0)));
}
