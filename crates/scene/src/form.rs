//! Block forms: rigid bodies, or particles joined by springs.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::SceneError;

/// Model of a block in the simulation. Both forms share one contact law.
///
/// ```
/// use teeter_scene::Form;
///
/// assert_eq!("lattice".parse::<Form>()?, Form::Lattice);
/// assert_eq!(Form::default().to_string(), "rigid");
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Rigid body, the limit of infinitely stiff springs.
    #[default]
    Rigid,
    /// Eight particles and 28 springs, as in the dissertation.
    Lattice,
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Form::Rigid => "rigid",
            Form::Lattice => "lattice",
        })
    }
}

impl FromStr for Form {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        match text {
            "rigid" => Ok(Form::Rigid),
            "lattice" => Ok(Form::Lattice),
            _ => Err(SceneError::UnknownForm),
        }
    }
}

/// Arrangement of the eight particles of a lattice block.
///
/// ```
/// use teeter_scene::Particles;
///
/// assert_eq!(Particles::Corners.inset(), 1.0);
/// assert_eq!(Particles::Inside.inset(), 1.0 / 3f64.sqrt());
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Particles {
    /// At 1/√3 of the half edges from the centre: the moments of inertia of a uniform cuboid.
    #[default]
    Inside,
    /// At the corners, as in the dissertation: three times the moments of inertia.
    Corners,
}

impl Particles {
    /// Distance of the particles from the centre along each axis, over the half edge.
    pub fn inset(self) -> f64 {
        match self {
            // 1/√3, the Gauss points of a line.
            Particles::Inside => 0.577_350_269_189_625_8,
            Particles::Corners => 1.0,
        }
    }
}

impl FromStr for Particles {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        match text {
            "inside" => Ok(Particles::Inside),
            "corners" => Ok(Particles::Corners),
            _ => Err(SceneError::UnknownParticles),
        }
    }
}

/// Spring stiffness of wooden blocks, N/m.
///
/// It makes a block of the dissertation's size as stiff across the grain as a modulus of 0.5 GPa,
/// that of softwoods and alder (a tenth of the modulus along the grain; Wood Handbook, Forest
/// Products Laboratory 2010, tables 5-1 and 5-3). Springs of stiffness k press with 5.6 k between
/// particles that are 1/√3 as far apart as the faces, so 5.6 k / 3 = E A / h.
pub const WOOD_SPRINGS: f64 = 3e7;

/// Springs inside the blocks of a scene whose form is [`Form::Lattice`].
///
/// ```
/// use teeter_scene::{Springs, WOOD_SPRINGS};
///
/// let wood = Springs { stiffness: Some(WOOD_SPRINGS), ..Springs::default() };
/// assert_eq!(wood.damping, 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Springs {
    /// Stiffness of each spring, N/m, within [`SPRING_STIFFNESS`](crate::SPRING_STIFFNESS).
    /// Defaults to the stiffness of the contacts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
    /// Damping ratio of a spring between a particle and a wall, within
    /// [`SPRING_DAMPING`](crate::SPRING_DAMPING).
    pub damping: f64,
    /// Arrangement of the particles.
    pub particles: Particles,
}

impl Default for Springs {
    fn default() -> Self {
        Self { stiffness: None, damping: 0.1, particles: Particles::default() }
    }
}

impl Springs {
    /// Returns true if every field has its default, so that JSON may omit them.
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
