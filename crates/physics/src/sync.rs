//! Sync: the displacements of a batch become exact poses, in double precision.

use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes, turned, world_tensor};
use crate::constants::RUNAWAY_SPEED;
use crate::contacts::Contacts;
use crate::form::Taken;
use crate::manifold::Point;

/// Moves rigid body `i` by what the inner loop found in `time` (s).
///
/// The loop turns with the inertia of the start. The midpoint rule puts this right with the angular momentum that the loop kept;
/// an explicit rule would gain energy in free spin.
pub fn advance(shapes: &Shapes, bodies: &mut Bodies, i: usize, taken: &Taken, time: f64) {
    let Taken { shift, turn, velocity, spin, .. } = *taken;
    let q0 = bodies.orientation[i];
    let inertia = bodies.inertia(shapes, i);
    let inv = shapes.inertia[i].recip();
    let middle = turned(q0, turn * 0.5);
    let turn = world_tensor(middle, inv) * (inertia * turn);
    let q1 = turned(q0, turn);
    bodies.acceleration[i] = (velocity - bodies.velocity[i]).length() / time;
    bodies.position[i] += shift;
    bodies.orientation[i] = q1;
    bodies.velocity[i] = velocity;
    bodies.spin[i] = world_tensor(q1, inv) * (inertia * spin);
}

/// Puts the motion of body `i` in `time` (s) under a constant force (N) alone in the place of what the loop found: a parabola, which single
/// precision would miss by the rounding of each substep. Turning is left to the midpoint rule, or to the particles.
pub fn fly(shapes: &Shapes, bodies: &Bodies, i: usize, force: DVec3, time: f64, taken: &mut Taken) {
    let acceleration = force / shapes.mass[i];
    let v = bodies.velocity[i];
    taken.shift = (v + 0.5 * time * acceleration) * time;
    taken.velocity = v + acceleration * time;
    if taken.particles.is_none() {
        (taken.turn, taken.spin) = (bodies.spin[i] * time, bodies.spin[i]);
    }
}

/// Whether a motion can go on: finite and not faster than a body can be.
pub fn sane(shapes: &Shapes, i: usize, taken: &Taken) -> bool {
    let whole = taken.shift.is_finite() && taken.turn.is_finite();
    let particles = taken.particles.iter().flatten().all(|(shift, v)| shift.is_finite() && v.length() < RUNAWAY_SPEED);
    whole && particles && taken.velocity.length() + taken.spin.length() * shapes.radius[i] < RUNAWAY_SPEED
}

/// Takes a body out of the play where it was: it stands still from now on, and what touched it forgets its springs.
pub fn quarantine(bodies: &mut Bodies, contacts: &mut Contacts, i: usize) {
    bodies.quarantined[i] = true;
    bodies.velocity[i] = DVec3::ZERO;
    bodies.spin[i] = DVec3::ZERO;
    bodies.acceleration[i] = 0.0;
    for manifold in &mut contacts.manifolds {
        if (manifold.a != FLOOR && manifold.a as usize == i) || manifold.b as usize == i {
            manifold.points.iter_mut().for_each(Point::forget);
        }
    }
}
