//! What blocks are in the simulation: rigid, or particles held together by springs.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// What blocks are in the simulation. Both meet each other by the same contact law.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Rigid bodies: the limit of springs that do not give.
    #[default]
    Rigid,
    /// Eight particles and 28 springs a block, as in the dissertation.
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
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "rigid" => Ok(Form::Rigid),
            "lattice" => Ok(Form::Lattice),
            _ => Err("expected rigid or lattice".to_owned()),
        }
    }
}

/// Where a block of springs has its particles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Particles {
    /// At 1/√3 of the half edges from the centre: the moments of inertia are those of a uniform cuboid.
    #[default]
    Inside,
    /// At the corners, as in the dissertation: the moments of inertia are three times as large.
    Corners,
}

impl Particles {
    /// Distance of the particles from the centre along each axis, over half the edge.
    pub fn place(self) -> f64 {
        match self {
            // 1/√3, the Gauss points of a line
            Particles::Inside => 0.577_350_269_189_625_8,
            Particles::Corners => 1.0,
        }
    }
}

impl FromStr for Particles {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "inside" => Ok(Particles::Inside),
            "corners" => Ok(Particles::Corners),
            _ => Err("expected inside or corners".to_owned()),
        }
    }
}

/// Stiffness of the springs of a block of wood, N/m: what makes a block of the dissertation's size as stiff across the grain as 0.5 GPa do, the
/// modulus of softwoods and alder there (a tenth of that along the grain; Wood Handbook, Forest Products Laboratory 2010, tables 5-1 and 5-3).
/// Springs of k press with 5.6 k between particles that are 1/√3 as far apart as the faces, so with 5.6 k / 3 = E A / h.
pub const WOOD_SPRINGS: f64 = 3e7;

/// The springs within the blocks of a scene whose form is [`Form::Lattice`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Springs {
    /// Stiffness of each spring, N/m, within [`SPRING_STIFFNESS`](crate::SPRING_STIFFNESS); that of the contacts where absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
    /// Damping over the critical damping of a spring between a particle and a wall, within [`SPRING_DAMPING`](crate::SPRING_DAMPING).
    pub damping: f64,
    /// Where the particles are.
    pub particles: Particles,
}

impl Default for Springs {
    fn default() -> Self {
        Self { stiffness: None, damping: 0.1, particles: Particles::default() }
    }
}

impl Springs {
    /// Whether nothing was said of them.
    pub(crate) fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}
