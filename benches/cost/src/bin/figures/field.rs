//! Sixty-four towers and the threads that step them.

use std::time::Instant;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use teeter_cost::{Fault, Stretch, hex};
use teeter_physics::{Input, Params, World};
use teeter_scene::{TowerOptions, tower};

/// Towers in the field.
pub const TOWERS: u64 = 64;
/// Frames in which they settle, and frames that are measured.
const FRAMES: (usize, usize) = (120, 10);

/// Worlds of one tower each, no two alike, all awake and settled.
#[derive(Debug, Clone)]
pub struct Field {
    worlds: Vec<World>,
    states: Vec<Vec<u8>>,
}

impl Field {
    /// Builds and settles them.
    pub fn new() -> Result<Self, Fault> {
        let settled = |seed| {
            let scene = tower(&TowerOptions { seed, ..TowerOptions::default() }).map_err(|e| e.to_string())?;
            let mut world = World::new(&scene, Params { sleep: false, ..Params::default() }).map_err(|e| e.to_string())?;
            (0..FRAMES.0).for_each(|_| drop(world.step(&Input::default())));
            Ok(world)
        };
        let worlds: Vec<World> = (1..=TOWERS).into_par_iter().map(settled).collect::<Result<_, Fault>>()?;
        Ok(Self { states: worlds.iter().map(World::snapshot).collect(), worlds })
    }

    /// Steps all worlds side by side, frame by frame.
    pub fn play(&mut self, pool: &ThreadPool) -> Result<Stretch, Fault> {
        for (world, state) in self.worlds.iter_mut().zip(&self.states) {
            world.restore(state).map_err(|e| e.to_string())?;
        }
        let frames = (0..FRAMES.1).map(|_| {
            let start = Instant::now();
            pool.install(|| self.worlds.par_iter_mut().for_each(|world| drop(world.step(&Input::default()))));
            1e3 * start.elapsed().as_secs_f64()
        });
        let frames: Vec<f64> = frames.collect();
        let hash = self.worlds.iter().fold(0, |all: u64, world| all.rotate_left(1) ^ world.hash());
        // what several threads did is told by the clock on the wall alone
        Ok(Stretch { cpu: f64::NAN, frames, hash: hex(hash) })
    }
}

/// So many threads.
pub fn threads(count: usize) -> Result<ThreadPool, Fault> {
    ThreadPoolBuilder::new().num_threads(count).build().map_err(|e| e.to_string())
}
