//! Towers drawn at random, labelled by limit analysis.

use std::f64::consts::FRAC_PI_2;

use teeter_scene::{Block, Cell, Notation, Random, Scene, TowerOptions};

use crate::limit_analysis::RigidTower;

/// Rows of a tower, the largest number included.
const ROWS: std::ops::RangeInclusive<usize> = 3..=12;
/// Standard deviation of a block along its long axis, and of a row across it, m.
const SCATTER: [f64; 2] = [2e-3, 1e-3];
/// Largest deviation, in standard deviations.
const MAX_SCATTER: f64 = 2.5;
/// Margin below which a answer is not clear, m.
const MIN_MARGIN: f64 = 1e-4;

/// Patterns of a row, bit by bit. Those that cannot bear a row on one side are a third.
const PATTERNS: [usize; 12] = [0b001, 0b011, 0b100, 0b110, 0b010, 0b010, 0b101, 0b101, 0b111, 0b111, 0b111, 0b111];

/// Returns a tower drawn from a seed, with `label` and `margin` (mm) by limit analysis: stable for
/// an even seed and unstable for an odd one. Towers that 0.1 mm decides are drawn again.
///
/// A row has one, two or three blocks. Half of the towers are scattered along and across their
/// rows.
///
/// ```
/// use teeter_study::{RigidTower, drawn_tower};
///
/// let [stable, unstable] = [4, 5].map(drawn_tower);
/// assert_eq!((stable.label.as_deref(), unstable.label.as_deref()), (Some("stable"), Some("unstable")));
/// assert_eq!((RigidTower::falls(&stable), RigidTower::falls(&unstable)), (Some(false), Some(true)));
/// assert_eq!(drawn_tower(4), stable);
/// ```
pub fn drawn_tower(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let stable = seed.is_multiple_of(2);
    loop {
        let mut scene = scattered(&mut random);
        // A tower that statics cannot judge, or not clearly, is drawn again.
        if RigidTower::falls(&scene) != Some(!stable) {
            continue;
        }
        let Ok(margin) = RigidTower::margin(&scene) else { continue };
        let is_clear = margin.abs() >= MIN_MARGIN;
        let is_proven = stable || RigidTower::falls_despite_friction(&scene, -MIN_MARGIN) == Ok(true);
        if is_clear && is_proven {
            scene.name = format!("drawn-{seed}");
            scene.label = Some(if stable { "stable" } else { "unstable" }.into());
            scene.margin = Some(1e3 * margin);
            return scene;
        }
    }
}

/// Tower of random rows, half of them scattered.
fn scattered(random: &mut Random) -> Scene {
    let count = ROWS.start() + random.below(ROWS.end() - ROWS.start() + 1);
    let mut scene = Notation { rows: (0..count).map(|_| row(random)).collect() }
        .scene(&TowerOptions::exact())
        .expect("rows of at least one block are a tower");
    if random.below(2) == 0 {
        return scene;
    }
    let mut across = 0.0;
    let mut height = f64::NEG_INFINITY;
    for block in &mut scene.blocks {
        if block.pos[2] > height {
            (height, across) = (block.pos[2], SCATTER[1] * random.clipped_normal(MAX_SCATTER));
        }
        scatter(block, SCATTER[0] * random.clipped_normal(MAX_SCATTER), across);
    }
    scene
}

/// Moves a block along its long axis and across it, m.
fn scatter(block: &mut Block, along: f64, across: f64) {
    let is_turned = (block.yaw - FRAC_PI_2).abs() < 0.1;
    let (x, y) = if is_turned { (across, along) } else { (along, across) };
    block.pos[0] += x;
    block.pos[1] += y;
}

/// Row with the blocks of one of the seven patterns.
fn row(random: &mut Random) -> [Cell; 3] {
    let pattern = PATTERNS[random.below(PATTERNS.len())];
    std::array::from_fn(|column| if pattern >> column & 1 == 1 { Cell::Present } else { Cell::Absent })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_a_drawn_tower_do_not_overlap() {
        for seed in 0..6 {
            let scene = drawn_tower(seed);
            scene.validate().unwrap_or_else(|error| panic!("{seed}: {error}"));
            assert!(ROWS.contains(&scene.blocks.iter().map(|b| (b.pos[2] / 0.018) as usize + 1).max().unwrap()));
        }
    }
}
