//! Block presets.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::SceneError;

/// Preset of a block's size, mass and spacing.
///
/// ```
/// use teeter_scene::BlockPreset;
///
/// let preset: BlockPreset = "official".parse()?;
/// assert_eq!(preset.size(), [0.075, 0.025, 0.015]);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BlockPreset {
    /// 81 x 26.8 x 18 mm, 19.6 g, 0.3 mm between the three of a row, after the dissertation.
    ///
    /// Its Table 3.1 has ten blocks, to a millimetre, with the means 81, 26.7 and 18.2 mm, and 19.6
    /// g. Length and mass are the means. The height is that of eight of the ten: two of 19 mm make
    /// the mean. The width is within the rounding of its mean, and chosen so that three blocks and
    /// two gaps are exactly as wide as a block is long.
    #[default]
    Dissertation,
    /// 75 x 25 x 15 mm, the size that the game is sold in, at the same density: 14.1 g.
    ///
    /// The width is a third of the length, which leaves no gap between three blocks. They are 0.2
    /// mm apart instead, so a row is 75.4 mm wide and overhangs the blocks below by 0.2 mm a side.
    Official,
}

impl BlockPreset {
    /// All presets.
    pub const ALL: [BlockPreset; 2] = [BlockPreset::Dissertation, BlockPreset::Official];

    /// Length, width and height, m.
    pub fn size(self) -> [f64; 3] {
        match self {
            BlockPreset::Dissertation => [0.081, 0.0268, 0.018],
            BlockPreset::Official => [0.075, 0.025, 0.015],
        }
    }

    /// Mean mass, kg.
    pub fn mass(self) -> f64 {
        match self {
            BlockPreset::Dissertation => 0.0196,
            BlockPreset::Official => 0.0141,
        }
    }

    /// Standard deviation of the mass, kg: that of the dissertation's Table 3.1, scaled for the
    /// others.
    pub fn mass_sd(self) -> f64 {
        match self {
            BlockPreset::Dissertation => 0.00185,
            BlockPreset::Official => 0.00185 * (0.0141 / 0.0196),
        }
    }

    /// Distance between the centres of adjacent blocks in a row, m.
    pub fn pitch(self) -> f64 {
        match self {
            BlockPreset::Dissertation => 0.0271,
            BlockPreset::Official => 0.0252,
        }
    }

    /// Name of the preset.
    pub fn name(self) -> &'static str {
        match self {
            BlockPreset::Dissertation => "dissertation",
            BlockPreset::Official => "official",
        }
    }
}

impl fmt::Display for BlockPreset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for BlockPreset {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        Self::ALL.into_iter().find(|p| p.name() == text).ok_or_else(|| SceneError::UnknownPreset(text.to_owned()))
    }
}
