//! Sync: turns the displacements of a batch into poses, in double precision.

use glam::DVec3;

use crate::body::{Bodies, FLOOR, Shapes, rotated, world_tensor};
use crate::cluster::energy;
use crate::collision::contacts::Contacts;
use crate::collision::manifold::ContactPoint;
use crate::constants::RUNAWAY_SPEED;
use crate::kernel::body_model::BodyDelta;
use crate::lattice::affine::{PARTICLES, gradient, mean, nearest_rotation, rest_position};
use crate::lattice::particles::Particles;

/// Moves rigid body `i` by its change in the inner loop during `time` (s).
///
/// The loop rotates with the inertia of the last sync. The midpoint rule corrects that from the
/// angular momentum, which the loop conserves; an explicit rule would gain energy in free spin.
pub fn advance_rigid(shapes: &Shapes, bodies: &mut Bodies, i: usize, delta: &BodyDelta, time: f64) {
    let BodyDelta { displacement, rotation, velocity, spin, .. } = *delta;
    let q0 = bodies.orientation[i];
    let inertia = bodies.inertia(shapes, i);
    let inv = shapes.inertia[i].recip();
    let middle = rotated(q0, rotation * 0.5);
    let rotation = world_tensor(middle, inv) * (inertia * rotation);
    let q1 = rotated(q0, rotation);
    bodies.acceleration[i] = (velocity - bodies.velocity[i]).length() / time;
    bodies.position[i] += displacement;
    bodies.orientation[i] = q1;
    bodies.velocity[i] = velocity;
    bodies.spin[i] = world_tensor(q1, inv) * (inertia * spin);
}

/// Change of the particles of a block in the inner loop.
#[derive(Debug, Clone, Copy)]
pub struct ParticleDelta<'a> {
    /// Displacements (m) and velocities (m/s) of the particles in the world.
    pub particles: &'a [(DVec3, DVec3); PARTICLES],
    /// Displacement (m) and velocity (m/s) of the centre in ballistic flight; none where the
    /// particles determine them.
    pub flight: Option<(DVec3, DVec3)>,
    /// Time since the last sync, s.
    pub time: f64,
}

/// Moves block `i` by the change of its particles in the inner loop, and fits its pose to them.
pub fn advance_lattice(
    shapes: &Shapes,
    bodies: &mut Bodies,
    i: usize,
    particles: &mut Particles,
    delta: &ParticleDelta,
) {
    let (half, q0) = (shapes.particles[i], bodies.orientation[i]);
    let mut at = [DVec3::ZERO; PARTICLES];
    let mut velocity = [DVec3::ZERO; PARTICLES];
    for (j, &(displacement, v)) in delta.particles.iter().enumerate() {
        at[j] = q0 * rest_position(half, j) + displacement;
        velocity[j] = v;
    }
    let (mean_displacement, mean_velocity) = (mean(&at), mean(&velocity));
    let (displacement, center_velocity) = delta.flight.unwrap_or((mean_displacement, mean_velocity));
    let correction = center_velocity - mean_velocity;
    let mut momentum = DVec3::ZERO;
    for j in 0..PARTICLES {
        at[j] -= mean_displacement;
        momentum += at[j].cross(velocity[j]) * (shapes.mass[i] / PARTICLES as f64);
        particles.velocity[j] = velocity[j] + correction;
    }
    let q = nearest_rotation(gradient(&at, half), q0);
    for (j, at) in at.into_iter().enumerate() {
        particles.displacement[j] = q.conjugate() * at - rest_position(half, j);
    }
    bodies.acceleration[i] = (center_velocity - bodies.velocity[i]).length() / delta.time;
    bodies.position[i] += displacement;
    bodies.orientation[i] = q;
    bodies.velocity[i] = center_velocity;
    bodies.spin[i] = bodies.inv_inertia(shapes, i) * momentum;
    bodies.stretch[i] = particles.stretch(half);
}

/// Replaces the motion of body `i` in `time` (s) by that under a constant acceleration (m/s²).
///
/// The parabola is exact, whereas single precision loses the rounding of each substep. Rotation is
/// left to the midpoint rule, or to the particles.
pub fn integrate_ballistic(bodies: &Bodies, i: usize, acceleration: DVec3, time: f64, delta: &mut BodyDelta) {
    let v = bodies.velocity[i];
    delta.displacement = (v + 0.5 * time * acceleration) * time;
    delta.velocity = v + acceleration * time;
    if delta.particles.is_none() {
        (delta.rotation, delta.spin) = (bodies.spin[i] * time, bodies.spin[i]);
    }
}

/// Returns true if a change is finite, and slow or accounted for by the energy entered (J).
pub fn is_valid(shapes: &Shapes, bodies: &Bodies, i: usize, delta: &BodyDelta, entered: f64) -> bool {
    let mut particles = delta.particles.iter().flatten();
    let finite = delta.displacement.is_finite() && delta.rotation.is_finite() && particles.all(|(u, _)| u.is_finite());
    let mut particles = delta.particles.iter().flatten();
    let slow = delta.velocity.length() + delta.spin.length() * shapes.radius[i] < RUNAWAY_SPEED
        && particles.all(|(_, v)| v.length() < RUNAWAY_SPEED);
    finite && (slow || energy::is_accounted(shapes, bodies, i, delta, entered))
}

/// Freezes a body at its last pose, and resets the springs of its contacts.
pub fn quarantine(bodies: &mut Bodies, contacts: &mut Contacts, i: usize) {
    bodies.quarantined[i] = true;
    bodies.velocity[i] = DVec3::ZERO;
    bodies.spin[i] = DVec3::ZERO;
    bodies.acceleration[i] = 0.0;
    for manifold in &mut contacts.manifolds {
        if (manifold.a != FLOOR && manifold.a as usize == i) || manifold.b as usize == i {
            manifold.points.iter_mut().for_each(ContactPoint::reset);
        }
    }
}
