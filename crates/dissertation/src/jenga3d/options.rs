//! Choices of method that an ini file can set.

use serde::{Deserialize, Serialize};

/// Integrator (section 4.3.2).
///
/// ```
/// use teeter_dissertation::jenga3d::Method;
///
/// assert_eq!(Method::ALL.map(Method::name), ["euler", "multi", "midpoint", "rk4"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Euler's method, one step over the whole time.
    Euler,
    /// Euler's method in several steps, the one that the simulator uses (section 5.5.2).
    Multi,
    /// Midpoint method.
    Midpoint,
    /// Runge-Kutta method of the fourth order.
    Rk4,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 4] = [Method::Euler, Method::Multi, Method::Midpoint, Method::Rk4];

    /// Name in an ini file.
    pub fn name(self) -> &'static str {
        match self {
            Method::Euler => "euler",
            Method::Multi => "multi",
            Method::Midpoint => "midpoint",
            Method::Rk4 => "rk4",
        }
    }
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
