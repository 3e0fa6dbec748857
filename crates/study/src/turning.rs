//! How a tower begins to turn above a block that is pulled.
//!
//! With the normal forces of rest the blocks move, at the least force that moves them, so that friction takes the least power: over velocities in the plane,
//!
//! ```text
//! F = min sum mu N_i |v_i|   with the pulled block at unit speed along its axis
//! ```
//!
//! which is the dual of the limit analysis of [`crate::Rigid::turning_pull`] and gives the motion besides. A patch may have any number of points: its four
//! corners, or a mesh of many under a pressure that varies evenly with the place, as springs under a flat face have it. |v| is rounded off near 0, by less and
//! less, and each rounded problem is smooth and convex: Newton's method with a line search.

use glam::{DVec2, DVec3};
use teeter_scene::Scene;

use crate::exact::Rigid;
use crate::linear::solve;
use crate::plan::{center, long_axis};

/// Speeds below which |v| is rounded, as shares of that of the pull: from the first to the last, each a quarter of the one before.
const ROUNDING: (f64, f64) = (0.3, 1e-5);
/// Most steps of Newton's method at one rounding.
const STEPS: usize = 60;
/// Unit of length of the spins, m: about that of the levers.
const UNIT: f64 = 3e-2;

/// How friction of a patch is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// At its corners.
    Corners,
    /// At its corners, drawn towards the centre of pressure by the lever of [`crate::torsion`]: what the engine does.
    Lever,
    /// At the middles of so many by so many cells.
    Mesh(usize),
}

/// How the blocks begin to move.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The force that starts it, N.
    pub force_n: f64,
    /// For each block its velocity along x and y and its spin, for a pull of 1 m/s: 1, 1, rad/m.
    pub velocities: Vec<DVec3>,
}

/// A place at which friction acts.
struct Grip {
    below: Option<usize>,
    above: usize,
    place: DVec2,
    /// Most friction, N.
    most: f64,
}

/// How the blocks of `scene` begin to move when one is pulled; `forward` along its long axis or against it, which is the same but for the sign.
pub fn motion(scene: &Scene, rigid: &Rigid, block: usize, spread: Spread) -> Option<Motion> {
    let grips = grips(scene, rigid, spread);
    let n = 3 * scene.blocks.len();
    let axis = long_axis(&scene.blocks[block]);
    // the pulled block alone moves
    let mut u = vec![0.0; n];
    (u[3 * block], u[3 * block + 1]) = (axis.x, axis.y);
    let scale: f64 = grips.iter().map(|g| g.most).sum();
    // held so stiffly to its speed that what it falls short by is nothing
    let hold = 1e7 * scale;
    let mut rounding = ROUNDING.0;
    loop {
        relax(scene, &grips, (block, axis), hold, rounding, &mut u)?;
        if rounding <= ROUNDING.1 {
            break;
        }
        rounding = (0.25 * rounding).max(ROUNDING.1);
    }
    let force_n = grips.iter().map(|g| g.most * g.slip(scene, &u).length()).sum();
    let velocities = u.chunks_exact(3).map(|u| DVec3::new(u[0], u[1], u[2] / UNIT)).collect();
    Some(Motion { force_n, velocities })
}

/// Newton's method at one rounding.
fn relax(
    scene: &Scene,
    grips: &[Grip],
    (block, axis): (usize, DVec2),
    hold: f64,
    rounding: f64,
    u: &mut [f64],
) -> Option<()> {
    let n = u.len();
    let power = |u: &[f64]| {
        let short = axis.x * u[3 * block] + axis.y * u[3 * block + 1] - 1.0;
        let rounded = |g: &Grip| g.most * (g.slip(scene, u).length_squared() + rounding * rounding).sqrt();
        0.5 * hold * short * short + grips.iter().map(rounded).sum::<f64>()
    };
    for _ in 0..STEPS {
        let (mut gradient, mut matrix) = (vec![0.0; n], vec![0.0; n * n]);
        let short = axis.x * u[3 * block] + axis.y * u[3 * block + 1] - 1.0;
        for (i, a) in [(3 * block, axis.x), (3 * block + 1, axis.y)] {
            gradient[i] += hold * short * a;
            for (j, b) in [(3 * block, axis.x), (3 * block + 1, axis.y)] {
                matrix[i * n + j] += hold * a * b;
            }
        }
        for grip in grips {
            let slip = grip.slip(scene, u);
            let size = (slip.length_squared() + rounding * rounding).sqrt();
            let (share, direction) = (grip.most / size, slip / size);
            let acts = grip.acts(scene);
            for &(i, a) in &acts {
                gradient[i] += share * slip.dot(a);
                for &(j, b) in &acts {
                    matrix[i * n + j] += share * (a.dot(b) - direction.dot(a) * direction.dot(b));
                }
            }
        }
        let least = 1e-9 * hold / 1e7;
        (0..n).for_each(|i| matrix[i * n + i] += least);
        let step = solve(matrix, gradient.clone())?;
        let slope: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        let before = power(u);
        if slope < 1e-11 * before {
            return Some(());
        }
        let mut share = 1.0;
        loop {
            let next: Vec<f64> = u.iter().zip(&step).map(|(u, s)| u - share * s).collect();
            if power(&next) <= before - 1e-4 * share * slope || share < 1e-9 {
                u.copy_from_slice(&next);
                break;
            }
            share *= 0.5;
        }
    }
    Some(())
}

impl Grip {
    /// The unknowns that move it, with what each adds to the slip.
    fn acts(&self, scene: &Scene) -> Vec<(usize, DVec2)> {
        let of = |body: usize, sign: f64| {
            let arm = (self.place - center(&scene.blocks[body])) / UNIT;
            [(3 * body, DVec2::X * sign), (3 * body + 1, DVec2::Y * sign), (3 * body + 2, arm.perp() * sign)]
        };
        let mut acts = of(self.above, 1.0).to_vec();
        acts.extend(self.below.iter().flat_map(|&b| of(b, -1.0)));
        acts
    }

    /// Velocity of the upper side over the lower one.
    fn slip(&self, scene: &Scene, u: &[f64]) -> DVec2 {
        let of = |body: usize| {
            let arm = (self.place - center(&scene.blocks[body])) / UNIT;
            DVec2::new(u[3 * body], u[3 * body + 1]) + arm.perp() * u[3 * body + 2]
        };
        of(self.above) - self.below.map_or(DVec2::ZERO, of)
    }
}

/// All places at which friction acts.
fn grips(scene: &Scene, rigid: &Rigid, spread: Spread) -> Vec<Grip> {
    let mut grips = Vec::new();
    for patch in rigid.patches() {
        let total: f64 = patch.corners.iter().map(|c| c.1).sum();
        if total < 1e-9 {
            continue;
        }
        let (below, above) = (patch.below, patch.above);
        let mut add = |place: DVec2, force: f64| grips.push(Grip { below, above, place, most: scene.friction * force });
        let middle: DVec2 = patch.corners.iter().map(|&(place, force)| place * force).sum::<DVec2>() / total;
        match spread {
            Spread::Corners => patch.corners.iter().for_each(|&(place, force)| add(place, force)),
            Spread::Lever => {
                patch.corners.iter().for_each(|&(place, force)| add(middle + (place - middle) * patch.lever, force))
            }
            Spread::Mesh(cells) => patch.mesh(cells).into_iter().for_each(|(place, force)| add(place, force)),
        }
    }
    grips
}

#[cfg(test)]
mod tests {
    use super::*;
    use teeter_scene::{TowerOptions, named, tower};

    #[test]
    fn a_column_does_not_turn() {
        let scene = named("column").unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        for spread in [Spread::Corners, Spread::Lever, Spread::Mesh(6)] {
            let motion = motion(&scene, &rigid, 3, spread).unwrap();
            assert!((motion.force_n / rigid.straight_pull(3) - 1.0).abs() < 1e-3, "{motion:?}");
            for (i, v) in motion.velocities.iter().enumerate() {
                let expected = if i < 3 { 0.0 } else { 1.0 };
                assert!((v.x - expected).abs() < 1e-2 && v.z.abs() < 0.1, "{i}: {v}");
            }
        }
    }

    #[test]
    fn power_and_limit_analysis_are_duals() {
        let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        for block in 0..15 {
            let (power, limit) =
                (motion(&scene, &rigid, block, Spread::Lever).unwrap().force_n, rigid.turning_pull(block).unwrap());
            // the polygon that stands for the circle of friction leaves 0.5 % open
            assert!(power > limit * 0.999 && power < limit * 1.008, "block {block}: {power} and {limit} N");
        }
    }

    /// A mesh has the load of its patch, its centre, and the torsional friction of a spread pressure.
    #[test]
    fn a_mesh_stands_for_its_patch() {
        let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::default() }).unwrap();
        let rigid = Rigid::new(&scene).unwrap();
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
