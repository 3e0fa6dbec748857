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

/// Energy in the springs of a contact over that of its compression at the last sync, an upper
/// bound: tangential springs hold up to mu² / 0.8 of it, which is 5, and the Maxwell element adds
/// to the compression.
const CONTACT_BOUND: f64 = 8.0;
/// Speed of a body's points below which its rotation counts as that of a ring, m/s.
const SLOW: f64 = 1.0;
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
        energy += 0.5 * shapes.mass[i] * speed * speed + max_spin_energy(shapes, bodies, i);
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
    // The maximum passes over particles whose speed is not a number, their energy does not.
    energy.is_finite() && (speed < RUNAWAY_SPEED || (speed < MAX_SPEED && energy <= BOOK_FACTOR * entered))
}

/// Energy of the rotation of body `i` at a spin (rad/s), J.
fn spin_energy(shapes: &Shapes, bodies: &Bodies, i: usize, spin: DVec3) -> f64 {
    let spin = bodies.orientation[i].conjugate() * spin;
    0.5 * (spin * spin).dot(shapes.inertia[i])
}

/// Upper bound of the energy of the rotation of body `i`, J; cheap for a slow one.
fn max_spin_energy(shapes: &Shapes, bodies: &Bodies, i: usize) -> f64 {
    let speed_squared = bodies.spin[i].length_squared() * shapes.radius[i] * shapes.radius[i];
    if speed_squared < SLOW * SLOW {
        0.5 * shapes.mass[i] * speed_squared
    } else {
        spin_energy(shapes, bodies, i, bodies.spin[i])
    }
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
            let depth = (-point.gap).max(0.0);
            squares += point.weight * depth * depth;
        }
        sum += squares * manifold.area_ratio;
    }
    0.5 * CONTACT_BOUND * derived.stiffness * sum
}

/// Upper bound of the energy in the springs of the blocks, J.
fn strain_energy(cluster: &Cluster, derived: &Derived) -> f64 {
    let squares = |p: &Particles| p.displacement.iter().map(|u| u.length_squared()).sum::<f64>();
    let stiffness = derived.springs.map_or(0.0, |springs| springs.stiffness);
    STRAIN_BOUND * stiffness * cluster.particles.iter().map(squares).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use teeter_scene::{Form, Scene, named};

    use super::*;
    use crate::input::{AppliedForce, Input};
    use crate::params::Params;
    use crate::world::World;

    /// Returns true if body 0 of a scene may have a velocity and a spin at the end of a frame.
    fn may_have(scene: &Scene, input: &Input, velocity: DVec3, spin: DVec3) -> bool {
        let world = World::new(scene, Params::default()).unwrap();
        let cluster = &world.clusters.list[0];
        let locations = (1, world.clusters.locations.as_slice());
        let input = ClusterInput::split(input, None, &[], locations).remove(0);
        let entered = entered(cluster, &world.derived, world.gravity, &input);
        let (displacement, rotation) = (DVec3::ZERO, DVec3::ZERO);
        let delta = BodyDelta { displacement, rotation, velocity, spin, particles: None };
        is_accounted(&cluster.shapes, &cluster.bodies, 0, &delta, entered)
    }

    /// Lost is the velocity of the first, a middle or the last particle of a block of springs: such
    /// a block was moved by kilometres, and its snapshot was refused.
    #[test]
    fn a_block_with_one_particle_of_no_finite_velocity_is_not_accounted_for() {
        let scene = Scene { form: Form::Lattice, ..named("block").unwrap() };
        let world = World::new(&scene, Params::default()).unwrap();
        let cluster = &world.clusters.list[0];
        let accounted = |particle: usize, velocity: DVec3| {
            let mut particles = [(DVec3::ZERO, DVec3::ZERO); PARTICLES];
            particles[particle].1 = velocity;
            let [displacement, rotation, velocity, spin] = [DVec3::ZERO; 4];
            let delta = BodyDelta { displacement, rotation, velocity, spin, particles: Some(particles) };
            is_accounted(&cluster.shapes, &cluster.bodies, 0, &delta, 1e300)
        };
        for particle in [0, 3, PARTICLES - 1] {
            assert!(accounted(particle, DVec3::X));
            assert!(!accounted(particle, DVec3::Y * f64::NAN));
            assert!(!accounted(particle, DVec3::Z * f64::NEG_INFINITY));
        }
    }

    #[test]
    fn energy_that_nobody_put_in_is_found() {
        let scene = named("block").unwrap();
        let idle = Input::default();
        // A block at rest explodes, or its numbers are none.
        assert!(!may_have(&scene, &idle, DVec3::X * 150.0, DVec3::ZERO));
        assert!(!may_have(&scene, &idle, DVec3::ZERO, DVec3::Z * 1e4));
        assert!(!may_have(&scene, &idle, DVec3::X * f64::NAN, DVec3::ZERO));
        assert!(!may_have(&scene, &idle, DVec3::ZERO, DVec3::Y * f64::INFINITY));
        // A force that gives 166 m/s in a frame, and one that gives a tenth of it.
        let push = |force: f64| Input::force(AppliedForce::at_center(crate::BodyId(0), DVec3::X * force));
        assert!(may_have(&scene, &push(200.0), DVec3::X * 150.0, DVec3::ZERO));
        assert!(!may_have(&scene, &push(20.0), DVec3::X * 150.0, DVec3::ZERO));
    }

    #[test]
    fn a_fast_body_may_keep_its_energy_and_give_it_away() {
        let mut scene = named("block").unwrap();
        scene.blocks[0].pos[2] = 1.0;
        scene.blocks[0].velocity = [0.0, 0.0, 100.0];
        assert!(may_have(&scene, &Input::default(), DVec3::Z * 100.1, DVec3::ZERO));
        // The range of the method ends at 10 km/s, whatever the energy.
        scene.blocks[0].mass = 1e3;
        scene.stiffness = 1e7;
        let mut light = scene.blocks[0].clone();
        (light.id, light.mass, light.pos) = (99, 1e-3, [0.0, 0.0, 1.1]);
        scene.blocks.insert(0, light);
        assert!(may_have(&scene, &Input::default(), DVec3::Z * 9e3, DVec3::ZERO));
        assert!(!may_have(&scene, &Input::default(), DVec3::Z * 1.1e4, DVec3::ZERO));
    }
}
