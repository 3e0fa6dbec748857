//! Sync: the displacements of a batch become exact poses, in double precision.

use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes, turned, world_tensor};
use crate::constants::RUNAWAY_SPEED;
use crate::contacts::Contacts;
use crate::manifold::Point;

/// Moves body `i` by what the inner loop found in `time` (s): displacement (m), turn (rad), velocity and spin at the end.
///
/// The loop turns with the inertia of the start. The midpoint rule puts this right with the angular momentum that the loop kept;
/// an explicit rule would gain energy in free spin.
pub fn advance(shapes: &Shapes, bodies: &mut Bodies, i: usize, motion: [DVec3; 4], time: f64) {
    let [shift, turn, velocity, spin] = motion;
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

/// The motion of body `i` in `time` (s) under a constant force (N) alone: a parabola, which single precision would miss by the
/// rounding of each substep. Its turning is left to the midpoint rule.
pub fn fly(shapes: &Shapes, bodies: &Bodies, i: usize, force: DVec3, time: f64) -> [DVec3; 4] {
    let acceleration = force / shapes.mass[i];
    let (v, w) = (bodies.velocity[i], bodies.spin[i]);
    [(v + 0.5 * time * acceleration) * time, w * time, v + acceleration * time, w]
}

/// Whether a motion can go on: finite and not faster than a body can be.
pub fn sane(shapes: &Shapes, i: usize, motion: &[DVec3; 4]) -> bool {
    let [shift, turn, velocity, spin] = motion;
    shift.is_finite() && turn.is_finite() && velocity.length() + spin.length() * shapes.radius[i] < RUNAWAY_SPEED
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
