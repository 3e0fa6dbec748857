//! The scene: blocks on a floor and the constants of their contact. Plain data in SI units; z
//! points up and the floor is z = 0.

use serde::{Deserialize, Serialize};

use crate::form::{Form, Springs};

/// Block: a uniform cuboid, upright, turned about the vertical by `yaw`.
///
/// ```
/// use teeter_scene::{Block, BlockPreset};
///
/// let preset = BlockPreset::Dissertation;
/// let block = Block { id: 0, size: preset.size(), mass: preset.mass(), pos: [0.0, 0.0, 0.009], yaw: 0.0 };
/// assert_eq!(block.pos[2], 0.5 * block.size[2]); // on the floor
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Id, unique in the scene.
    pub id: u32,
    /// Full edge lengths along the block's own axes, m.
    pub size: [f64; 3],
    /// Mass, kg.
    pub mass: f64,
    /// Position of the centre, m.
    pub pos: [f64; 3],
    /// Rotation about the vertical through the centre, rad.
    #[serde(default)]
    pub yaw: f64,
}

/// Blocks on a floor, and the constants of their contact.
///
/// ```
/// use teeter_scene::{Scene, TowerOptions, tower};
///
/// let scene = tower(&TowerOptions::default())?;
/// assert_eq!(Scene::from_json(&scene.to_json())?, scene);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// Acceleration of gravity along -z, m/s².
    #[serde(default = "standard_gravity")]
    pub gravity: f64,
    /// Coefficient of static friction of every contact, including contacts with the floor.
    pub friction: f64,
    /// Coefficient of kinetic friction. Defaults to the static one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetic_friction: Option<f64>,
    /// Ratio of the speeds after and before a flat impact, 0 to 1. The contact law covers a part of
    /// that range and clamps to it.
    #[serde(default)]
    pub restitution: f64,
    /// Normal stiffness of a contact of 26.8 mm by 26.8 mm, N/m, within
    /// [`STIFFNESS`](crate::STIFFNESS). Contact stiffness is proportional to the area, and the
    /// number of substeps to its square root.
    #[serde(default = "default_stiffness")]
    pub stiffness: f64,
    /// Form of the blocks.
    #[serde(default, skip_serializing_if = "is_rigid")]
    pub form: Form,
    /// Springs inside the blocks of form [`Form::Lattice`].
    #[serde(default, skip_serializing_if = "Springs::is_default")]
    pub springs: Springs,
    /// Blocks, in order of creation.
    pub blocks: Vec<Block>,
    /// Exact answer where it is known: `stable` or `unstable`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Error of every support edge that the label tolerates, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Direction in which the ground tilts, rad about z from x, in scenes that ask for the angle of
    /// collapse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_az: Option<f64>,
}

impl Scene {
    /// Stiffness of each spring inside the blocks, N/m.
    pub fn spring_stiffness(&self) -> f64 {
        self.springs.stiffness.unwrap_or(self.stiffness)
    }
}

fn is_rigid(form: &Form) -> bool {
    *form == Form::Rigid
}

/// Default gravity, m/s².
pub fn standard_gravity() -> f64 {
    9.81
}

/// Default contact stiffness, N/m: the top of a full tower sinks by some hundredths of a
/// millimetre.
pub fn default_stiffness() -> f64 {
    1e6
}
