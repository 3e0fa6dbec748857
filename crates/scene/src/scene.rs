//! The scene: blocks on a floor and the constants of their contact. Plain data in SI units; z
//! points up and the floor is z = 0.

use serde::Serialize;

use crate::form::{Form, Springs};

/// Block: a uniform cuboid.
///
/// ```
/// use teeter_scene::{Block, BlockPreset};
///
/// let preset = BlockPreset::Dissertation;
/// let block = Block::new(0, preset.size(), preset.mass(), [0.0, 0.0, 0.009]);
/// assert_eq!(block.pos[2], 0.5 * block.size[2]); // on the floor
/// assert_eq!(block.rotation(), [0.0, 0.0, 0.0, 1.0]);
/// let sliding = Block { yaw: 0.1, velocity: [0.5, 0.0, 0.0], ..block };
/// assert!((sliding.rotation()[2] - 0.05).abs() < 1e-4);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Id, unique in the scene.
    pub id: u32,
    /// Full edge lengths along the block's own axes, m.
    pub size: [f64; 3],
    /// Mass, kg.
    pub mass: f64,
    /// Position of the centre, m.
    pub pos: [f64; 3],
    /// Rotation about the vertical through the centre, rad; zero where `orientation` is given.
    pub yaw: f64,
    /// Orientation as a unit quaternion x, y, z, w, for a block that does not stand upright.
    pub orientation: Option<[f64; 4]>,
    /// Velocity of the centre at the start, m/s.
    pub velocity: [f64; 3],
    /// Angular velocity at the start, in the world, rad/s.
    pub spin: [f64; 3],
    /// The block never moves, as the edge of a table.
    pub fixed: bool,
    /// Coefficient of static friction of the block; that of the scene where absent. A contact has
    /// the geometric mean of its two bodies.
    pub friction: Option<f64>,
}

impl Block {
    /// Returns an upright block at rest: edge lengths (m), mass (kg), and position of the centre
    /// (m).
    pub fn new(id: u32, size: [f64; 3], mass: f64, pos: [f64; 3]) -> Self {
        let (velocity, spin) = ([0.0; 3], [0.0; 3]);
        Self { id, size, mass, pos, yaw: 0.0, orientation: None, velocity, spin, fixed: false, friction: None }
    }

    /// Returns the length of the smallest edge, m.
    pub fn smallest_edge(&self) -> f64 {
        self.size.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns the orientation as a quaternion x, y, z, w of unit length.
    pub fn rotation(&self) -> [f64; 4] {
        let q = self.orientation.unwrap_or([0.0, 0.0, libm::sin(self.yaw / 2.0), libm::cos(self.yaw / 2.0)]);
        let inv = 1.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        q.map(|x| x * inv)
    }
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
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// Acceleration of gravity along -z, m/s².
    pub gravity: f64,
    /// Coefficient of static friction of every contact, including contacts with the floor.
    pub friction: f64,
    /// Coefficient of kinetic friction. Defaults to the static one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic_friction: Option<f64>,
    /// Ratio of the speeds after and before a flat impact, 0 to 1. The contact law covers a part of
    /// that range and clamps to it.
    pub restitution: f64,
    /// Normal stiffness of a contact of 26.8 mm by 26.8 mm, N/m, within
    /// [`STIFFNESS`](crate::STIFFNESS). Contact stiffness is proportional to the area, and the
    /// number of substeps to its square root.
    pub stiffness: f64,
    /// Radius of the edges of all blocks, m; 0 for sharp ones.
    #[serde(skip_serializing_if = "is_sharp")]
    pub edge_radius: f64,
    /// Form of the blocks.
    #[serde(skip_serializing_if = "is_rigid")]
    pub form: Form,
    /// Springs inside the blocks of form [`Form::Lattice`].
    #[serde(skip_serializing_if = "Springs::is_default")]
    pub springs: Springs,
    /// Blocks, in order of creation.
    pub blocks: Vec<Block>,
    /// Exact answer where it is known: `stable` or `unstable`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Error of every support edge that the label tolerates, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Direction in which the ground tilts, rad about z from x, in scenes that ask for the angle of
    /// collapse.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tilt_az: Option<f64>,
}

impl Scene {
    /// Stiffness of each spring inside the blocks, N/m.
    pub fn spring_stiffness(&self) -> f64 {
        self.springs.stiffness.unwrap_or(self.stiffness)
    }
}

fn is_sharp(radius: &f64) -> bool {
    radius.to_bits() == 0
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
