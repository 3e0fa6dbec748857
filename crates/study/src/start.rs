//! The force that starts a block sliding.
//!
//! A force at the centre of the block along its long axis grows slowly, from a settled state, until the block has moved [`SLID`] against what bears
//! it. Until then the force has gone on growing, so that reading is late: what moves has inertia, by an amount that depends on what moves along.
//! Therefore the states of the last frames of the ramp are kept, and from each the force is held still: a state from which the block goes on sliding is
//! past the force that starts it, one from which it does not is before it. Bisection finds two neighbours, and then what force more than the first the
//! block needs; the answer lies between the last that held and the first that did not.

use std::collections::VecDeque;

use glam::DVec3;
use teeter_physics::{AppliedForce, BodyId, Input, World};

use crate::settle::frames;

/// A block that has moved by this against what bears it has started to slide, m: a hundred times what contacts of 1e6 N/m give under a tight block.
pub const SLID: f64 = 0.5e-3;
/// The force at which a pull gives up, N.
pub const STRONGEST: f64 = 10.0;
/// How fast the force grows, N/s,
const RATE: f64 = 0.06;
/// and by how much faster for each newton that it has, 1/s: a tight block need not be known as finely as a loose one. Between two frames the force
/// grows by 1 mN and half a per cent.
const RATE_SHARE: f64 = 0.3;
/// How long the force is held still, s. What is pulled with 0.2 % more than friction of 0.4 holds has gone [`SLID`] by then.
const HOLD: f64 = 0.4;
/// Halvings of what the force grows by in a frame: half a per cent becomes 0.06 %.
const HALVINGS: usize = 3;
/// States of the ramp that are kept: 1.5 s. A loose block covers [`SLID`] in 0.1 s, a tower that turns above a tight one in some tenths.
const KEPT: usize = 90;

/// The force along `axis` (unit vector, world) that starts `body` sliding from the state of `settled`, N; none where [`STRONGEST`] does not.
pub fn starting_force(settled: &World, body: BodyId, axis: DVec3) -> Option<f64> {
    let block = Pulled::new(settled, body, axis);
    let mut world = settled.clone();
    let mut states = VecDeque::from([(0.0, world.clone())]);
    let mut force = 0.0;
    loop {
        force += world.params().frame * (RATE + RATE_SHARE * force);
        if force > STRONGEST {
            return None;
        }
        block.pull(&mut world, force);
        states.push_back((force, world.clone()));
        if block.slid(&world) >= SLID {
            break;
        }
        if states.len() > KEPT {
            states.pop_front();
        }
    }
    let (mut holds, mut slides) = (0, states.len() - 1);
    while slides - holds > 1 {
        let middle = (holds + slides) / 2;
        let (force, state) = &states[middle];
        if block.slides_from(state, *force) { slides = middle } else { holds = middle }
    }
    let state = &states[holds].1;
    let (mut low, mut high) = (states[holds].0, states[slides].0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if block.slides_from(state, middle) { high = middle } else { low = middle }
    }
    Some(0.5 * (low + high))
}

/// A block under a pull.
struct Pulled {
    body: BodyId,
    axis: DVec3,
    /// What bears it, with the share that each bears.
    bearers: Vec<(BodyId, f64)>,
    /// How far along the axis it was from its bearers, m.
    start: f64,
}

impl Pulled {
    fn new(world: &World, body: BodyId, axis: DVec3) -> Self {
        let contacts = world.contacts(body);
        let below = || contacts.iter().filter(|c| c.normal.z > 0.7);
        let borne: f64 = below().map(|c| c.force).sum();
        let bearers = below().filter_map(|c| Some((c.other?, c.force / borne))).collect();
        let mut block = Self { body, axis, bearers, start: 0.0 };
        block.start = block.slid(world);
        block
    }

    /// One frame at the end of which it is pulled with `force`, N.
    fn pull(&self, world: &mut World, force: f64) {
        world.step(&Input::force(AppliedForce::at_center(self.body, self.axis * force)));
    }

    /// How far it has slid on its bearers, m.
    fn slid(&self, world: &World) -> f64 {
        let place = |body| self.axis.dot(world.pose(body).position);
        let under: f64 = self.bearers.iter().map(|&(i, share)| share * place(i)).sum();
        place(self.body) - under - self.start
    }

    /// Whether it goes on to slide when a force is held.
    fn slides_from(&self, state: &World, force: f64) -> bool {
        let mut world = state.clone();
        let from = self.slid(&world);
        (0..frames(&world, HOLD)).any(|_| {
            self.pull(&mut world, force);
            self.slid(&world) - from >= SLID
        })
    }
}
