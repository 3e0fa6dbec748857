//! Orders of the integrators on one particle on a spring, whose solution is a cosine.

use glam::DVec3;
use teeter_dissertation::jenga3d::Method;
use teeter_dissertation::jenga3d::integrate::{Integrator, Scheme, euler};
use teeter_dissertation::jenga3d::particle::{Particle, State};

const PARTICLE: [Particle; 1] = [Particle { mass: 1.0, block: 0 }];

fn start() -> Vec<State> {
    vec![State { position: DVec3::X, ..State::default() }]
}

fn spring(states: &mut [State]) {
    for state in states {
        state.force = -state.position;
    }
}

/// Returns the distance in phase space from the solution at t = 1 after `steps` steps.
fn error(steps: u32, mut step: impl FnMut(&mut Vec<State>, &mut Vec<State>, f64)) -> f64 {
    let (mut curr, mut next) = (start(), start());
    for _ in 0..steps {
        step(&mut curr, &mut next, 1.0 / f64::from(steps));
        std::mem::swap(&mut curr, &mut next);
    }
    let (x, v) = (libm::cos(1.0), -libm::sin(1.0));
    ((curr[0].position.x - x) * (curr[0].position.x - x) + (curr[0].velocity.x - v) * (curr[0].velocity.x - v)).sqrt()
}

/// Returns the binary logarithm of the ratio of errors when the step is halved.
fn order(steps: u32, mut step: impl FnMut(&mut Vec<State>, &mut Vec<State>, f64)) -> f64 {
    libm::log2(error(steps, &mut step) / error(2 * steps, &mut step))
}

/// Returns a step of a method.
fn step_by(method: Method, steps: u32) -> impl FnMut(&mut Vec<State>, &mut Vec<State>, f64) {
    let mut integrator = Integrator::new(Scheme { method, steps, time: 0.0 });
    move |curr, next, time| {
        integrator.scheme.time = time;
        integrator.integrate(&PARTICLE, curr, next, spring);
    }
}

#[test]
fn integrators_have_their_order() {
    for (method, expected) in [(Method::Euler, 1.0), (Method::Multi, 1.0), (Method::Midpoint, 2.0), (Method::Rk4, 4.0)]
    {
        let order = order(64, step_by(method, 4));
        assert!((order - expected).abs() < 0.05, "{} has order {order}", method.name());
    }
}

/// Four internal steps equal four steps.
#[test]
fn multi_is_euler_several_times() {
    let multi = error(16, step_by(Method::Multi, 4));
    let euler = error(64, step_by(Method::Euler, 1));
    assert!((multi - euler).abs() < 1e-14);
}

/// Figure 4.12 moves the positions by Eq. 4.5 with the velocity at the end of the step. With its
/// lists corrected it is still a method of the first order.
#[test]
fn figure_4_12_is_of_the_first_order() {
    let figure = |curr: &mut Vec<State>, next: &mut Vec<State>, h: f64| {
        let mut temp = Vec::new();
        spring(curr);
        euler(&PARTICLE, curr, curr, &mut temp, 0.5 * h);
        spring(&mut temp);
        euler(&PARTICLE, curr, &temp, next, h);
    };
    let order = order(64, figure);
    assert!((order - 1.0).abs() < 0.05, "order {order}");
}
