//! Long rest: whether a tower that stands goes on to stand still.

use serde::Serialize;
use teeter_physics::{Input, World};

use crate::places::Places;
use crate::settle::frames;

/// A tower at rest, with nothing asleep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rest {
    /// Simulated time, s.
    pub seconds: f64,
    /// Furthest that any block was from its place at the start, looked at every minute and at the end, m.
    pub creep_m: f64,
    /// Largest kinetic energy at any look, J.
    pub kinetic_j: f64,
    /// Largest change of potential energy from that at the start, J.
    pub potential_j: f64,
    /// Hash of the state at the end.
    pub hash: String,
}

/// Lets a settled world rest for `seconds`; `minute` is called after each minute.
pub fn rest(mut world: World, seconds: f64, gravity: f64, minute: impl Fn()) -> Rest {
    let (places, start) = (Places::of(&world), energies(&world, gravity));
    let mut seen = Rest { seconds, creep_m: 0.0, kinetic_j: 0.0, potential_j: 0.0, hash: String::new() };
    let (all, a_minute) = (frames(&world, seconds), frames(&world, 60.0));
    for i in 1..=all {
        world.step(&Input::default());
        if i % a_minute == 0 || i == all {
            let now = energies(&world, gravity);
            seen.creep_m = seen.creep_m.max(places.furthest(&world));
            seen.kinetic_j = seen.kinetic_j.max(now.0);
            seen.potential_j = seen.potential_j.max((now.1 - start.1).abs());
            minute();
        }
    }
    Rest { hash: format!("{:016x}", world.hash()), ..seen }
}

/// Kinetic energy of the centres and potential energy, J.
fn energies(world: &World, gravity: f64) -> (f64, f64) {
    let of = |body| {
        let (v, m) = (world.twist(body).velocity.to_array(), world.mass(body));
        (0.5 * m * v.iter().map(|v| v * v).sum::<f64>(), m * gravity * world.pose(body).position.z)
    };
    world.bodies().map(of).fold((0.0, 0.0), |sum, e| (sum.0 + e.0, sum.1 + e.1))
}
