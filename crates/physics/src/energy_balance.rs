//! Balance of the energy of a world over its steps.

use crate::report::StepReport;
use crate::world::World;

/// Energy that was put into a world and lost by it since a time, and what frames gained.
///
/// Contacts and springs dissipate, so a frame that gains energy which nobody put in is an error of
/// the simulation.
///
/// ```
/// use teeter_physics::{EnergyBalance, Input, Params, World};
///
/// let mut scene = teeter_scene::named("block").unwrap();
/// scene.blocks[0].pos[2] += 0.1;
/// let mut world = World::new(&scene, Params::default())?;
/// let mut balance = EnergyBalance::new(&world);
/// for _ in 0..120 {
///     let report = world.step(&Input::default());
///     balance.record(&world, &report);
/// }
/// // the block has landed and lost the energy of its fall
/// let fall = world.mass(teeter_physics::BodyId(0)) * 9.81 * 0.1;
/// assert!((balance.lost() / fall - 1.0).abs() < 1e-3);
/// assert!(balance.put_in() == 0.0 && balance.worst_share() < 1e-3);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct EnergyBalance {
    /// Energy at the start, J.
    start: f64,
    /// Energy after the last step, J.
    last: f64,
    /// Energy available after the last step, J.
    available: f64,
    put_in: f64,
    worst_gain: f64,
    worst_share: f64,
}

impl EnergyBalance {
    /// Begins a balance with the present energy of a world.
    pub fn new(world: &World) -> Self {
        let (start, available) = energies(world);
        Self { start, last: start, available, put_in: 0.0, worst_gain: 0.0, worst_share: 0.0 }
    }

    /// Adds a step of the world and its report.
    pub fn record(&mut self, world: &World, step: &StepReport) {
        let (now, available) = energies(world);
        let gain = now - self.last - step.put_in;
        self.worst_gain = self.worst_gain.max(gain);
        if gain > 0.0 {
            self.worst_share = self.worst_share.max(gain / (self.available + step.put_in.abs()));
        }
        (self.last, self.available) = (now, available);
        self.put_in += step.put_in;
    }

    /// Energy put in by the input, J; negative where the input took more than it gave.
    pub fn put_in(&self) -> f64 {
        self.put_in
    }

    /// Energy lost by friction, impacts and damping, J.
    pub fn lost(&self) -> f64 {
        self.start + self.put_in - self.last
    }

    /// Largest energy that a step gained and nobody put in, J; zero where none gained any.
    pub fn worst_gain(&self) -> f64 {
        self.worst_gain
    }

    /// Largest gain of a step over the energy available at its start: that of motion, springs and
    /// height above the floor, and what was put in.
    pub fn worst_share(&self) -> f64 {
        self.worst_share
    }
}

/// Energy of a world, and energy available, J.
fn energies(world: &World) -> (f64, f64) {
    let energy = world.energy();
    (energy.total(), energy.kinetic + energy.elastic + energy.potential.abs())
}
