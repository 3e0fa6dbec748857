//! A scene: what stands where, and what it is made of. Plain data in SI units; z is up, the floor is z = 0.

use serde::{Deserialize, Serialize};

use crate::form::{Form, Springs};

/// One block: a uniform cuboid, upright, turned about the vertical by `yaw`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// A name for the block that is unique in its scene.
    pub id: u32,
    /// Full edge lengths along the block's own axes, m.
    pub size: [f64; 3],
    /// Mass, kg.
    pub mass: f64,
    /// Centre, m.
    pub pos: [f64; 3],
    /// Turn about the vertical through the centre, rad.
    #[serde(default)]
    pub yaw: f64,
}

/// Blocks on a floor, and the constants of their contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// What the scene is called.
    pub name: String,
    /// Acceleration of gravity along -z, m/s².
    #[serde(default = "standard_gravity")]
    pub gravity: f64,
    /// Coefficient of static friction of every contact, the floor's included.
    pub friction: f64,
    /// Coefficient of kinetic friction; the static one where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetic_friction: Option<f64>,
    /// Ratio of the speeds after and before a flat impact, 0 to 1. The contact law covers a part of that range and takes the nearest it has.
    #[serde(default)]
    pub restitution: f64,
    /// Normal stiffness of a contact of 26.8 mm by 26.8 mm, N/m, within [`STIFFNESS`](crate::STIFFNESS); stiffness follows the area. What is
    /// stiffer gives less and takes more steps: their number grows with the square root.
    #[serde(default = "usual_stiffness")]
    pub stiffness: f64,
    /// What the blocks are.
    #[serde(default, skip_serializing_if = "is_rigid")]
    pub form: Form,
    /// The springs within them, where they have any.
    #[serde(default, skip_serializing_if = "Springs::is_usual")]
    pub springs: Springs,
    /// The blocks, in order of creation.
    pub blocks: Vec<Block>,
    /// The exact answer where it is known: `stable` or `unstable`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// By how much every support edge may be wrong before the label changes, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Direction in which the ground is tilted, rad about z from x; present in scenes that ask for the angle of collapse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_az: Option<f64>,
}

impl Scene {
    /// Stiffness of each spring within the blocks, N/m.
    pub fn spring_stiffness(&self) -> f64 {
        self.springs.stiffness.unwrap_or(self.stiffness)
    }
}

fn is_rigid(form: &Form) -> bool {
    *form == Form::Rigid
}

/// Gravity of the scenes that do not name their own, m/s².
pub fn standard_gravity() -> f64 {
    9.81
}

/// Stiffness of the scenes that do not name their own, N/m: the top of a full tower sinks by some hundredths of a millimetre.
pub fn usual_stiffness() -> f64 {
    1e6
}
