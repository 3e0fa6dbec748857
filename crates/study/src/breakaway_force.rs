//! Breakaway force: the pull that starts a block sliding, measured on a world.
//!
//! From a settled state a force at the centre of the block along its long axis grows slowly, until
//! the block has slipped by [`SLIP_DISTANCE`] against its bearers. That reading is late: the force
//! grows on while the block and what moves along with it gain speed. So the last states of the ramp
//! are stored, and from each the force can be held constant: where the block goes on to slip the
//! force is above breakaway, elsewhere below. Bisection finds two neighbouring states, and then the
//! force between theirs.

use std::collections::VecDeque;

use glam::DVec3;
use teeter_physics::{AppliedForce, BodyId, Input, World};

/// Slip against its bearers from which a block slides, m: a hundred times what contacts of 1e6 N/m
/// give under a tight block.
pub const SLIP_DISTANCE: f64 = 0.5e-3;
/// Largest force tried, N.
pub const MAX_BREAKAWAY_FORCE: f64 = 10.0;

/// Rate of the force, N/s.
const RATE: f64 = 0.06;
/// Additional rate for each newton of the force, 1/s: a tight block need not be measured as finely
/// as a loose one. In a frame the force grows by 1 mN and half a per cent.
const RELATIVE_RATE: f64 = 0.3;
/// Time for which the force is held constant, s. A block pulled with 0.2 % more than friction of
/// 0.4 resists with slips by [`SLIP_DISTANCE`] within it.
const HOLD: f64 = 0.4;
/// Bisections of the force between two frames: half a per cent becomes 0.06 %.
const BISECTIONS: usize = 3;
/// Number of stored states of the ramp: 1.5 s. A loose block slips by [`SLIP_DISTANCE`] in 0.1 s, a
/// tower that turns above a tight one in some tenths.
const HISTORY: usize = 90;

/// Returns the force along `axis` (unit vector of the world) that starts `body` sliding from the
/// state of `settled`, N; none where [`MAX_BREAKAWAY_FORCE`] does not.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Params};
/// use teeter_study::{breakaway_force, settled};
///
/// let scene = teeter_scene::named("block").unwrap();
/// let force = breakaway_force(&settled(&scene, Params::default())?, BodyId(0), DVec3::X).unwrap();
/// let coulomb = scene.friction * scene.blocks[0].mass * scene.gravity;
/// assert!((force / coulomb - 1.0).abs() < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn breakaway_force(settled: &World, body: BodyId, axis: DVec3) -> Option<f64> {
    let block = PulledBlock::new(settled, body, axis);
    let states = block.ramp(settled)?;
    let (mut sticks, mut slides) = (0, states.len() - 1);
    while slides - sticks > 1 {
        let middle = (sticks + slides) / 2;
        let (force, state) = &states[middle];
        if block.slides_from(state, *force) { slides = middle } else { sticks = middle }
    }
    let state = &states[sticks].1;
    let (mut low, mut high) = (states[sticks].0, states[slides].0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if block.slides_from(state, middle) { high = middle } else { low = middle }
    }
    Some(0.5 * (low + high))
}

/// Block under a pull.
struct PulledBlock {
    body: BodyId,
    axis: DVec3,
    /// Bodies that bear it, each with its share of the load.
    bearers: Vec<(BodyId, f64)>,
    /// Position along the axis relative to the bearers at the start, m.
    start: f64,
}

impl PulledBlock {
    fn new(world: &World, body: BodyId, axis: DVec3) -> Self {
        let contacts = world.contacts(body);
        let below = || contacts.iter().filter(|c| c.normal.z > 0.7);
        let load: f64 = below().map(|c| c.force).sum();
        let bearers = below().filter_map(|c| Some((c.other?, c.force / load))).collect();
        let mut block = Self { body, axis, bearers, start: 0.0 };
        block.start = block.slip(world);
        block
    }

    /// Raises the force until the block slides. Returns the last forces (N), each with the state at
    /// the end of its frame; none where the largest force does not suffice.
    fn ramp(&self, settled: &World) -> Option<VecDeque<(f64, World)>> {
        let mut world = settled.clone();
        let mut states = VecDeque::from([(0.0, world.clone())]);
        let mut force = 0.0;
        loop {
            force += world.params().frame * (RATE + RELATIVE_RATE * force);
            if force > MAX_BREAKAWAY_FORCE {
                return None;
            }
            self.pull(&mut world, force);
            states.push_back((force, world.clone()));
            if self.slip(&world) >= SLIP_DISTANCE {
                return Some(states);
            }
            if states.len() > HISTORY {
                states.pop_front();
            }
        }
    }

    /// Advances by a frame under `force`, N.
    fn pull(&self, world: &mut World, force: f64) {
        world.step(&Input::force(AppliedForce::at_center(self.body, self.axis * force)));
    }

    /// Slip against the bearers, m.
    fn slip(&self, world: &World) -> f64 {
        let position = |body| self.axis.dot(world.pose(body).position);
        let bearers: f64 = self.bearers.iter().map(|&(i, share)| share * position(i)).sum();
        position(self.body) - bearers - self.start
    }

    /// Returns true if the block goes on to slide under a constant `force`, N.
    fn slides_from(&self, state: &World, force: f64) -> bool {
        let mut world = state.clone();
        let start = self.slip(&world);
        (0..world.frames(HOLD)).any(|_| {
            self.pull(&mut world, force);
            self.slip(&world) - start >= SLIP_DISTANCE
        })
    }
}
