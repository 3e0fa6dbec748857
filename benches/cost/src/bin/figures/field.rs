//! Many towers, each in a world of its own or all in one, and the threads that step them.

use std::time::Instant;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use teeter_cost::{Fault, Stretch, hex};
use teeter_physics::{Input, Params, World};
use teeter_scene::{Scene, TowerOptions, field, tower};

/// Frames in which towers settle, and frames that are measured.
const FRAMES: (usize, usize) = (120, 10);

/// Towers that stand and are kept awake, no two alike.
#[derive(Debug, Clone)]
pub struct Field {
    worlds: Vec<World>,
    states: Vec<Vec<u8>>,
}

impl Field {
    /// So many worlds of one tower.
    pub fn apart(towers: u32, pool: &ThreadPool) -> Result<Self, Fault> {
        let options = |i| TowerOptions { seed: 1 + u64::from(i), ..TowerOptions::default() };
        let scenes: Result<Vec<Scene>, _> = (0..towers).map(|i| tower(&options(i))).collect();
        Self::settled(&scenes.map_err(|e| e.to_string())?, pool)
    }

    /// The same towers in one world, side by side.
    pub fn together(towers: u32, pool: &ThreadPool) -> Result<Self, Fault> {
        Self::settled(&[field(towers, &TowerOptions::default()).map_err(|e| e.to_string())?], pool)
    }

    fn settled(scenes: &[Scene], pool: &ThreadPool) -> Result<Self, Fault> {
        let params = Params { sleep: false, ..Params::default() };
        let worlds: Result<Vec<World>, _> = scenes.iter().map(|scene| World::new(scene, params)).collect();
        let mut it = Self { worlds: worlds.map_err(|e| e.to_string())?, states: Vec::new() };
        (0..FRAMES.0).for_each(|_| it.step(pool));
        it.states = it.worlds.iter().map(World::snapshot).collect();
        Ok(it)
    }

    /// One frame: the worlds side by side, and what is side by side in each.
    fn step(&mut self, pool: &ThreadPool) {
        pool.install(|| self.worlds.par_iter_mut().for_each(|world| drop(world.step(&Input::default()))));
    }

    /// Plays the measured frames.
    pub fn play(&mut self, pool: &ThreadPool) -> Result<Stretch, Fault> {
        for (world, state) in self.worlds.iter_mut().zip(&self.states) {
            world.restore(state).map_err(|e| e.to_string())?;
        }
        let frames = (0..FRAMES.1).map(|_| {
            let start = Instant::now();
            self.step(pool);
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
