//! Stepping forward in time (section 4.3.2), over lists of states.
//!
//! Every integrator asks for forces through `forces`, which must write the force of each state from the positions and velocities of the
//! list that it is given.

use super::particle::{Particle, State, StateList};

/// How the states are stepped forward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Euler's method, once over the whole time.
    Euler,
    /// Euler's method several times over, the one that the simulator uses (section 5.5.2).
    Multi,
    /// The midpoint method.
    Midpoint,
    /// Runge-Kutta of the fourth order.
    Rk4,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 4] = [Method::Euler, Method::Multi, Method::Midpoint, Method::Rk4];

    /// Its name in an ini file.
    pub fn name(self) -> &'static str {
        match self {
            Method::Euler => "euler",
            Method::Multi => "multi",
            Method::Midpoint => "midpoint",
            Method::Rk4 => "rk4",
        }
    }
}

/// Room for the states between, so that a step allocates nothing.
#[derive(Debug, Clone, Default)]
pub struct Between {
    lists: [StateList; 3],
}

/// Steps from `curr` to `next` over `time` (s). The forces of `curr` are written; `steps` is read by [`Method::Multi`] only.
#[allow(clippy::too_many_arguments)]
pub fn integrate(
    method: Method,
    steps: u32,
    time: f64,
    particles: &[Particle],
    curr: &mut StateList,
    next: &mut StateList,
    between: &mut Between,
    mut forces: impl FnMut(&mut [State]),
) {
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
                euler_on(particles, next, time);
            }
        }
        Method::Midpoint => {
            // Figure 4.12 with the lists in their places: forces of the states where they are taken, positions by the velocity halfway.
            let [temp, ..] = &mut between.lists;
            temp.clone_from(curr);
            forces(curr);
            slope_step(particles, curr, curr, temp, 0.5 * time);
            forces(temp);
            next.clone_from(curr);
            slope_step(particles, curr, temp, next, time);
        }
        Method::Rk4 => {
            let [k2, k3, k4] = &mut between.lists;
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
}

/// From `initial` with the forces of `source` to `dest` over `time` (Eq. 4.5): the position moves with the new velocity.
pub fn euler(particles: &[Particle], initial: &[State], source: &[State], dest: &mut StateList, time: f64) {
    dest.resize(initial.len(), State::default());
    for (i, end) in dest.iter_mut().enumerate() {
        end.velocity = initial[i].velocity + source[i].force / particles[i].mass * time; // Eq. 4.5
        end.position = initial[i].position + end.velocity * time; // Eq. 4.5
    }
}

/// [`euler`] with one list in all three places.
fn euler_on(particles: &[Particle], list: &mut StateList, time: f64) {
    for (state, particle) in list.iter_mut().zip(particles) {
        state.velocity += state.force / particle.mass * time; // Eq. 4.4
        state.position += state.velocity * time; // Eq. 4.4
    }
}

/// From `initial` along the slope at `source`, position included (Eq. 2.4): what methods of higher order are made of.
fn slope_step(particles: &[Particle], initial: &[State], source: &[State], dest: &mut StateList, time: f64) {
    for (i, end) in dest.iter_mut().enumerate() {
        end.velocity = initial[i].velocity + source[i].force / particles[i].mass * time;
        end.position = initial[i].position + source[i].velocity * time;
    }
}
