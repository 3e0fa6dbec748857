//! Towers: rows of three blocks, each row across the one below.
//!
//! Row r (0 at the bottom) has the long axes of its blocks along x where r is even and along y
//! where r is odd. Column c = 0, 1, 2 is (c - 1) pitches from the axis. The base of a row is the
//! sum of the tallest blocks of the rows below, so that nothing overlaps at the start; a block
//! lower than a neighbour begins with a gap above it and is loose.

use std::f64::consts::FRAC_PI_2;

use serde::{Deserialize, Serialize};

use crate::error::SceneError;
use crate::form::{Form, Springs};
use crate::notation::{Cell, MAX_ROWS, Notation};
use crate::preset::BlockPreset;
use crate::random::Random;
use crate::scene::{Block, Scene, default_stiffness, standard_gravity};

/// Maximum deviation of a height or mass from its mean, in standard deviations.
const MAX_DEVIATION: f64 = 2.0;

/// Height by which a loose block is lower than the others, m: the whole range of the default
/// scatter below the mean, so that it is loose beside any neighbour of mean height.
pub const LOOSE_CLEARANCE: f64 = 2e-4;

/// Distance between the axes of the towers of a field, m: a tower of 18 rows that falls whole
/// touches no other.
pub const FIELD_PITCH: f64 = 0.5;

/// Restitution of wood on wood, from textbooks of mechanics; no measurement of such blocks is
/// known.
pub const WOOD_RESTITUTION: f64 = 0.5;

/// Radius of the edges of wooden blocks, m.
///
/// No measurement of such blocks is known. Edges of sanded wood are eased by a few tenths of a
/// millimetre; from 0.2 to 0.5 mm a block that is pushed back into its tower rides over the steps
/// between blocks of 0.1 mm scatter, as it does in the hand, while twice a smaller radius would not
/// clear the largest step.
pub const WOOD_EDGE_RADIUS: f64 = 3e-4;

/// Options of a tower.
///
/// ```
/// use teeter_scene::{BlockPreset, TowerOptions, tower};
///
/// let options = TowerOptions { rows: 6, block: BlockPreset::Official, ..TowerOptions::default() };
/// assert_eq!(tower(&options)?.name, "tower-official-6-1");
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TowerOptions {
    /// Number of rows, 1 to [`MAX_ROWS`]. A configuration has its own.
    pub rows: u32,
    /// Seed of the scatter. The same seed gives the same bits on every target, and further rows
    /// leave those below unchanged.
    pub seed: u64,
    /// Preset of the blocks.
    pub block: BlockPreset,
    /// Standard deviation of the heights, m, 0 to 1 mm. Heights beyond two deviations are drawn
    /// again.
    pub height_sd: f64,
    /// Standard deviation of the masses, kg. Defaults to that of the preset. Masses beyond two
    /// deviations are drawn again.
    pub mass_sd: Option<f64>,
    /// Coefficient of static friction, 0 to 2.
    pub friction: f64,
    /// Coefficient of kinetic friction. Defaults to the static one.
    pub kinetic_friction: Option<f64>,
    /// Coefficient of restitution, 0 to 1.
    pub restitution: f64,
    /// Radius of the edges, m, 0 to a third of the smallest edge.
    pub edge_radius: f64,
}

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
            edge_radius: WOOD_EDGE_RADIUS,
        }
    }
}

impl TowerOptions {
    /// Returns options without scatter and with sharp edges, for configurations with a known
    /// answer.
    pub fn exact() -> Self {
        Self { height_sd: 0.0, mass_sd: Some(0.0), edge_radius: 0.0, ..Self::default() }
    }

    /// Checks the options for a tower of `rows` rows and returns the standard deviation of the
    /// masses, kg.
    fn validate(&self, rows: usize) -> Result<f64, SceneError> {
        let invalid =
            |field, value: f64, expected: String| Err(SceneError::Field { field, value: value.to_string(), expected });
        if !(1..=MAX_ROWS as usize).contains(&rows) {
            return invalid("rows", rows as f64, format!("1 to {MAX_ROWS}"));
        }
        if !(0.0..=1e-3).contains(&self.height_sd) {
            return invalid("height_sd", self.height_sd, "0 to 0.001 m".into());
        }
        let mass_sd = self.mass_sd.unwrap_or(self.block.mass_sd());
        let max = self.block.mass() / 4.0;
        if !(0.0..=max).contains(&mass_sd) {
            return invalid("mass_sd", mass_sd, format!("0 to {max} kg, a quarter of the mass"));
        }
        Ok(mass_sd)
    }
}

impl Notation {
    /// Builds the tower of these blocks.
    ///
    /// # Errors
    /// When an option is out of its range.
    pub fn scene(&self, options: &TowerOptions) -> Result<Scene, SceneError> {
        build(&self.to_string(), &self.rows, options)
    }
}

/// Builds a full tower of `options.rows` rows.
///
/// # Errors
/// When an option is out of its range.
pub fn tower(options: &TowerOptions) -> Result<Scene, SceneError> {
    options.validate(options.rows as usize)?;
    let full = vec![[Cell::Present; 3]; options.rows as usize];
    let name = format!("tower-{}-{}-{}", options.block, options.rows, options.seed);
    build(&name, &full, options)
}

/// Builds the tower of a configuration such as `(010)-(010)-(011)`, bottom row first: 1 is a block,
/// 0 is none, `L` is a loose block.
///
/// # Errors
/// When the text does not follow the notation or an option is out of its range.
pub fn config(text: &str, options: &TowerOptions) -> Result<Scene, SceneError> {
    let notation: Notation = text.parse()?;
    notation.scene(options)
}

/// Builds the full tower of a map of loose blocks such as `(L00)-(00L)`, bottom row first: `L` is a
/// loose block and 0 an ordinary one.
///
/// # Errors
/// When the text does not follow the notation or an option is out of its range.
pub fn loose(text: &str, options: &TowerOptions) -> Result<Scene, SceneError> {
    Notation::from_loose_map(text)?.scene(options)
}

/// Builds `towers` full towers in a square field about the origin, row by row. Their seeds count up
/// from that of `options`.
///
/// # Errors
/// As [`tower`], or when the field has more blocks than a scene may have.
pub fn field(towers: u32, options: &TowerOptions) -> Result<Scene, SceneError> {
    let side = f64::from(towers).sqrt().ceil().max(1.0) as u32;
    let middle = 0.5 * f64::from(side - 1);
    let mut scene = tower(options)?;
    let mut blocks = Vec::new();
    for i in 0..towers {
        let seed = options.seed.wrapping_add(u64::from(i));
        let offset = [f64::from(i % side) - middle, f64::from(i / side) - middle];
        for mut block in tower(&TowerOptions { seed, ..options.clone() })?.blocks {
            block.id = blocks.len() as u32;
            for (x, offset) in block.pos.iter_mut().zip(offset) {
                *x += FIELD_PITCH * offset;
            }
            blocks.push(block);
        }
    }
    scene.name = format!("field-{towers}-{}-{}-{}", options.block, options.rows, options.seed);
    scene.blocks = blocks;
    scene.validate()?;
    Ok(scene)
}

fn build(name: &str, rows: &[[Cell; 3]], options: &TowerOptions) -> Result<Scene, SceneError> {
    let mass_sd = options.validate(rows.len())?;
    let [length, width, height] = options.block.size();
    let mut random = Random::new(options.seed);
    let mut blocks = Vec::new();
    let mut base = 0.0;
    for (r, row) in rows.iter().enumerate() {
        let mut tallest: f64 = 0.0;
        for (c, cell) in row.iter().enumerate() {
            // Absent blocks draw too, so that removing one leaves the others unchanged.
            let h = height + options.height_sd * random.clipped_normal(MAX_DEVIATION);
            let mass = options.block.mass() + mass_sd * random.clipped_normal(MAX_DEVIATION);
            let h = match cell {
                Cell::Absent => continue,
                Cell::Present => h,
                Cell::Loose => h - LOOSE_CLEARANCE,
            };
            let side = (c as f64 - 1.0) * options.block.pitch();
            let z = base + h / 2.0;
            let (pos, yaw) = if r % 2 == 0 { ([0.0, side, z], 0.0) } else { ([side, 0.0, z], FRAC_PI_2) };
            let id = blocks.len() as u32;
            blocks.push(Block { yaw, ..Block::new(id, [length, width, h], mass, pos) });
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
        stiffness: default_stiffness(),
        edge_radius: options.edge_radius,
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
