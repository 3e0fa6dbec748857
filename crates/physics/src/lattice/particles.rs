//! State of the particles of a block.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::Bodies;
use crate::lattice::affine::{PARTICLES, gradient, mean, outer, rest_position};
use crate::lattice::springs::{SPRINGS, Springs, ends};
use crate::report::LatticeReport;

/// Particles of a block.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Particles {
    /// Displacements from the rest positions in the rigid pose, in the body's frame, m.
    pub displacement: [DVec3; PARTICLES],
    /// Velocities in the world, m/s.
    pub velocity: [DVec3; PARTICLES],
}

impl Particles {
    /// Unstrained particles of a body in rigid motion; `half` are their distances from the centre,
    /// m.
    pub fn of_rigid(half: DVec3, orientation: DQuat, velocity: DVec3, spin: DVec3) -> Self {
        let mut particles = Self::default();
        particles.set_motion(half, orientation, velocity, spin);
        particles
    }

    /// Sets the velocities to those of a rigid motion.
    pub fn set_motion(&mut self, half: DVec3, orientation: DQuat, velocity: DVec3, spin: DVec3) {
        for (i, v) in self.velocity.iter_mut().enumerate() {
            *v = velocity + spin.cross(orientation * (rest_position(half, i) + self.displacement[i]));
        }
    }

    /// Positions of the particles and forces of the springs, for a block with the given pose.
    pub fn report(&self, half: DVec3, (center, axes): (DVec3, DMat3), springs: &Springs) -> LatticeReport {
        let mut at = [DVec3::ZERO; PARTICLES];
        for (i, at) in at.iter_mut().enumerate() {
            *at = rest_position(half, i) + self.displacement[i];
        }
        let mut forces = [0.0; SPRINGS];
        for (n, force) in forces.iter_mut().enumerate() {
            let (i, j, _) = ends(n);
            let (rest, now) = ((rest_position(half, j) - rest_position(half, i)).length(), (at[j] - at[i]).length());
            // The law of `kernel::spring`, without damping.
            *force = springs.stiffness * (now * now - rest * rest) / (2.0 * rest * rest) * now;
        }
        LatticeReport { particles: at.map(|at| center + axes * at), forces }
    }

    /// Particles of a block in a pose of this orientation, after `time` (s) at their velocities.
    pub fn moved(&self, time: f64, half: DVec3, orientation: DQuat) -> MovedParticles {
        let inverse = orientation.conjugate();
        let center = mean(&self.velocity);
        let velocity = self.velocity.map(|v| inverse * (v - center));
        let position = std::array::from_fn(|i| rest_position(half, i) + self.displacement[i] + velocity[i] * time);
        MovedParticles { position, velocity }
    }

    /// Stretch S = R⁻¹ F of the block; displacements that are not affine do not contribute.
    pub fn stretch(&self, half: DVec3) -> DMat3 {
        gradient(&self.displacement, half) + DMat3::IDENTITY
    }
}

/// Particles of a block about its centre, in the block's frame.
#[derive(Debug, Clone, Copy)]
pub struct MovedParticles {
    /// Positions, m.
    position: [DVec3; PARTICLES],
    /// Velocities, m/s.
    velocity: [DVec3; PARTICLES],
}

impl MovedParticles {
    /// Kinetic energies of a block of mass `mass` (kg), J: of its rotation as a whole, and of its
    /// strain.
    pub fn kinetic_energy(&self, mass: f64) -> (f64, f64) {
        let share = mass / PARTICLES as f64;
        let (mut momentum, mut inertia, mut all) = (DVec3::ZERO, DMat3::ZERO, 0.0);
        for (x, v) in self.position.iter().zip(&self.velocity) {
            momentum += share * x.cross(*v);
            inertia += (DMat3::from_diagonal(DVec3::splat(x.length_squared())) - outer(*x, *x)) * share;
            all += 0.5 * share * v.length_squared();
        }
        let rotation = 0.5 * momentum.dot(inertia.inverse() * momentum);
        (rotation, (all - rotation).max(0.0))
    }

    /// Energy of the springs, J: k (l² - l0²)² / (8 l0²) each, the integral of the force in
    /// [`Particles::report`].
    pub fn elastic_energy(&self, half: DVec3, springs: &Springs) -> f64 {
        (0..SPRINGS)
            .map(|n| {
                let (i, j, _) = ends(n);
                let rest = (rest_position(half, j) - rest_position(half, i)).length_squared();
                let now = (self.position[j] - self.position[i]).length_squared();
                springs.stiffness * (now - rest) * (now - rest) / (8.0 * rest)
            })
            .sum()
    }
}

/// Zeroes the velocities of the particles of bodies that are not active.
pub fn zero_velocities(bodies: &Bodies, particles: &mut [Particles]) {
    for (i, particles) in particles.iter_mut().enumerate().filter(|&(i, _)| !bodies.is_active(i)) {
        debug_assert!(bodies.velocity[i] == DVec3::ZERO);
        particles.velocity = [DVec3::ZERO; PARTICLES];
    }
}

#[cfg(test)]
mod tests {
    use teeter_scene::{Form, named};

    use super::*;
    use crate::input::Input;
    use crate::params::Params;
    use crate::world::World;

    #[test]
    fn a_soft_block_that_spins_keeps_its_angular_momentum() {
        for spin in [[100.0, 100.0, 100.0], [150.0, 0.0, 120.0]] {
            let mut scene = named("block").unwrap();
            (scene.form, scene.gravity, scene.springs.stiffness) = (Form::Lattice, 0.0, Some(1e3));
            (scene.blocks[0].pos[2], scene.blocks[0].spin) = (1.0, spin);
            let mut world = World::new(&scene, Params::default()).unwrap();
            let momentum = |world: &World| -> DVec3 {
                let cluster = &world.clusters.list[0];
                let (particles, (_, axes)) = (&cluster.particles[0], cluster.bodies.pose(0));
                let half = cluster.shapes.particles[0];
                let at = |i: usize| axes * (rest_position(half, i) + particles.displacement[i]);
                (0..PARTICLES).map(|i| at(i).cross(particles.velocity[i])).sum()
            };
            let start = momentum(&world);
            (0..60).for_each(|_| drop(world.step(&Input::default())));
            let change = (momentum(&world) - start).length() / start.length();
            assert!(change < 1e-3, "{spin:?}: changes by {change:.1e}");
        }
    }
}
