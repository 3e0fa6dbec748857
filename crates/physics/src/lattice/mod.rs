//! The lattice: a block of eight particles and 28 springs, one between each two of them (dissertation, section 4.1).
//!
//! A particle is at the signs (±1, ±1, ±1) times `g` from the centre, bit k of its number set for +1 along axis k. Surfaces follow the
//! affine part of their displacements, x = c + F l with F = Σ_i p_i s_ik / (8 g_k) ⊗ e_k, and a force at a place l of the surface goes to the
//! particles by virtual work, f_i = f / 8 + Σ_k f l_k s_ik / (8 g_k). A block of rigid particles is thus a rigid body.
//!
//! State is the rigid pose that fits best, and the displacements of the particles from their places in it: no length of a spring is ever
//! formed from places, which in single precision would be wrong by more than what a load does to it.

#![allow(clippy::needless_range_loop, reason = "one index for several arrays of particles")]

mod lanes;
mod springs;
#[cfg(test)]
mod tests;

pub use lanes::Lattice;
use springs::{SPRINGS, ends};
pub use springs::{STRAIN_INERTIA, Springs};

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, Shapes, turned};
use crate::report::LatticeReport;

/// Particles of a block.
pub const PARTICLES: usize = 8;
/// Rounds of the fit of a rotation. It need not be exact, for the particles keep their places whatever the pose; each round leaves of the
/// error what the block is strained.
const FIT_ROUNDS: usize = 4;

/// The particles of a block.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Particles {
    /// Displacements from their places in the rigid pose, in the body's frame, m.
    pub shift: [DVec3; PARTICLES],
    /// Velocities in the world, m/s.
    pub velocity: [DVec3; PARTICLES],
}

impl Particles {
    /// Unstrained ones of a body that moves as a whole; `half` are those of its particles.
    pub fn of_rigid(half: DVec3, orientation: DQuat, velocity: DVec3, spin: DVec3) -> Self {
        let mut particles = Self::default();
        particles.set_motion(half, orientation, velocity, spin);
        particles
    }

    /// Moves them as a whole.
    pub fn set_motion(&mut self, half: DVec3, orientation: DQuat, velocity: DVec3, spin: DVec3) {
        for i in 0..PARTICLES {
            self.velocity[i] = velocity + spin.cross(orientation * (place(half, i) + self.shift[i]));
        }
    }

    /// Where they are, and how the springs pull, in a block at a pose.
    pub fn report(&self, half: DVec3, (center, axes): (DVec3, DMat3), springs: &Springs) -> LatticeReport {
        let mut at = [DVec3::ZERO; PARTICLES];
        for (i, at) in at.iter_mut().enumerate() {
            *at = place(half, i) + self.shift[i];
        }
        let mut forces = [0.0; SPRINGS];
        for (n, force) in forces.iter_mut().enumerate() {
            let (i, j, _) = ends(n);
            let (rest, now) = ((place(half, j) - place(half, i)).length(), (at[j] - at[i]).length());
            // the law of [`springs::spring`]
            *force = springs.stiffness * (now * now - rest * rest) / (2.0 * rest * rest) * now;
        }
        LatticeReport { particles: at.map(|at| center + axes * at), forces }
    }

    /// Displacements of the particles that are not affine leave it; what is left is R⁻¹ F.
    pub fn stretch(&self, half: DVec3) -> DMat3 {
        gradient(&self.shift, half) + DMat3::IDENTITY
    }
}

/// Sign of particle `i` along axis `k`.
#[inline(always)]
pub const fn sign(i: usize, k: usize) -> f64 {
    if i >> k & 1 == 1 { 1.0 } else { -1.0 }
}

/// Place of particle `i` in the body's frame, m.
pub fn place(half: DVec3, i: usize) -> DVec3 {
    half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2))
}

/// The affine part of vectors at the particles: the change of the vector along each axis, as columns.
pub fn gradient(x: &[DVec3; PARTICLES], half: DVec3) -> DMat3 {
    let mut columns = [DVec3::ZERO; 3];
    for (i, x) in x.iter().enumerate() {
        for (k, column) in columns.iter_mut().enumerate() {
            *column += *x * sign(i, k);
        }
    }
    let [x, y, z] = columns;
    DMat3::from_cols(x / (8.0 * half.x), y / (8.0 * half.y), z / (8.0 * half.z))
}

fn mean(x: &[DVec3; PARTICLES]) -> DVec3 {
    x.iter().sum::<DVec3>() / PARTICLES as f64
}

/// The rotation nearest to `f`, from one that is near already: turned by what the columns still differ, after Müller, Bender, Chentanez and
/// Macklin, A robust method to extract the rotational part of deformations (2016), with a step that is exact where nothing is strained.
fn nearest_rotation(f: DMat3, start: DQuat) -> DQuat {
    let mut q = start;
    for _ in 0..FIT_ROUNDS {
        let r = DMat3::from_quat(q);
        let cross = r.x_axis.cross(f.x_axis) + r.y_axis.cross(f.y_axis) + r.z_axis.cross(f.z_axis);
        let along = r.x_axis.dot(f.x_axis) + r.y_axis.dot(f.y_axis) + r.z_axis.dot(f.z_axis);
        // crushed to nothing there is no rotation to find
        q = turned(q, cross * (1.5 / along.abs().max(0.5)));
    }
    q
}

/// Moves body `i` by what the inner loop did to its particles in `time` (s). Where it flew, `flight` has how its centre moved: displacement
/// (m) and velocity (m/s).
pub fn advance(
    shapes: &Shapes,
    bodies: &mut Bodies,
    i: usize,
    particles: &mut Particles,
    moved: &[(DVec3, DVec3); PARTICLES],
    flight: Option<(DVec3, DVec3)>,
    time: f64,
) {
    let (half, q0) = (shapes.particles[i], bodies.orientation[i]);
    let mut at = [DVec3::ZERO; PARTICLES];
    let mut velocity = [DVec3::ZERO; PARTICLES];
    for (j, &(shift, v)) in moved.iter().enumerate() {
        at[j] = q0 * place(half, j) + shift;
        velocity[j] = v;
    }
    let (found_shift, found_velocity) = (mean(&at), mean(&velocity));
    let (shift, center_velocity) = flight.unwrap_or((found_shift, found_velocity));
    let correction = center_velocity - found_velocity;
    let mut momentum = DVec3::ZERO;
    for j in 0..PARTICLES {
        at[j] -= found_shift;
        momentum += at[j].cross(velocity[j]) * (shapes.mass[i] / PARTICLES as f64);
        particles.velocity[j] = velocity[j] + correction;
    }
    let q = nearest_rotation(gradient(&at, half), q0);
    for j in 0..PARTICLES {
        particles.shift[j] = q.conjugate() * at[j] - place(half, j);
    }
    bodies.acceleration[i] = (center_velocity - bodies.velocity[i]).length() / time;
    bodies.position[i] += shift;
    bodies.orientation[i] = q;
    bodies.velocity[i] = center_velocity;
    bodies.spin[i] = bodies.inv_inertia(shapes, i) * momentum;
    bodies.stretch[i] = particles.stretch(half);
}

/// Takes the velocities of particles of bodies that do not move.
pub fn halt(bodies: &Bodies, particles: &mut [Particles]) {
    for (i, particles) in particles.iter_mut().enumerate().filter(|&(i, _)| !bodies.moves(i)) {
        debug_assert!(bodies.velocity[i] == DVec3::ZERO);
        particles.velocity = [DVec3::ZERO; PARTICLES];
    }
}

/// The moment M = Σ f ⊗ l of forces that turn a block as a whole with a torque (N m): those that give each particle the acceleration of the
/// turning body, from the edges between its particles (m, in the world).
pub fn whole_moment(torque: DVec3, edges: &[DVec3; 3]) -> DMat3 {
    let squares = edges.map(|e| e.length_squared());
    let total: f64 = squares.iter().sum();
    let turning: DVec3 = (0..3).map(|k| edges[k] * (edges[k].dot(torque) / (squares[k] * (total - squares[k])))).sum();
    edges.iter().map(|&e| outer(turning.cross(e), e)).fold(DMat3::ZERO, |sum, m| sum + m)
}

/// a ⊗ b.
pub fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
