//! Energy books: which fast bodies have run away.
//!
//! A body is not wrong because it is fast: it may have fallen far, or been struck or driven. It has
//! run away when it has gained energy that nobody put in. So the energy of a cluster is entered at
//! the start of each frame, with all that gravity and the input can add within the frame. A body
//! that is found to be fast may have that energy, and is frozen when it has much more.

use glam::DVec3;

use crate::actuator::cluster_input::ClusterInput;
use crate::actuator::limits;
use crate::body::{Bodies, Shapes, point_speed};
use crate::cluster::Cluster;
use crate::constants::{BOOK_FACTOR, MAX_SPEED, RUNAWAY_SPEED};
use crate::derived::Derived;
use crate::kernel::body_model::BodyDelta;
use crate::lattice::affine::PARTICLES;
use crate::lattice::particles::Particles;

/// Upper bound of the strain energy of a block over stiffness times the sum of the squared
/// displacements of its particles: 7 springs end at each particle, each with at most
/// k/2 (2 u² + 2 v²), and the springs stiffen as they stretch.
const STRAIN_BOUND: f64 = 28.0;

/// Upper bound of the energy that a body of the cluster may have within a frame under gravity
/// (m/s²), J.
pub fn entered(cluster: &Cluster, derived: &Derived, gravity: DVec3, input: &ClusterInput) -> f64 {
    let Cluster { shapes, bodies, .. } = cluster;
    let fall = gravity.length() * derived.frame;
    let mut energy = contact_energy(cluster, derived) + strain_energy(cluster, derived);
    for i in (0..bodies.len()).filter(|&i| !bodies.is_immovable(i)) {
        let speed = bodies.velocity[i].length() + fall;
        energy += 0.5 * shapes.mass[i] * speed * speed + spin_energy(shapes, bodies, i, bodies.spin[i]);
    }
    for i in input.bodies() {
        energy += work(shapes, bodies, i, fall + speed_gain(input, shapes, i, derived.frame));
    }
    energy
}

/// Returns true if a body with this change is in the range of the method, and slow, or has no more
/// energy than was entered (J).
pub fn is_accounted(shapes: &Shapes, bodies: &Bodies, i: usize, delta: &BodyDelta, entered: f64) -> bool {
    let spin = bodies.orientation[i].conjugate() * delta.spin;
    let mut speed = delta.velocity.length() + point_speed(shapes.half[i], spin);
    let mut energy =
        0.5 * shapes.mass[i] * delta.velocity.length_squared() + spin_energy(shapes, bodies, i, delta.spin);
    if let Some(particles) = &delta.particles {
        let squares = || particles.iter().map(|(_, v)| v.length_squared());
        speed = speed.max(squares().fold(0.0, f64::max).sqrt());
        energy = 0.5 * shapes.mass[i] / PARTICLES as f64 * squares().sum::<f64>();
    }
    // Numbers that are not finite fail every comparison.
    speed < RUNAWAY_SPEED || (speed < MAX_SPEED && energy <= BOOK_FACTOR * entered)
}

/// Energy of the rotation of body `i` at a spin (rad/s), J.
fn spin_energy(shapes: &Shapes, bodies: &Bodies, i: usize, spin: DVec3) -> f64 {
    let spin = bodies.orientation[i].conjugate() * spin;
    0.5 * (spin * spin).dot(shapes.inertia[i])
}

/// Upper bound of the energy that body `i` gains when its points gain `speed` (m/s), J.
fn work(shapes: &Shapes, bodies: &Bodies, i: usize, speed: f64) -> f64 {
    // Speeds whose energy is that of the body: (a + b)² - a² for translation and for rotation.
    let gain = shapes.mass[i].sqrt() * speed;
    let linear = shapes.mass[i].sqrt() * bodies.velocity[i].length();
    let angular = (2.0 * spin_energy(shapes, bodies, i, bodies.spin[i])).sqrt();
    gain * (linear + angular + gain)
}

/// Upper bound of the speed that the input gives to the points of body `i` within a frame of `time`
/// (s), m/s.
fn speed_gain(input: &ClusterInput, shapes: &Shapes, i: usize, time: f64) -> f64 {
    let forces = input.forces.iter().filter(|(f, _)| f.body.index() == i).map(|(applied, before)| {
        let force = applied.force.length().max(before.length());
        limits::speed_gain(shapes, i, (force, applied.point.length()), time)
    });
    let drives = input.drives.iter().filter(|d| d.body.index() == i);
    let drives = drives.map(|d| limits::speed_gain(shapes, i, (d.max_force, shapes.radius[i]), time));
    let hand = input.hand.iter().filter(|(hand, _)| hand.body.index() == i).map(|(hand, _)| {
        let arm = hand.anchor.length() + hand.max_torque / hand.max_force.max(f64::MIN_POSITIVE);
        limits::speed_gain(shapes, i, (hand.max_force, arm), time)
    });
    forces.chain(drives).chain(hand).sum()
}

/// Upper bound of the energy in the springs of the contacts, J.
fn contact_energy(cluster: &Cluster, derived: &Derived) -> f64 {
    let mut sum = 0.0;
    for manifold in &cluster.contacts.manifolds {
        let mut squares = 0.0;
        for point in &manifold.points {
            let [x, y, turned] = point.tangential;
            let depth = (-point.gap).max(0.0) + point.maxwell.abs();
            squares += point.weight * (depth * depth + x * x + y * y + turned * turned);
        }
        sum += squares * manifold.area_ratio;
    }
    0.5 * derived.stiffness * sum
}

/// Upper bound of the energy in the springs of the blocks, J.
fn strain_energy(cluster: &Cluster, derived: &Derived) -> f64 {
    let squares = |p: &Particles| p.displacement.iter().map(|u| u.length_squared()).sum::<f64>();
    let stiffness = derived.springs.map_or(0.0, |springs| springs.stiffness);
    STRAIN_BOUND * stiffness * cluster.particles.iter().map(squares).sum::<f64>()
}
