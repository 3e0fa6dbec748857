//! Warnings: where a world is not quite that of its scene.

use std::fmt;

use teeter_scene::{Scene, overlap};

use crate::restitution::restitution_range;
use crate::world::World;

/// Overlap that is rounding of a file's numbers, m.
const ROUNDING: f64 = 1e-6;

/// Difference between a world and its scene, or a reason to doubt the results.
///
/// ```
/// use teeter_physics::{Params, Warning, World};
///
/// let mut scene = teeter_scene::named("block").unwrap();
/// assert!(World::new(&scene, Params::default())?.warnings().is_empty());
/// scene.restitution = 0.99;
/// let warnings = World::new(&scene, Params::default())?.warnings();
/// assert!(matches!(warnings[..], [Warning::Restitution { value: 0.99, .. }]));
/// assert_eq!(
///     warnings[0].to_string(),
///     "`restitution` is 0.99, contacts have 0.96: they can have 0 to 0.96"
/// );
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Coefficient of restitution that the contact law cannot have.
    Restitution {
        /// Coefficient of the scene.
        value: f64,
        /// Nearest coefficient, which contacts have.
        used: f64,
    },
    /// Blocks that begin inside each other, deeper than the weight of the scene would press them.
    Overlap {
        /// Number of pairs of blocks.
        pairs: usize,
        /// Maximum depth, m.
        depth: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Restitution { value, used } => {
                let (min, max) = restitution_range();
                write!(f, "`restitution` is {value}, contacts have {used:.2}: they can have {min} to {max:.2}")
            }
            Self::Overlap { pairs, depth } => {
                let pairs = if *pairs == 1 {
                    "1 pair of blocks overlaps".into()
                } else {
                    format!("{pairs} pairs of blocks overlap")
                };
                write!(f, "{pairs}, by up to {:.4} mm", 1e3 * depth)
            }
        }
    }
}

impl World {
    /// Returns the warnings about the scene that the world was built from; empty where the world is
    /// just that scene.
    pub fn warnings(&self) -> Vec<Warning> {
        Warning::all_of(self.scene())
    }
}

impl Warning {
    /// Returns the warnings about a scene, without building a world.
    pub fn all_of(scene: &Scene) -> Vec<Self> {
        let mut warnings = Vec::new();
        let (min, max) = restitution_range();
        let used = scene.restitution.clamp(min, max);
        if used != scene.restitution {
            warnings.push(Self::Restitution { value: scene.restitution, used });
        }
        let weight: f64 =
            scene.blocks.iter().filter(|block| !block.fixed).map(|block| block.mass * scene.gravity).sum();
        let overlaps = overlap::pairs(scene, f64::max(ROUNDING, weight / scene.stiffness));
        if !overlaps.is_empty() {
            let depth = overlaps.iter().map(|overlap| overlap.depth).fold(0.0, f64::max);
            warnings.push(Self::Overlap { pairs: overlaps.len(), depth });
        }
        warnings
    }
}
