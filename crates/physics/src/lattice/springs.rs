//! The springs within a block, and the law by which they pull.

use teeter_scene::{Scene, Springs as SceneSprings};

use crate::simd::lanes::Lanes;

/// Springs of a block: as many as there are pairs of its particles.
pub const SPRINGS: usize = 28;
/// Kinds of spring by the axes that they go along, a bit each: 1, 2 and 4 are edges, 7 is a diagonal of the block.
pub const KINDS: usize = 7;
/// How much harder it is to accelerate the straining of a block than its particles alone make it: forces accelerate a block as a whole as they
/// should, and what strains it by one over this. Statics and the motion of the whole stay exact, and a block swings at a third of its own rate, which is
/// beyond hearing for wood. Without it a surface would give way so easily, by 10 / m at a corner against 6 / m where blocks are rigid, that it took
/// substeps of 0.6 times the length.
pub const STRAIN_INERTIA: f64 = 8.0;
/// Part of the stability limit of the explicit step, 4, that the springs may use.
const STEP_LIMIT: f64 = 1.2;

/// The springs within all blocks of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Springs {
    /// Stiffness of each, N/m.
    pub stiffness: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Distance of the particles from the centre along each axis, over half the edge.
    pub place: f64,
}

impl Springs {
    pub fn new(scene: &Scene) -> Self {
        let SceneSprings { damping, particles, .. } = scene.springs;
        Self { stiffness: scene.spring_stiffness(), damping, place: particles.inset() }
    }

    /// Damping of each spring of a block of `mass` (kg), N s/m: c = 2 zeta sqrt(k m / 8), m with [`STRAIN_INERTIA`].
    pub fn damper(&self, mass: f64) -> f64 {
        2.0 * self.damping * (self.stiffness * STRAIN_INERTIA * mass / 8.0).sqrt()
    }

    /// The longest substep for a block of `mass` (kg), s. Each particle has a spring to each other one; the fastest that such a block can swing
    /// is as if all of them went along one line, ω² = 8 k / (m / 8), and a mode is stable while h² ω² + 2 h c ω² / k < 4.
    pub fn longest_step(&self, mass: f64) -> f64 {
        let ease = 64.0 / (STRAIN_INERTIA * mass);
        let (spring, damper) = (ease * self.stiffness, 2.0 * ease * self.damper(mass));
        ((damper * damper + 4.0 * spring * STEP_LIMIT).sqrt() - damper) / (2.0 * spring)
    }
}

/// A spring of each lane between two particles, displaced by `a` and `b` from their places, `rest` apart from the first to the second. Returns its
/// force on the first, and its strain, which the next call is given as `before`.
///
/// The strain is (L² − L₀²) / 2 = (rest + d / 2) · d with d = b − a: no root, no cancellation, and exact for any turn. The force is
/// along the spring, (stiffness · strain − damping · before) times its length; with stiffness k (1 + β) / L₀² and damping k β / L₀²,
/// β = c / (k h), that is Eq. 4.1 to 4.3 of the dissertation to first order of the strain.
#[inline(always)]
pub fn spring<L: Lanes>(a: &[L; 3], b: &[L; 3], rest: &[L; 3], stiffness: L, damping: L, before: L) -> ([L; 3], L) {
    let half = L::splat_f64(0.5);
    let d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let strain = (rest[0] + half * d[0]) * d[0] + (rest[1] + half * d[1]) * d[1] + (rest[2] + half * d[2]) * d[2];
    let pull = stiffness * strain - damping * before;
    ([(rest[0] + d[0]) * pull, (rest[1] + d[1]) * pull, (rest[2] + d[2]) * pull], strain)
}

/// The particles that spring `n` joins, lower one first, and its kind.
pub const fn ends(n: usize) -> (usize, usize, usize) {
    let (mut i, mut first) = (0, 0);
    while n >= first + 7 - i {
        first += 7 - i;
        i += 1;
    }
    let j = i + 1 + n - first;
    (i, j, i ^ j)
}
