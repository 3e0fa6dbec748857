//! Rest and sleep. Sleep saves work and never judges stability: a body sleeps when for a while it has moved by no more than
//! [`REST_TRAVEL`] and was not accelerated, and with all that it touches.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::constants::{LEAST_BOUND, REST_ACCELERATION, REST_TIME, REST_TRAVEL};
use crate::island::islands;
use crate::manifold::Manifold;

/// Looks at each body after a frame of `frame` (s) and counts how long it has been at rest.
pub fn watch(shapes: &Shapes, bodies: &mut Bodies, frame: f64) {
    for i in 0..bodies.len() {
        if !bodies.moves(i) {
            continue;
        }
        let (v, w) = bodies.rest_velocity[i];
        let change = (bodies.velocity[i] - v).length() + (bodies.spin[i] - w).length() * shapes.radius[i];
        bodies.rest_velocity[i] = (bodies.velocity[i], bodies.spin[i]);
        if change > REST_ACCELERATION * frame || bodies.travel(shapes, i, bodies.rested[i]) > REST_TRAVEL {
            bodies.rest[i] = 0.0;
            bodies.rested[i] = (bodies.position[i], bodies.orientation[i]);
        } else {
            bodies.rest[i] += frame;
        }
    }
}

/// The islands of bodies that touch; what is quarantined joins nothing.
fn touching(bodies: &Bodies, manifolds: &[Manifold]) -> Vec<u32> {
    let out = |i: u32| i == FLOOR || bodies.quarantined[i as usize];
    let joined = manifolds.iter().filter(|m| !out(m.a) && !out(m.b) && m.points.iter().any(|p| p.gap < 0.0));
    islands(bodies.len(), joined.map(|m| (m.a, m.b)))
}

/// Puts to sleep every island of which all bodies have been at rest for [`REST_TIME`].
pub fn fall_asleep(bodies: &mut Bodies, manifolds: &[Manifold]) {
    if !(0..bodies.len()).any(|i| bodies.moves(i) && bodies.rest[i] >= REST_TIME) {
        return;
    }
    let island = touching(bodies, manifolds);
    let mut restless = vec![false; bodies.len()];
    for i in 0..bodies.len() {
        if bodies.moves(i) && bodies.rest[i] < REST_TIME {
            restless[island[i] as usize] = true;
        }
    }
    for i in 0..bodies.len() {
        if bodies.moves(i) && !restless[island[i] as usize] {
            bodies.asleep[i] = true;
            bodies.velocity[i] = glam::DVec3::ZERO;
            bodies.spin[i] = glam::DVec3::ZERO;
            bodies.acceleration[i] = 0.0;
        }
    }
}

/// Wakes every island that has a body in `who`.
pub fn wake(bodies: &mut Bodies, manifolds: &[Manifold], who: &[u32]) {
    if !who.iter().any(|&i| bodies.asleep[i as usize]) {
        return;
    }
    let island = touching(bodies, manifolds);
    let mut woken = vec![false; bodies.len()];
    for &i in who {
        woken[island[i as usize] as usize] = true;
    }
    for i in 0..bodies.len() {
        if woken[island[i] as usize] && bodies.asleep[i] {
            bodies.asleep[i] = false;
            bodies.rest[i] = 0.0;
            bodies.rested[i] = (bodies.position[i], bodies.orientation[i]);
            bodies.rest_velocity[i] = (bodies.velocity[i], bodies.spin[i]);
        }
    }
}

/// Sleeping bodies that something awake touches, or will soon. What lies still beside them without touching does not wake them: such
/// neighbours would wake each other in turn for ever.
pub fn disturbed(bodies: &Bodies, manifolds: &[Manifold], reach: &[f64]) -> Vec<u32> {
    let mut who = Vec::new();
    for manifold in manifolds.iter().filter(|m| m.a != FLOOR) {
        let (a, b) = (manifold.a as usize, manifold.b as usize);
        if bodies.asleep[a] == bodies.asleep[b] || bodies.quarantined[a] || bodies.quarantined[b] {
            continue;
        }
        let approach = (reach[a] + reach[b] - 2.0 * LEAST_BOUND).max(0.0);
        if manifold.points.iter().any(|p| p.gap < approach) {
            who.push(if bodies.asleep[a] { manifold.a } else { manifold.b });
        }
    }
    who
}
