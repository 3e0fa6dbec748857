//! Mechanism: the motion in which a tower begins to move when a block is pulled.
//!
//! With the normal forces of rest, the motion at the smallest force that starts it is the one for
//! which friction dissipates the minimum power: over velocities in the plane,
//!
//! ```text
//! F = min sum mu N_i |v_i|   with the pulled block at unit speed along its axis
//! ```
//!
//! This is the dual of the limit analysis of [`RigidTower::turning_force`] and gives the motion
//! besides. A patch may have any number of points: its four corners, or a mesh under a pressure
//! that varies linearly, like that of springs under a flat face. |v| is rounded near 0, by less and
//! less; each rounded problem is smooth and convex, for Newton's method with a line search.

use glam::{DVec2, DVec3};
use teeter_scene::Scene;

use crate::cholesky::solve;
use crate::limit_analysis::RigidTower;
use crate::plan::{center, long_axis};

/// Speed below which |v| is rounded over that of the pull: first and last value, each a quarter of
/// the one before.
const ROUNDING: (f64, f64) = (0.3, 1e-5);
/// Largest number of Newton steps at one rounding.
const MAX_STEPS: usize = 60;
/// Unit of length of the spins, m: about that of the lever arms.
const UNIT: f64 = 3e-2;
/// Weight of the constraint on the pulled block's speed over the sum of all friction: the speed is
/// short of its target by 1e-7.
const PENALTY: f64 = 1e7;

/// Distribution of the friction of a patch.
///
/// ```
/// # use teeter_scene::{TowerOptions, config};
/// # use teeter_study::{RigidTower, Spread, mechanism};
/// let scene = config("(101)-(010)", &TowerOptions::exact()).unwrap();
/// let tower = RigidTower::new(&scene)?;
/// let force = |spread| mechanism(&tower, 0, spread).unwrap().force_n;
/// let mesh = force(Spread::Mesh(4));
/// // friction at the corners overestimates the resistance to turning
/// assert!(force(Spread::Corners) > 1.05 * mesh);
/// assert!((force(Spread::ScaledCorners) / mesh - 1.0).abs() < 0.01);
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// At the corners.
    Corners,
    /// At the corners, drawn towards the centre of pressure by the ratio of [`crate::torsion`]: the
    /// distribution of the engine.
    ScaledCorners,
    /// At the centres of n by n cells.
    Mesh(usize),
}

/// Motion at its start.
///
/// ```
/// # use teeter_scene::{TowerOptions, config};
/// # use teeter_study::{RigidTower, Spread, mechanism};
/// let scene = config("(101)-(010)", &TowerOptions::exact()).unwrap();
/// let tower = RigidTower::new(&scene)?;
/// let motion = mechanism(&tower, 0, Spread::ScaledCorners).unwrap();
/// // one end of the block across goes along: it turns, with less force than straight sliding
/// assert!((motion.velocities[0].x - 1.0).abs() < 1e-6 && motion.velocities[2].z > 10.0);
/// assert!(motion.force_n < 0.9 * tower.straight_force(0));
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// Force that starts it, N.
    pub force_n: f64,
    /// Velocity along x and y and spin of each block, for a pull of 1 m/s: 1, 1, rad/m.
    pub velocities: Vec<DVec3>,
}

/// Returns the motion in which a tower begins to move when a block is pulled along its long axis; a
/// pull against the axis reverses it. None where the search does not converge.
///
/// # Panics
/// When the tower has no block of that index.
///
/// ```
/// use teeter_study::{RigidTower, Spread, mechanism};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let tower = RigidTower::new(&scene)?;
/// let motion = mechanism(&tower, 3, Spread::ScaledCorners).unwrap();
/// assert!(motion.velocities[2].x.abs() < 1e-2 && (motion.velocities[9].x - 1.0).abs() < 1e-2);
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
pub fn mechanism(tower: &RigidTower, block: usize, spread: Spread) -> Option<Mechanism> {
    let power = FrictionPower::new(tower, block, spread);
    // the pulled block alone moves
    let mut u = vec![0.0; 3 * power.scene.blocks.len()];
    (u[3 * block], u[3 * block + 1]) = (power.axis.x, power.axis.y);
    let mut rounding = ROUNDING.0;
    loop {
        power.minimize(rounding, &mut u)?;
        if rounding <= ROUNDING.1 {
            break;
        }
        rounding = (0.25 * rounding).max(ROUNDING.1);
    }
    let force_n = power.points.iter().map(|p| p.max_force * p.slip(power.scene, &u).length()).sum();
    let velocities = u.chunks_exact(3).map(|u| DVec3::new(u[0], u[1], u[2] / UNIT)).collect();
    Some(Mechanism { force_n, velocities })
}

/// Power of friction, with a penalty on the speed of the pulled block.
struct FrictionPower<'a> {
    scene: &'a Scene,
    points: Vec<FrictionPoint>,
    /// Pulled block, and its long axis.
    block: usize,
    axis: DVec2,
    penalty: f64,
}

impl<'a> FrictionPower<'a> {
    fn new(tower: &RigidTower<'a>, block: usize, spread: Spread) -> Self {
        let scene = tower.scene();
        let points = friction_points(tower, spread);
        let total: f64 = points.iter().map(|p| p.max_force).sum();
        Self { scene, points, block, axis: long_axis(&scene.blocks[block]), penalty: PENALTY * total }
    }

    /// Speed of the pulled block along its axis, less 1.
    fn excess_speed(&self, u: &[f64]) -> f64 {
        self.axis.x * u[3 * self.block] + self.axis.y * u[3 * self.block + 1] - 1.0
    }

    /// Rounded power at `u`.
    fn value(&self, u: &[f64], rounding: f64) -> f64 {
        let excess = self.excess_speed(u);
        let power =
            |p: &FrictionPoint| p.max_force * (p.slip(self.scene, u).length_squared() + rounding * rounding).sqrt();
        0.5 * self.penalty * excess * excess + self.points.iter().map(power).sum::<f64>()
    }

    /// Gradient and matrix of second derivatives of the rounded power at `u`.
    fn derivatives(&self, u: &[f64], rounding: f64) -> (Vec<f64>, Vec<f64>) {
        let n = u.len();
        let (mut gradient, mut matrix) = (vec![0.0; n], vec![0.0; n * n]);
        let excess = self.excess_speed(u);
        let pulled = [(3 * self.block, self.axis.x), (3 * self.block + 1, self.axis.y)];
        for (i, a) in pulled {
            gradient[i] += self.penalty * excess * a;
            for (j, b) in pulled {
                matrix[i * n + j] += self.penalty * a * b;
            }
        }
        for point in &self.points {
            let slip = point.slip(self.scene, u);
            let speed = (slip.length_squared() + rounding * rounding).sqrt();
            let (weight, direction) = (point.max_force / speed, slip / speed);
            let coefficients = point.coefficients(self.scene);
            for &(i, a) in &coefficients {
                gradient[i] += weight * slip.dot(a);
                for &(j, b) in &coefficients {
                    matrix[i * n + j] += weight * (a.dot(b) - direction.dot(a) * direction.dot(b));
                }
            }
        }
        // unknowns without friction keep a step
        let regularisation = 1e-9 * self.penalty / PENALTY;
        (0..n).for_each(|i| matrix[i * n + i] += regularisation);
        (gradient, matrix)
    }

    /// Moves `u` to the minimum of the rounded power; none where a step has no solution.
    fn minimize(&self, rounding: f64, u: &mut [f64]) -> Option<()> {
        for _ in 0..MAX_STEPS {
            let (gradient, matrix) = self.derivatives(u, rounding);
            let step = solve(matrix, gradient.clone())?;
            let slope: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
            let before = self.value(u, rounding);
            if slope < 1e-11 * before {
                return Some(());
            }
            let mut share = 1.0;
            loop {
                let next: Vec<f64> = u.iter().zip(&step).map(|(u, s)| u - share * s).collect();
                if self.value(&next, rounding) <= before - 1e-4 * share * slope || share < 1e-9 {
                    u.copy_from_slice(&next);
                    break;
                }
                share *= 0.5;
            }
        }
        Some(())
    }
}

/// Point at which friction acts.
struct FrictionPoint {
    below: Option<usize>,
    above: usize,
    position: DVec2,
    /// Largest friction, N.
    max_force: f64,
}

impl FrictionPoint {
    /// Unknowns that move it, with the slip of each.
    fn coefficients(&self, scene: &Scene) -> Vec<(usize, DVec2)> {
        let of = |body: usize, sign: f64| {
            let arm = (self.position - center(&scene.blocks[body])) / UNIT;
            [(3 * body, DVec2::X * sign), (3 * body + 1, DVec2::Y * sign), (3 * body + 2, arm.perp() * sign)]
        };
        let mut coefficients = of(self.above, 1.0).to_vec();
        coefficients.extend(self.below.iter().flat_map(|&b| of(b, -1.0)));
        coefficients
    }

    /// Velocity of the upper side relative to the lower one.
    fn slip(&self, scene: &Scene, u: &[f64]) -> DVec2 {
        let of = |body: usize| {
            let arm = (self.position - center(&scene.blocks[body])) / UNIT;
            DVec2::new(u[3 * body], u[3 * body + 1]) + arm.perp() * u[3 * body + 2]
        };
        of(self.above) - self.below.map_or(DVec2::ZERO, of)
    }
}

/// Points at which the friction of a tower acts.
fn friction_points(tower: &RigidTower, spread: Spread) -> Vec<FrictionPoint> {
    let friction = tower.scene().friction;
    let mut points = Vec::new();
    for patch in tower.patches() {
        let total: f64 = patch.corners.iter().map(|c| c.1).sum();
        if total < 1e-9 {
            continue;
        }
        let (below, above) = (patch.below, patch.above);
        let mut add =
            |position, force: f64| points.push(FrictionPoint { below, above, position, max_force: friction * force });
        let center: DVec2 = patch.corners.iter().map(|&(position, force)| position * force).sum::<DVec2>() / total;
        match spread {
            Spread::Corners => patch.corners.iter().for_each(|&(position, force)| add(position, force)),
            Spread::ScaledCorners => (patch.corners.iter())
                .for_each(|&(position, force)| add(center + (position - center) * patch.torsion_ratio, force)),
            Spread::Mesh(cells) => patch.mesh(cells).into_iter().for_each(|(position, force)| add(position, force)),
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use teeter_scene::{TowerOptions, named, tower};

    #[test]
    fn a_column_does_not_turn() {
        let scene = named("column").unwrap();
        let rigid = RigidTower::new(&scene).unwrap();
        for spread in [Spread::Corners, Spread::ScaledCorners, Spread::Mesh(6)] {
            let motion = mechanism(&rigid, 3, spread).unwrap();
            assert!((motion.force_n / rigid.straight_force(3) - 1.0).abs() < 1e-3, "{motion:?}");
            for (i, v) in motion.velocities.iter().enumerate() {
                let expected = if i < 3 { 0.0 } else { 1.0 };
                assert!((v.x - expected).abs() < 1e-2 && v.z.abs() < 0.1, "{i}: {v}");
            }
        }
    }

    #[test]
    fn power_and_limit_analysis_are_duals() {
        let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap();
        let rigid = RigidTower::new(&scene).unwrap();
        for block in 0..15 {
            let power = mechanism(&rigid, block, Spread::ScaledCorners).unwrap().force_n;
            let limit = rigid.turning_force(block).unwrap();
            // the polygon that stands for the friction cone leaves 0.5 % open
            assert!(power > limit * 0.999 && power < limit * 1.008, "block {block}: {power} and {limit} N");
        }
    }

    #[test]
    fn a_mesh_has_the_load_and_the_centre_of_its_patch() {
        let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::default() }).unwrap();
        let rigid = RigidTower::new(&scene).unwrap();
        for patch in rigid.patches() {
            let total: f64 = patch.corners.iter().map(|c| c.1).sum();
            let mesh = patch.mesh(20);
            assert!((mesh.iter().map(|c| c.1).sum::<f64>() - total).abs() < 1e-9);
            if total > 1e-6 {
                let center = |c: &[(DVec2, f64)]| c.iter().map(|&(p, f)| p * f).sum::<DVec2>() / total;
                assert!(center(&mesh).distance(center(&patch.corners)) < 1e-4, "{patch:?}");
            }
        }
    }
}
