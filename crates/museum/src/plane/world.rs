//! World in the plane: rigid bodies or blocks of springs behind one interface.

use glam::DVec2;
use teeter_dissertation::flat::scene::{Rectangle, apart};
use teeter_dissertation::flat::{Rigid2D, Springs2D, rigid, springs};
use teeter_wasm_support::Error;

use super::options::{Options, Setting};

/// Distance between the rows of blocks of springs at the start, m, where they would be in contact.
const SPACING: f64 = 1e-4;

/// Prototype in the plane.
#[derive(Debug)]
pub enum World {
    Rigid(Rigid2D),
    Springs(Springs2D),
}

/// Counts of one step.
#[derive(Debug, Clone, Copy)]
pub struct StepCounts {
    /// Pairs resolved, impulses, or rounds over the pairs.
    pub iterations: u32,
    /// True when the step was cut short with pairs left.
    pub cut: bool,
    /// True when no forces were found for the resting contacts.
    pub unsolved: bool,
    /// Axes of rigid bodies tested, or points of springs against edges.
    pub tests: u64,
}

impl World {
    /// Builds a world, and returns it with the sizes of its blocks, m.
    ///
    /// # Errors
    /// When the blocks cannot be built.
    pub fn new(options: &Options) -> Result<(Self, Vec<DVec2>), Error> {
        let blocks = options.blocks()?;
        let sizes = blocks.iter().map(|b| b.size).collect();
        let world = match options.method.rigid() {
            Some(method) => {
                let default = rigid::Constants::of(method);
                let stiffness = options.stiffness.unwrap_or(default.stiffness);
                World::Rigid(Rigid2D::new(&blocks, rigid::Constants { stiffness, ..default }))
            }
            None => {
                let default = springs::Constants::default();
                let stiffness = options.stiffness.unwrap_or(default.stiffness);
                let blocks = if options.setting == Setting::Falling { blocks } else { apart(&blocks, SPACING) };
                World::Springs(Springs2D::new(&blocks, springs::Constants { stiffness, ..default }))
            }
        };
        Ok((world, sizes))
    }

    /// Time of a step, s.
    pub fn step_time(&self) -> f64 {
        match self {
            World::Rigid(world) => world.constants.step,
            World::Springs(world) => world.constants.step,
        }
    }

    /// Advances by one step.
    pub fn step(&mut self) -> StepCounts {
        match self {
            World::Rigid(world) => {
                let before = world.tester.counters.axes;
                let report = world.step();
                StepCounts {
                    iterations: report.iterations,
                    cut: report.capped,
                    unsolved: report.failure.is_some(),
                    tests: world.tester.counters.axes - before,
                }
            }
            World::Springs(world) => {
                let report = world.step();
                let blocks = world.len() as u64;
                // Four points against four edges, in both directions.
                let tests = u64::from(report.sweeps) * 32 * (blocks * blocks.saturating_sub(1) / 2);
                StepCounts { iterations: report.sweeps, cut: report.unresolved, unsolved: false, tests }
            }
        }
    }

    /// Corners of all blocks, counter-clockwise from the lower left, m.
    pub fn corners(&self) -> Vec<DVec2> {
        match self {
            World::Rigid(world) => world.bodies[1..].iter().flat_map(|b| b.corners()).collect(),
            World::Springs(world) => world.curr.iter().map(|s| s.position).collect(),
        }
    }

    /// Adds a block as number `index` with a velocity, m/s.
    pub fn add(&mut self, index: usize, block: &Rectangle, velocity: DVec2) {
        match self {
            World::Rigid(world) => {
                world.add(block);
                world.bodies[index + 1].velocity = velocity;
            }
            World::Springs(world) => {
                world.add(block);
                world.apply_impulse(index, DVec2::splat(0.5), velocity * block.mass);
            }
        }
    }

    /// Position of the centre (m) and rotation (rad) of a block.
    pub fn pose(&self, block: usize) -> (DVec2, f64) {
        match self {
            World::Rigid(world) => world.pose(block),
            World::Springs(world) => world.pose(block),
        }
    }

    /// Position (m) and velocity (m/s) of a point of a block, given as fractions of its edges.
    pub fn point(&self, block: usize, at: DVec2) -> (DVec2, DVec2) {
        match self {
            World::Rigid(world) => {
                let body = &world.bodies[block + 1];
                let [x, y] = body.axes();
                let local = (2.0 * at - 1.0) * body.half;
                let position = body.centre + local.x * x + local.y * y;
                (position, body.velocity_at(position))
            }
            World::Springs(world) => {
                let state = world.point(block, at);
                (state.position, state.velocity)
            }
        }
    }

    /// Applies an impulse (N s) at a point of a block, given as fractions of its edges.
    pub fn apply_impulse(&mut self, block: usize, at: DVec2, impulse: DVec2) {
        let (position, _) = self.point(block, at);
        match self {
            World::Rigid(world) => world.bodies[block + 1].apply_impulse(impulse, position),
            World::Springs(world) => world.apply_impulse(block, at, impulse),
        }
    }
}
