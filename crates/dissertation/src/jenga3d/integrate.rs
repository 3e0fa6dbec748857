//! Integration over lists of states (section 4.3.2).
//!
//! Every method computes forces through `forces`, which writes the force of each state of a list
//! from the positions and velocities of that list.

use super::options::Method;
use super::particle::{Particle, State, StateList};

/// Scheme of one integration.
///
/// ```
/// use teeter_dissertation::jenga3d::Constants;
///
/// let constants = Constants { iterations_per_frame: 4, ..Constants::default() };
/// assert_eq!(constants.scheme().steps, 4);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scheme {
    /// Method.
    pub method: Method,
    /// Number of steps of [`Method::Multi`].
    pub steps: u32,
    /// Time, s.
    pub time: f64,
}

/// Integrator with storage for intermediate states, so that a step allocates nothing.
///
/// ```
/// use glam::DVec3;
/// use teeter_dissertation::jenga3d::Method;
/// use teeter_dissertation::jenga3d::integrate::{Integrator, Scheme};
/// use teeter_dissertation::jenga3d::particle::{Particle, State};
///
/// let mut integrator = Integrator::new(Scheme { method: Method::Euler, steps: 1, time: 0.5 });
/// let (mut curr, mut next) = (vec![State::default()], vec![State::default()]);
/// let gravity = |states: &mut [State]| states[0].force = -10.0 * DVec3::Z;
/// integrator.integrate(&[Particle { mass: 1.0, block: 0 }], &mut curr, &mut next, gravity);
/// assert_eq!(next[0].velocity.z, -5.0);
/// ```
#[derive(Debug, Clone)]
pub struct Integrator {
    /// Scheme of the next integration.
    pub scheme: Scheme,
    intermediate: [StateList; 3],
}

impl Integrator {
    /// Creates an integrator.
    pub fn new(scheme: Scheme) -> Self {
        Self { scheme, intermediate: Default::default() }
    }

    /// Integrates from `curr` to `next`, and writes the forces of `curr`.
    pub fn integrate(
        &mut self,
        particles: &[Particle],
        curr: &mut StateList,
        next: &mut StateList,
        mut forces: impl FnMut(&mut [State]),
    ) {
        let Scheme { method, steps, time } = self.scheme;
        match method {
            Method::Euler => {
                forces(curr);
                euler(particles, curr, curr, next, time);
            }
            Method::Multi => {
                // Appendix 2.1.
                let time = time / f64::from(steps);
                forces(curr);
                euler(particles, curr, curr, next, time);
                for _ in 1..steps {
                    forces(next);
                    euler_in_place(particles, next, time);
                }
            }
            Method::Midpoint => {
                // Figure 4.12 with its lists corrected: forces of the states where they are
                // evaluated, positions by the velocity at the midpoint.
                let [temp, ..] = &mut self.intermediate;
                temp.clone_from(curr);
                forces(curr);
                slope_step(particles, curr, curr, temp, 0.5 * time);
                forces(temp);
                next.clone_from(curr);
                slope_step(particles, curr, temp, next, time);
            }
            Method::Rk4 => self.runge_kutta(particles, curr, next, forces),
        }
    }

    fn runge_kutta(
        &mut self,
        particles: &[Particle],
        curr: &mut StateList,
        next: &mut StateList,
        mut forces: impl FnMut(&mut [State]),
    ) {
        let time = self.scheme.time;
        let [k2, k3, k4] = &mut self.intermediate;
        for list in [&mut *k2, &mut *k3, &mut *k4, &mut *next] {
            list.clone_from(curr);
        }
        forces(curr);
        slope_step(particles, curr, curr, k2, 0.5 * time);
        forces(k2);
        slope_step(particles, curr, k2, k3, 0.5 * time);
        forces(k3);
        slope_step(particles, curr, k3, k4, time);
        forces(k4);
        for (i, end) in next.iter_mut().enumerate() {
            let velocity = (curr[i].velocity + 2.0 * (k2[i].velocity + k3[i].velocity) + k4[i].velocity) / 6.0;
            let force = (curr[i].force + 2.0 * (k2[i].force + k3[i].force) + k4[i].force) / 6.0;
            end.velocity = curr[i].velocity + force / particles[i].mass * time;
            end.position = curr[i].position + velocity * time;
        }
    }
}

/// Steps from `initial` with the forces of `source` to `dest` over `time`, s (Eq. 4.5): the
/// position moves with the new velocity.
pub fn euler(particles: &[Particle], initial: &[State], source: &[State], dest: &mut StateList, time: f64) {
    dest.resize(initial.len(), State::default());
    for (i, end) in dest.iter_mut().enumerate() {
        end.velocity = initial[i].velocity + source[i].force / particles[i].mass * time; // Eq. 4.5
        end.position = initial[i].position + end.velocity * time; // Eq. 4.5
    }
}

/// Euler step of one list in place.
fn euler_in_place(particles: &[Particle], list: &mut StateList, time: f64) {
    for (state, particle) in list.iter_mut().zip(particles) {
        state.velocity += state.force / particle.mass * time; // Eq. 4.4
        state.position += state.velocity * time; // Eq. 4.4
    }
}

/// Steps from `initial` to `dest` along the slope at `source`, including that of the position (Eq.
/// 2.4). Methods of higher order consist of such steps.
fn slope_step(particles: &[Particle], initial: &[State], source: &[State], dest: &mut StateList, time: f64) {
    for (i, end) in dest.iter_mut().enumerate() {
        end.velocity = initial[i].velocity + source[i].force / particles[i].mass * time;
        end.position = initial[i].position + source[i].velocity * time;
    }
}
