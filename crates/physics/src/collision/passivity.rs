//! Passivity: a contact that is detected again holds no more energy than before.
//!
//! Between detections springs only store what motion gives them. A detection changes the geometry:
//! a contact may be found deep inside two bodies, where they meet faster than detection follows or
//! where the nearest axis changes, and its patch may be larger. Its springs would then hold an
//! energy that nobody put in and throw the bodies apart. So a part of the depth is free of force,
//! and fades; and displacements of springs that have become stiffer are shortened.

use crate::body::{Bodies, Shapes};
use crate::collision::manifold::Manifold;
use crate::collision::stable_spring::stable_spring;
use crate::constants::{FREE_DEPTH_RATE, MIN_FREE_DEPTH};

/// Halvings of the interval in which the free depth is sought.
const HALVINGS: usize = 40;

/// Energies of the springs of a manifold, J.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpringEnergy {
    /// Of the normal springs.
    normal: f64,
    /// Of the Maxwell elements.
    maxwell: f64,
    /// Of the tangential springs, over the ratio of their stiffness to that of the normal ones.
    tangential: f64,
}

impl SpringEnergy {
    /// Energies of a manifold whose gaps are those of the poses.
    pub fn of(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> Self {
        let half = 0.5 * stable_spring(manifold, shapes, bodies).0;
        Self {
            normal: half * squared_depth(manifold, manifold.free_depth),
            maxwell: half * squared_maxwell(manifold),
            tangential: half * squared_tangential(manifold),
        }
    }

    /// Limits the energies of a new manifold to these, which its pair had before.
    ///
    /// The normal springs may in any case hold what the weight of the lighter body presses them: a
    /// block that slides over a seam is deep in the next block from the start, by the elasticity of
    /// the last.
    pub fn limit(&self, manifold: &mut Manifold, shapes: &Shapes, bodies: &Bodies) {
        let half = 0.5 * stable_spring(manifold, shapes, bodies).0;
        let sag = 0.5 * lighter_mass(manifold, shapes) * shapes.spring.gravity / half;
        free_depth(manifold, (self.normal / half).max(sag * sag), MIN_FREE_DEPTH * thickness(manifold, shapes));
        let shortened = |square: f64, allowed: f64| if square > allowed { (allowed / square).sqrt() } else { 1.0 };
        let maxwell = shortened(squared_maxwell(manifold), self.maxwell / half);
        let tangential = shortened(squared_tangential(manifold), self.tangential / half);
        for point in &mut manifold.points {
            point.maxwell *= maxwell;
            point.tangential.iter_mut().for_each(|displacement| *displacement *= tangential);
        }
    }
}

/// Sets the free depth for which the weighted square of the rest is `allowed` (m²), or zero where
/// it is less; depths up to `negligible` (m) are never free.
fn free_depth(manifold: &mut Manifold, allowed: f64, negligible: f64) {
    manifold.free_depth = 0.0;
    let deepest = manifold.deepest();
    if deepest <= negligible || squared_depth(manifold, 0.0) <= allowed + negligible * negligible {
        return;
    }
    let (mut low, mut high) = (0.0, deepest);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if squared_depth(manifold, middle) > allowed { low = middle } else { high = middle }
    }
    manifold.free_depth = high;
}

/// Lets the free depth of a manifold fade during `time` (s). The energy that this adds to the
/// springs is at most that of lifting the lighter body as fast as a free depth fades: as the depth
/// goes at once, stiff springs bear only a part of it.
pub fn fade(manifold: &mut Manifold, time: f64, shapes: &Shapes, bodies: &Bodies) {
    let (stiffness, _) = stable_spring(manifold, shapes, bodies);
    let force = stiffness * manifold.points.iter().map(|p| p.weight * depth(p.gap, manifold.free_depth)).sum::<f64>();
    let weight = lighter_mass(manifold, shapes) * shapes.spring.gravity;
    let faded = FREE_DEPTH_RATE * thickness(manifold, shapes) * time;
    // The root of F x + k x² / 2 = W, without the difference of two large numbers.
    let work = weight * faded;
    let root = 2.0 * work / (force + (force * force + 2.0 * stiffness * work).sqrt()).max(f64::MIN_POSITIVE);
    manifold.free_depth = (manifold.free_depth - root.min(faded)).max(0.0);
}

/// Depth beyond `free` (m) at a gap (m), m.
fn depth(gap: f64, free: f64) -> f64 {
    (-gap - free).max(0.0)
}

/// Mean square of the depth beyond `free` (m), weighted by stiffness, m².
fn squared_depth(manifold: &Manifold, free: f64) -> f64 {
    let square = |gap| depth(gap, free) * depth(gap, free);
    manifold.points.iter().map(|p| p.weight * square(p.gap)).sum()
}

/// Mean square of the Maxwell elements, weighted by stiffness, m².
fn squared_maxwell(manifold: &Manifold) -> f64 {
    manifold.points.iter().map(|p| p.weight * p.maxwell * p.maxwell).sum()
}

/// Mean square of the tangential displacements, weighted by stiffness, m².
fn squared_tangential(manifold: &Manifold) -> f64 {
    manifold.points.iter().map(|p| p.weight * p.tangential.iter().map(|u| u * u).sum::<f64>()).sum()
}

/// Mass of the lighter body, kg.
fn lighter_mass(manifold: &Manifold, shapes: &Shapes) -> f64 {
    let mass = |i: u32| shapes.mass.get(i as usize).copied().unwrap_or(f64::INFINITY);
    mass(manifold.a).min(mass(manifold.b))
}

/// Smallest edge of the two bodies, m.
pub fn thickness(manifold: &Manifold, shapes: &Shapes) -> f64 {
    let of = |i: u32| shapes.half.get(i as usize).map_or(f64::INFINITY, |half| 2.0 * half.min_element());
    of(manifold.a).min(of(manifold.b))
}
