//! Patches: loaded regions of contact.

use glam::DVec2;

use super::contact_point::MIN_FORCE;

/// Region in which two blocks, or a block and the floor, touch.
///
/// ```
/// use teeter_study::RigidTower;
///
/// let scene = teeter_scene::named("block").unwrap();
/// let patches = RigidTower::new(&scene)?.patches();
/// let load: f64 = patches[0].mesh(4).iter().map(|&(_, force)| force).sum();
/// assert!((load / (scene.blocks[0].mass * scene.gravity) - 1.0).abs() < 1e-6);
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Index of the lower block; none for the floor.
    pub below: Option<usize>,
    /// Index of the upper block.
    pub above: usize,
    /// Ratio of its torsional friction to that of forces at its corners, see [`crate::torsion`].
    pub torsion_ratio: f64,
    /// Positions of the corners (m), anticlockwise, with the normal forces there (N).
    pub corners: Vec<(DVec2, f64)>,
}

impl Patch {
    /// Returns positions (m) and forces (N) of the load on `cells` by `cells` parts of a
    /// parallelogram.
    ///
    /// The pressure is that of springs under a flat face: linear along each side, nowhere negative,
    /// and with the centre of the corners' forces. A patch of another number of corners keeps them.
    pub fn mesh(&self, cells: usize) -> Vec<(DVec2, f64)> {
        let &[a, b, c, d] = &self.corners[..] else { return self.corners.clone() };
        let load = a.1 + b.1 + c.1 + d.1;
        if load < MIN_FORCE {
            return self.corners.clone();
        }
        let along = pressure_shares(((b.1 + c.1) - (a.1 + d.1)) / load, cells);
        let across = pressure_shares(((c.1 + d.1) - (a.1 + b.1)) / load, cells);
        let position = |u: f64, v: f64| a.0 + (b.0 - a.0) * (0.5 * (1.0 + u)) + (d.0 - a.0) * (0.5 * (1.0 + v));
        along.iter().flat_map(|&(u, f)| across.iter().map(move |&(v, g)| (position(u, v), load * f * g))).collect()
    }
}

/// Coordinates from -1 to 1 of `cells` parts, with their shares of a load centred at `center`.
///
/// The pressure is 1 + 3 center u while that is nowhere negative, and beyond a triangle on the last
/// 3 (1 - |center|) before the end.
fn pressure_shares(center: f64, cells: usize) -> Vec<(f64, f64)> {
    let side = center.signum();
    let center = center.abs().min(1.0);
    let length = (3.0 * (1.0 - center)).clamp(1e-9, 2.0);
    let pressure = |u: f64| if center <= 1.0 / 3.0 { 1.0 + 3.0 * center * u } else { u - (1.0 - length) };
    let coordinates: Vec<f64> = (0..cells).map(|i| 1.0 - length * (1.0 - (i as f64 + 0.5) / cells as f64)).collect();
    let total: f64 = coordinates.iter().map(|&u| pressure(u)).sum();
    coordinates.iter().map(|&u| (side * u, pressure(u) / total)).collect()
}
