//! Springs within a block: their constants, and the pairs of particles that they join.

use teeter_scene::{Scene, Springs as SceneSprings};

use crate::constants::STRAIN_INERTIA;

/// Springs of a block: one for each pair of its particles.
pub const SPRINGS: usize = 28;
/// Kinds of spring, by the axes that they span, a bit each: 1, 2 and 4 are edges, 7 is a diagonal
/// of the block.
pub const KINDS: usize = 7;
/// Part of the stability limit of the explicit step, 4, that the springs may use.
const SPRING_STEP_LIMIT: f64 = 1.2;

/// Constants of the springs within all blocks of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Springs {
    /// Stiffness of each spring, N/m.
    pub stiffness: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Distance of the particles from the centre along each axis, over half the edge.
    pub inset: f64,
}

impl Springs {
    /// Springs of a scene.
    pub fn new(scene: &Scene) -> Self {
        let SceneSprings { damping, particles, .. } = scene.springs;
        Self { stiffness: scene.spring_stiffness(), damping, inset: particles.inset() }
    }

    /// Damping of each spring of a block of `mass` (kg), N s/m: c = 2 zeta sqrt(k m / 8), with m
    /// multiplied by [`STRAIN_INERTIA`].
    pub fn damper(&self, mass: f64) -> f64 {
        2.0 * self.damping * (self.stiffness * STRAIN_INERTIA * mass / 8.0).sqrt()
    }

    /// Longest substep for a block of `mass` (kg), s.
    ///
    /// Springs join every pair of particles. The highest natural frequency is at most that
    /// of springs along one line, ω² = 8 k / (m / 8), and a mode is stable while h² ω² + 2 h c ω² /
    /// k < 4.
    pub fn max_step(&self, mass: f64) -> f64 {
        let inv_mass = 64.0 / (STRAIN_INERTIA * mass);
        let (spring, damper) = (inv_mass * self.stiffness, 2.0 * inv_mass * self.damper(mass));
        ((damper * damper + 4.0 * spring * SPRING_STEP_LIMIT).sqrt() - damper) / (2.0 * spring)
    }
}

/// Particles that spring `n` joins, lower one first, and its kind.
pub const fn ends(n: usize) -> (usize, usize, usize) {
    let (mut i, mut first) = (0, 0);
    while n >= first + 7 - i {
        first += 7 - i;
        i += 1;
    }
    let j = i + 1 + n - first;
    (i, j, i ^ j)
}
