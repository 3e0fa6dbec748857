//! Choices of method that an ini file can set.

use serde::{Deserialize, Serialize};

use super::block::{EDGES, FACE_CORNERS, FACES, SPRING_CORNERS, SPRINGS};

/// Adds the list of an option's values and their names in an ini file. Names after `|` are other
/// names that are read.
macro_rules! names {
    ($type:ident { $($variant:ident = $name:literal $(| $alias:literal)*),+ }) => {
        impl $type {
            /// Names in an ini file.
            pub const NAMES: &'static [&'static str] = &[$($name),+];
            /// Other names that are read, each with the name that it stands for.
            pub const ALIASES: &'static [(&'static str, &'static str)] = &[$($(($alias, $name),)*)+];
            /// All values, in the order of their names.
            pub const ALL: [Self; Self::NAMES.len()] = [$(Self::$variant),+];

            /// Name in an ini file.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }

            /// Returns the value of that name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|value| value.name() == name)
            }
        }
    };
}

names!(Method { Euler = "euler", Multi = "multistep" | "multi", Midpoint = "midpoint", Rk4 = "rk4" });
names!(SpringSet { All = "all", Sides = "sides", Faces = "faces" });
names!(Order { Naive = "naive", BottomUp = "bottom-up", TopDown = "top-down" });
names!(Culling { None = "none" | "off", Blocks = "blocks", Boxes = "boxes", Planes = "planes" | "on" });
names!(Disabling { Off = "off", Listed = "listed", Rigid = "rigid-motion" | "rigid" });
names!(HandMode { Force = "force", Velocity = "velocity", Hybrid = "hybrid" });

/// Integrator (section 4.3.2).
///
/// ```
/// use teeter_dissertation::jenga3d::Method;
///
/// assert_eq!(Method::ALL.map(Method::name), ["euler", "multistep", "midpoint", "rk4"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Euler's method, one step over the whole time.
    Euler,
    /// Euler's method in several steps, the one that the simulator uses (section 5.5.2).
    #[serde(rename = "multistep", alias = "multi")]
    Multi,
    /// Midpoint method.
    Midpoint,
    /// Runge-Kutta method of the fourth order.
    Rk4,
}

/// Springs of a block (section 6.3 asks for fewer).
///
/// ```
/// use teeter_dissertation::jenga3d::SpringSet;
///
/// assert_eq!(SpringSet::ALL.map(|set| set.mask().count_ones()), [28, 24, 18]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SpringSet {
    /// Every pair of particles, as in section 4.1.
    All,
    /// Edges and both diagonals of each side, without those through the block.
    Sides,
    /// Sides of the twelve faces: the edges and one diagonal of each side.
    ///
    /// These are as few as hold eight particles in space, 3 x 8 - 6, and they do: a convex
    /// polyhedron of triangles is rigid (Dehn, 1916).
    Faces,
}

impl SpringSet {
    /// Mask of the springs of a block that exist, in their order.
    pub const fn mask(self) -> u32 {
        match self {
            SpringSet::All => ALL_SPRINGS,
            SpringSet::Sides => PARTIAL[0],
            SpringSet::Faces => PARTIAL[1],
        }
    }
}

/// Mask of all springs.
const ALL_SPRINGS: u32 = (1 << SPRINGS) - 1;

/// Masks of the springs in the sides, and of those that are sides of faces.
const PARTIAL: [u32; 2] = {
    let (mut sides, mut faces) = (0, 0);
    let mut n = 0;
    while n < SPRINGS {
        let [a, b] = SPRING_CORNERS[n];
        if (a ^ b).count_ones() < 3 {
            sides |= 1 << n;
        }
        if n < EDGES || is_third_side(a, b) {
            faces |= 1 << n;
        }
        n += 1;
    }
    [sides, faces]
};

/// Returns true for the diagonal that closes a face.
const fn is_third_side(a: usize, b: usize) -> bool {
    let mut face = 0;
    while face < FACES {
        let [first, _, third] = FACE_CORNERS[face];
        if (first == a && third == b) || (first == b && third == a) {
            return true;
        }
        face += 1;
    }
    false
}

/// Order of the pairs of blocks in collision detection (section 3.3.4).
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Order};
///
/// assert_eq!(Constants::from_ini("[Contact]\norder = top-down").unwrap().order, Order::TopDown);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Order of creation.
    Naive,
    /// Lowest blocks first.
    BottomUp,
    /// Highest blocks first.
    TopDown,
}

/// Tests before the exact one; each level includes those before it.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Culling};
///
/// assert_eq!(Constants::default().culling, Culling::Planes);
/// assert!(Culling::Blocks < Culling::Boxes);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Culling {
    /// No test: the roots of every cubic are computed.
    None,
    /// Boxes of blocks.
    Blocks,
    /// Boxes of faces, edges and particles.
    Boxes,
    /// Sides of a plane or a line: a point that cannot pass a face, an edge that cannot pass
    /// another.
    Planes,
}

/// Disabling of blocks (section 4.7).
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Disabling};
///
/// assert_eq!(Constants::default().disabling, Disabling::Listed);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Disabling {
    /// No disabling.
    Off,
    /// Appendix 2.5: by the distances that the particles move in the one step.
    Listed,
    /// By the rigid motion of the block over a time. Disabled blocks stay disabled, take no steps
    /// and are not tested against each other.
    #[serde(rename = "rigid-motion", alias = "rigid")]
    Rigid,
}

/// Method of the hand (sections 4.8 and 5.6).
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, HandMode};
///
/// assert_eq!(Constants::default().hand, HandMode::Hybrid);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandMode {
    /// Force proportional to the distance: right against a tower, and in the air a spring on which
    /// the block swings.
    Force,
    /// Velocity written to the block: smooth in the air, and stronger than any tower.
    Velocity,
    /// Force while the block touches anything, velocity in the air.
    Hybrid,
}
