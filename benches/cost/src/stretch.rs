//! Playing the measured frames of a workload by the clock.

use std::time::Instant;

use cpu_time::ThreadTime;
use rayon::ThreadPoolBuilder;
use serde::Deserialize;
use teeter_physics::{Input, World};

use crate::{Fault, Workload, hex};

/// The measured frames, played once.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Processor time of all frames together, ms.
    pub cpu: f64,
    /// Time of each frame by the clock on the wall, ms.
    pub frames: Vec<f64>,
    /// Hash of the state after the last.
    pub hash: String,
}

/// A workload that is played again and again from its first measured frame.
#[derive(Debug)]
pub struct Clocked {
    world: World,
    state: Vec<u8>,
    inputs: Vec<Input>,
}

impl Clocked {
    /// Settles a workload.
    ///
    /// # Errors
    /// When the scene or a constant is not valid.
    pub fn new(workload: &Workload) -> Result<Self, Fault> {
        let world = workload.settled()?;
        Ok(Self { state: world.snapshot(), world, inputs: workload.measured() })
    }

    /// Plays the measured frames in this thread.
    ///
    /// # Errors
    /// Never in a sound engine: a world takes back its own state.
    pub fn play(&mut self) -> Result<Stretch, Fault> {
        self.world.restore(&self.state).map_err(|e| e.to_string())?;
        let cpu = ThreadTime::now();
        let frames = self.inputs.iter().map(|input| {
            let start = Instant::now();
            self.world.step(input);
            1e3 * start.elapsed().as_secs_f64()
        });
        let frames = frames.collect();
        Ok(Stretch { cpu: 1e3 * cpu.elapsed().as_secs_f64(), frames, hash: hex(self.world.hash()) })
    }
}

/// From here on worlds are stepped in this thread alone, however many parts of them could be stepped side by side.
///
/// # Errors
/// When rayon has its threads already.
pub fn one_thread() -> Result<(), Fault> {
    ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().map_err(|e| e.to_string())
}

/// The quartiles of some numbers: a quarter of them is below the first, half below the second.
///
/// # Panics
/// When there are none.
pub fn quartiles(values: &[f64]) -> [f64; 3] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    [0.25, 0.5, 0.75].map(|share| {
        let place = share * (sorted.len() - 1) as f64;
        let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
        low + (high - low) * place.fract()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_the_numbers() {
        assert_eq!(quartiles(&[5.0]), [5.0; 3]);
        assert_eq!(quartiles(&[4.0, 1.0, 3.0, 2.0, 5.0]), [2.0, 3.0, 4.0]);
        assert_eq!(quartiles(&[1.0, 2.0]), [1.25, 1.5, 1.75]);
    }

    #[test]
    fn each_play_of_a_workload_ends_in_the_same_state() {
        let workload = Workload::golden("collapse", 60).unwrap().of_frames(5);
        let mut clocked = Clocked::new(&workload).unwrap();
        let (one, two) = (clocked.play().unwrap(), clocked.play().unwrap());
        assert_eq!(one.hash, two.hash);
        assert_eq!(one.frames.len(), 5);
        let mut world = workload.world().unwrap();
        workload.inputs[..65].iter().for_each(|input| drop(world.step(input)));
        assert_eq!(one.hash, hex(world.hash()), "a state that was taken back goes on as if it had not been");
    }

    #[test]
    fn the_tower_that_sleeps_is_asleep() {
        let world = Workload::asleep().unwrap().settled().unwrap();
        assert!(world.bodies().all(|body| world.is_asleep(body)));
    }
}
