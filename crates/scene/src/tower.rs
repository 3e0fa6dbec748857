//! Towers: rows of three, each crossing the one below.
//!
//! Row r (0 at the bottom) has its blocks' long axis along x where r is even and along y where it is odd; column c = 0, 1, 2 stands at
//! (c - 1) pitches along the short axis. The base of a row is the sum of the tallest blocks of the rows below, so that nothing overlaps at the
//! start: blocks that are lower than a neighbour begin with a gap above them, and are what the game calls loose.

use std::f64::consts::FRAC_PI_2;

use serde::{Deserialize, Serialize};

use crate::notation::{Cell, Notation};
use crate::random::Random;
use crate::{Block, BlockPreset, Form, Scene, SceneError, Springs, standard_gravity, usual_stiffness};

/// Most rows of a tower.
pub const MAX_ROWS: u32 = 200;

/// How many standard deviations a height or a mass may be off.
const CLIP: f64 = 2.0;

/// How much lower than the others a loose block is, m: the whole range of heights that the default scatter allows below the mean, so that it is
/// loose beside any neighbour of mean height.
pub const LOOSE_BY: f64 = 2e-4;

/// What a tower is made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TowerOptions {
    /// Rows of three, 1 to [`MAX_ROWS`]. A configuration has its own.
    pub rows: u32,
    /// Seed of the scatter. The same seed gives the same bits on every target, and more rows leave those below as they were.
    pub seed: u64,
    /// Make of the blocks.
    pub block: BlockPreset,
    /// Standard deviation of the heights, m, 0 to 1 mm; heights further than two of it from the mean are drawn again.
    pub height_sd: f64,
    /// Standard deviation of the masses, kg; the preset's where absent. Masses further than two of it from the mean are drawn again.
    pub mass_sd: Option<f64>,
    /// Coefficient of static friction, 0 to 2.
    pub friction: f64,
    /// Coefficient of kinetic friction; the static one where absent.
    pub kinetic_friction: Option<f64>,
    /// Coefficient of restitution, 0 to 1.
    pub restitution: f64,
}

/// Restitution of wood on wood, as textbooks of mechanics have it; no measurement on blocks like these is known.
pub const WOOD_RESTITUTION: f64 = 0.5;

impl Default for TowerOptions {
    fn default() -> Self {
        Self {
            rows: 18,
            seed: 1,
            block: BlockPreset::Dissertation,
            height_sd: 1e-4,
            mass_sd: None,
            friction: 0.4,
            kinetic_friction: None,
            restitution: WOOD_RESTITUTION,
        }
    }
}

impl TowerOptions {
    /// Blocks that are all the same: what configurations with a known answer are built from.
    pub fn exact() -> Self {
        Self { height_sd: 0.0, mass_sd: Some(0.0), ..Self::default() }
    }

    fn check(&self, rows: usize) -> Result<f64, SceneError> {
        let bad =
            |field, value: f64, expected: String| Err(SceneError::Field { field, value: value.to_string(), expected });
        if !(1..=MAX_ROWS as usize).contains(&rows) {
            return bad("rows", rows as f64, format!("1 to {MAX_ROWS}"));
        }
        if !(0.0..=1e-3).contains(&self.height_sd) {
            return bad("height_sd", self.height_sd, "0 to 0.001 m".into());
        }
        let mass_sd = self.mass_sd.unwrap_or(self.block.mass_sd());
        let most = self.block.mass() / 4.0;
        if !(0.0..=most).contains(&mass_sd) {
            return bad("mass_sd", mass_sd, format!("0 to {most} kg, a quarter of the mass"));
        }
        Ok(mass_sd)
    }
}

/// A full tower of `options.rows` rows.
pub fn tower(options: &TowerOptions) -> Result<Scene, SceneError> {
    options.check(options.rows as usize)?;
    let full = vec![[Cell::Present; 3]; options.rows as usize];
    let name = format!("tower-{}-{}-{}", options.block, options.rows, options.seed);
    build(&name, &full, options)
}

/// The tower of a configuration such as `(010)-(010)-(011)`, bottom row first: 1 is a block, 0 is none, `L` is a loose block.
pub fn config(text: &str, options: &TowerOptions) -> Result<Scene, SceneError> {
    let notation: Notation = text.parse()?;
    notation.scene(options)
}

/// The tower of a map of loose blocks such as `(L00)-(00L)`, bottom row first: every row is full, `L` is a loose block and 0 an ordinary one.
pub fn loose(text: &str, options: &TowerOptions) -> Result<Scene, SceneError> {
    Notation::from_loose_map(text)?.scene(options)
}

/// Distance between the axes of the towers of a field, m: one of 18 rows touches no other, even when it falls whole.
pub const FIELD_PITCH: f64 = 0.5;

/// So many full towers in a square field about the origin, row by row; each has a seed of its own, counted from that of `options`.
///
/// # Errors
/// As [`tower`], or when they have more blocks than a scene may have.
pub fn field(towers: u32, options: &TowerOptions) -> Result<Scene, SceneError> {
    let side = f64::from(towers).sqrt().ceil().max(1.0) as u32;
    let middle = 0.5 * f64::from(side - 1);
    let mut whole = tower(options)?;
    let mut blocks = Vec::new();
    for i in 0..towers {
        let seed = options.seed.wrapping_add(u64::from(i));
        let place = [f64::from(i % side) - middle, f64::from(i / side) - middle];
        for mut block in tower(&TowerOptions { seed, ..options.clone() })?.blocks {
            block.id = blocks.len() as u32;
            for (x, place) in block.pos.iter_mut().zip(place) {
                *x += FIELD_PITCH * place;
            }
            blocks.push(block);
        }
    }
    whole.name = format!("field-{towers}-{}-{}-{}", options.block, options.rows, options.seed);
    whole.blocks = blocks;
    whole.validate()?;
    Ok(whole)
}

pub(crate) fn build(name: &str, rows: &[[Cell; 3]], options: &TowerOptions) -> Result<Scene, SceneError> {
    let mass_sd = options.check(rows.len())?;
    let [length, width, height] = options.block.size();
    let mut random = Random::new(options.seed);
    let mut blocks = Vec::new();
    let mut base = 0.0;
    for (r, row) in rows.iter().enumerate() {
        let mut tallest: f64 = 0.0;
        for (c, cell) in row.iter().enumerate() {
            // Drawn for absent blocks too: taking one away leaves the others as they were.
            let h = height + options.height_sd * random.clipped_normal(CLIP);
            let mass = options.block.mass() + mass_sd * random.clipped_normal(CLIP);
            let h = match cell {
                Cell::Absent => continue,
                Cell::Present => h,
                Cell::Loose => h - LOOSE_BY,
            };
            let side = (c as f64 - 1.0) * options.block.pitch();
            let z = base + h / 2.0;
            let (pos, yaw) = if r % 2 == 0 { ([0.0, side, z], 0.0) } else { ([side, 0.0, z], FRAC_PI_2) };
            blocks.push(Block { id: blocks.len() as u32, size: [length, width, h], mass, pos, yaw });
            tallest = tallest.max(h);
        }
        base += tallest;
    }
    let scene = Scene {
        name: name.to_owned(),
        gravity: standard_gravity(),
        friction: options.friction,
        kinetic_friction: options.kinetic_friction,
        restitution: options.restitution,
        stiffness: usual_stiffness(),
        form: Form::default(),
        springs: Springs::default(),
        blocks,
        label: None,
        margin: None,
        tilt_az: None,
    };
    scene.validate()?;
    Ok(scene)
}
