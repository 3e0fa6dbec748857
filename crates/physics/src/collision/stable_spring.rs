//! Stiffness and damping of a contact.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::collision::manifold::Manifold;
use crate::constants::{FLOOR_STEP_LIMIT, STEP_LIMIT};
use crate::contact_spring::ContactSpring;

/// Stiffness (N/m) and damping (N s/m) of a manifold, limited to what the explicit step can
/// integrate.
///
/// A mode of stiffness k and damping c with mobility X is stable while 2 k X h² + 2 c X h < 4;
/// the Maxwell element doubles k. That holds for a single contact: [`STEP_LIMIT`] and
/// [`FLOOR_STEP_LIMIT`] are the parts that one contact among others may use. Stiffness is
/// limited to 0.6 of that part and damping to the remainder. Crossed nominal blocks are within
/// the limit, for the substep is derived from them, see [`crate::derived`]; blocks lying flat
/// on each other would exceed it.
pub fn stable_spring(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> (f64, f64) {
    let held = |i: u32| i == FLOOR || bodies.fixed[i as usize];
    let inv = |i: u32| if held(i) { 0.0 } else { shapes.mass[i as usize].recip() };
    let mass = (inv(manifold.a) + inv(manifold.b)).recip();
    let limit = if manifold.a == FLOOR { FLOOR_STEP_LIMIT } else { STEP_LIMIT };
    let ContactSpring { stiffness, zeta, h, .. } = shapes.spring;
    let x = manifold.mobility;
    let stiffness = (stiffness * manifold.area_ratio).min(0.6 * limit / (2.0 * h * h * x));
    let damping = 2.0 * zeta * (stiffness * mass).sqrt();
    (stiffness, damping.min((limit - 2.0 * h * h * stiffness * x) / (2.0 * h * x)))
}
