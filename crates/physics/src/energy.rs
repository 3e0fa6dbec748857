//! Mechanical energy of a world.

use glam::DVec3;
use serde::Serialize;

use crate::cluster::Cluster;
use crate::collision::manifold::Manifold;
use crate::collision::relative_twist::RelativeTwist;
use crate::collision::stable_spring::stable_spring;
use crate::constants::{STRAIN_INERTIA, TANGENTIAL_STIFFNESS};
use crate::lattice::springs::Springs;
use crate::world::World;

/// Mechanical energy of a world, J.
///
/// ```
/// use teeter_physics::{Params, World};
///
/// let mut scene = teeter_scene::named("block").unwrap();
/// scene.blocks[0].pos[2] += 0.1;
/// let mut world = World::new(&scene, Params::default())?;
/// let before = world.energy();
/// world.run_for(0.1);
/// let after = world.energy();
/// // in the air, what is lost in height is gained in speed
/// assert!(after.kinetic > 0.0 && after.elastic == 0.0);
/// assert!((after.total() / before.total() - 1.0).abs() < 1e-6);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Energy {
    /// Of the motion of the bodies and of their particles.
    pub kinetic: f64,
    /// In gravity, zero where a centre is at the origin.
    pub potential: f64,
    /// In the springs of contacts and within blocks.
    pub elastic: f64,
}

impl Energy {
    /// Sum of all three, J.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

impl World {
    /// Mechanical energy of the bodies that can move, and of their contacts.
    ///
    /// The velocities of the inner loop are half a substep ahead of the positions: the next
    /// displacement is theirs. The energy of springs is taken at the time of the velocities, or it
    /// would seem to change during an impact.
    pub fn energy(&self) -> Energy {
        let springs = self.derived.springs.as_ref();
        self.clusters.list.iter().fold(Energy::default(), |sum, cluster| {
            let of_bodies = cluster.energy_of_bodies(self.gravity, springs);
            let contacts: f64 = cluster.contacts.manifolds.iter().map(|m| cluster.contact_energy(m)).sum();
            Energy {
                kinetic: sum.kinetic + of_bodies.kinetic,
                potential: sum.potential + of_bodies.potential,
                elastic: sum.elastic + of_bodies.elastic + contacts,
            }
        })
    }
}

impl Cluster {
    /// Energy of the bodies under `gravity` (m/s²), without that of their contacts.
    fn energy_of_bodies(&self, gravity: DVec3, springs: Option<&Springs>) -> Energy {
        let Self { shapes, bodies, particles, .. } = self;
        let mut energy = Energy::default();
        for i in (0..bodies.len()).filter(|&i| !bodies.fixed[i] && !bodies.quarantined[i]) {
            let (mass, velocity) = (shapes.mass[i], bodies.velocity[i]);
            energy.potential -= mass * gravity.dot(bodies.position[i]);
            let Some((particles, springs)) = particles.get(i).zip(springs) else {
                energy.kinetic += bodies.kinetic_energy(shapes, i);
                continue;
            };
            let moved = particles.moved(0.5 * shapes.spring.h, shapes.particles[i], bodies.orientation[i]);
            let (rotation, strain) = moved.kinetic_energy(mass);
            energy.kinetic += 0.5 * mass * velocity.length_squared() + rotation + STRAIN_INERTIA * strain;
            energy.elastic += moved.elastic_energy(shapes.particles[i], springs);
        }
        energy
    }

    /// Energy in the springs of a contact, J: normal, Maxwell element and tangential.
    ///
    /// A spring of leapfrog with stiffness k and compression x, which grows, keeps the energy
    /// m v²(t + h/2) / 2 + k x(t) x(t + h) / 2: the square at the time of the velocity, less that
    /// of half a displacement. A point that closes after t has taken nothing from its bodies yet.
    ///
    /// Where the Maxwell element would pull by more than the spring pushes, the contact exerts no
    /// force, and its energy is that from which it went slack.
    fn contact_energy(&self, manifold: &Manifold) -> f64 {
        let (stiffness, _) = stable_spring(manifold, &self.shapes, &self.bodies);
        let lead = 0.5 * self.shapes.spring.h;
        let motion = RelativeTwist::of(manifold, &self.bodies);
        let squares = manifold.points.iter().map(|p| {
            let moved = lead * motion.opening(p.arm);
            let at_force = p.gap + manifold.free_depth;
            let (gap, maxwell) = (at_force + moved, p.maxwell + moved);
            if at_force >= 0.0 || gap >= 0.0 {
                return 0.0;
            }
            let closing = moved.min(0.0);
            let normal = match gap + maxwell > 0.0 {
                true => 0.5 * (gap - maxwell) * (gap - maxwell),
                false => (gap * gap + maxwell * maxwell - 2.0 * closing * closing).max(0.0),
            };
            p.weight * (normal + TANGENTIAL_STIFFNESS * p.tangential.iter().map(|u| u * u).sum::<f64>())
        });
        0.5 * stiffness * squares.sum::<f64>()
    }
}
