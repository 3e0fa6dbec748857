//! Many towers, in worlds of their own or in one world, and the threads that step them.

use std::time::Instant;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use teeter_cost::{CostError, Measurement, hex};
use teeter_physics::{Input, Params, World};
use teeter_scene::{Scene, TowerOptions, field, tower};

/// Number of frames in which towers settle, and of measured frames.
const FRAMES: (usize, usize) = (120, 10);

/// Towers of different seeds at rest with sleep disabled.
#[derive(Debug, Clone)]
pub struct Field {
    worlds: Vec<World>,
    states: Vec<Vec<u8>>,
}

impl Field {
    /// Creates `towers` worlds of one tower each.
    pub fn apart(towers: u32, pool: &ThreadPool) -> Result<Self, CostError> {
        let options = |i| TowerOptions { seed: 1 + u64::from(i), ..TowerOptions::default() };
        let scenes: Result<Vec<Scene>, _> = (0..towers).map(|i| tower(&options(i))).collect();
        Self::settled(&scenes?, pool)
    }

    /// Creates one world of `towers` towers.
    pub fn together(towers: u32, pool: &ThreadPool) -> Result<Self, CostError> {
        Self::settled(&[field(towers, &TowerOptions::default())?], pool)
    }

    fn settled(scenes: &[Scene], pool: &ThreadPool) -> Result<Self, CostError> {
        let params = Params { sleep: false, ..Params::default() };
        let world = |scene: &Scene| {
            let error = |error| CostError::World { workload: scene.name.clone(), error };
            World::new(scene, params).map_err(error)
        };
        let worlds: Result<Vec<World>, CostError> = scenes.iter().map(world).collect();
        let mut field = Self { worlds: worlds?, states: Vec::new() };
        (0..FRAMES.0).for_each(|_| field.step(pool));
        field.states = field.worlds.iter().map(World::snapshot).collect();
        Ok(field)
    }

    /// Advances by one frame: worlds in parallel, and clusters in parallel in each world.
    fn step(&mut self, pool: &ThreadPool) {
        pool.install(|| self.worlds.par_iter_mut().for_each(|world| drop(world.step(&Input::default()))));
    }

    /// Plays the measured frames.
    pub fn play(&mut self, pool: &ThreadPool) -> Result<Measurement, CostError> {
        for (world, state) in self.worlds.iter_mut().zip(&self.states) {
            world.restore(state)?;
        }
        let frames = (0..FRAMES.1).map(|_| {
            let start = Instant::now();
            self.step(pool);
            1e3 * start.elapsed().as_secs_f64()
        });
        let frames: Vec<f64> = frames.collect();
        let hash = self.worlds.iter().fold(0, |all: u64, world| all.rotate_left(1) ^ world.hash());
        // Only wall-clock time is meaningful with several threads.
        Ok(Measurement { cpu: f64::NAN, frames, hash: hex(hash) })
    }
}

/// Creates a pool of `count` threads.
pub fn threads(count: usize) -> Result<ThreadPool, CostError> {
    ThreadPoolBuilder::new().num_threads(count).build().map_err(|e| CostError::Threads(e.to_string()))
}
