//! Rest and sleep.
//!
//! Sleep saves work and never decides stability: an island sleeps when each of its bodies has moved
//! by no more than [`REST_TRAVEL`] for [`REST_TIME`], without acceleration.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::cluster::island::islands;
use crate::collision::manifold::Manifold;
use crate::constants::{MIN_TRAVEL_BUDGET, REST_ACCELERATION, REST_TIME, REST_TRAVEL};

/// Updates the time at rest of each active body after a frame of `frame` (s).
pub fn update_rest(shapes: &Shapes, bodies: &mut Bodies, frame: f64) {
    for i in 0..bodies.len() {
        if !bodies.is_active(i) {
            continue;
        }
        let (v, w) = bodies.rest_twist[i];
        let change = (bodies.velocity[i] - v).length() + (bodies.spin[i] - w).length() * shapes.radius[i];
        bodies.rest_twist[i] = (bodies.velocity[i], bodies.spin[i]);
        if change > REST_ACCELERATION * frame || bodies.travel_since(shapes, i, bodies.rest_pose[i]) > REST_TRAVEL {
            bodies.rest_time[i] = 0.0;
            bodies.rest_pose[i] = (bodies.position[i], bodies.orientation[i]);
        } else {
            bodies.rest_time[i] += frame;
        }
    }
}

/// Islands of bodies in contact, without floor and immovable bodies.
fn contact_islands(bodies: &Bodies, manifolds: &[Manifold]) -> Vec<u32> {
    let excluded = |i: u32| i == FLOOR || bodies.is_immovable(i as usize);
    let touching =
        manifolds.iter().filter(|m| !excluded(m.a) && !excluded(m.b) && m.points.iter().any(|p| p.gap < 0.0));
    islands(bodies.len(), touching.map(|m| (m.a, m.b)))
}

/// Puts to sleep every island whose bodies have all been at rest for [`REST_TIME`].
pub fn sleep(bodies: &mut Bodies, manifolds: &[Manifold]) {
    if !(0..bodies.len()).any(|i| bodies.is_active(i) && bodies.rest_time[i] >= REST_TIME) {
        return;
    }
    let island = contact_islands(bodies, manifolds);
    let mut restless = vec![false; bodies.len()];
    for i in 0..bodies.len() {
        if bodies.is_active(i) && bodies.rest_time[i] < REST_TIME {
            restless[island[i] as usize] = true;
        }
    }
    for i in 0..bodies.len() {
        if bodies.is_active(i) && !restless[island[i] as usize] {
            bodies.asleep[i] = true;
            bodies.velocity[i] = glam::DVec3::ZERO;
            bodies.spin[i] = glam::DVec3::ZERO;
            bodies.acceleration[i] = 0.0;
        }
    }
}

/// Wakes every island that contains a body in `targets`.
pub fn wake(bodies: &mut Bodies, manifolds: &[Manifold], targets: &[u32]) {
    if !targets.iter().any(|&i| bodies.asleep[i as usize]) {
        return;
    }
    let island = contact_islands(bodies, manifolds);
    let mut woken = vec![false; bodies.len()];
    for &i in targets {
        woken[island[i as usize] as usize] = true;
    }
    for i in 0..bodies.len() {
        if woken[island[i] as usize] && bodies.asleep[i] {
            bodies.asleep[i] = false;
            bodies.rest_time[i] = 0.0;
            bodies.rest_pose[i] = (bodies.position[i], bodies.orientation[i]);
            bodies.rest_twist[i] = (bodies.velocity[i], bodies.spin[i]);
        }
    }
}

/// Sleeping bodies that an awake body touches, or may touch within the travel budgets.
///
/// A neighbour at rest that does not touch a sleeping body does not wake it: otherwise such
/// neighbours would wake each other in turn forever.
pub fn find_disturbed(bodies: &Bodies, manifolds: &[Manifold], travel_budget: &[f64]) -> Vec<u32> {
    let mut disturbed = Vec::new();
    for manifold in manifolds.iter().filter(|m| m.a != FLOOR) {
        let (a, b) = (manifold.a as usize, manifold.b as usize);
        if bodies.asleep[a] == bodies.asleep[b] || bodies.is_immovable(a) || bodies.is_immovable(b) {
            continue;
        }
        let approach = (travel_budget[a] + travel_budget[b] - 2.0 * MIN_TRAVEL_BUDGET).max(0.0);
        if manifold.points.iter().any(|p| p.gap < approach) {
            disturbed.push(if bodies.asleep[a] { manifold.a } else { manifold.b });
        }
    }
    disturbed
}
