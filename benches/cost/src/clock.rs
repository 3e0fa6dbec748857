//! Timing of the measured frames of a workload.

use std::time::Instant;

use cpu_time::ThreadTime;
use rayon::ThreadPoolBuilder;
use serde::Deserialize;
use teeter_physics::{Input, World};

use crate::error::CostError;
use crate::hash::hex;
use crate::workload::Workload;

/// Measurement of one playback of the measured frames.
///
/// ```
/// use teeter_cost::Measurement;
///
/// let measurement = Measurement { cpu: 3.0, frames: vec![1.0, 2.0], hash: teeter_cost::hex(7) };
/// assert_eq!(measurement.hash, "0000000000000007");
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measurement {
    /// Processor time of all frames together, ms.
    pub cpu: f64,
    /// Wall-clock time of each frame, ms.
    pub frames: Vec<f64>,
    /// Hash of the state after the last frame.
    pub hash: String,
}

/// Workload that is played repeatedly from its first measured frame.
///
/// ```no_run
/// use teeter_cost::{Clocked, Workload};
///
/// let mut clocked = Clocked::new(&Workload::springs().expect("a valid scene")).expect("a valid scene");
/// println!("{} ms", clocked.play().expect("its own state").cpu);
/// ```
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
    pub fn new(workload: &Workload) -> Result<Self, CostError> {
        let world = workload.settled()?;
        Ok(Self { state: world.snapshot(), world, inputs: workload.measured() })
    }

    /// Plays the measured frames in this thread.
    ///
    /// # Errors
    /// Never for a correct engine: a world restores its own state.
    pub fn play(&mut self) -> Result<Measurement, CostError> {
        self.world.restore(&self.state)?;
        let cpu = ThreadTime::now();
        let frames = self.inputs.iter().map(|input| {
            let start = Instant::now();
            self.world.step(input);
            1e3 * start.elapsed().as_secs_f64()
        });
        let frames = frames.collect();
        Ok(Measurement { cpu: 1e3 * cpu.elapsed().as_secs_f64(), frames, hash: hex(self.world.hash()) })
    }
}

/// Limits rayon to this thread.
///
/// # Errors
/// When the global thread pool exists already.
pub fn one_thread() -> Result<(), CostError> {
    ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .map_err(|e| CostError::Threads(e.to_string()))
}

/// Returns the quartiles of some numbers, linearly interpolated.
///
/// # Panics
/// When there are no numbers.
pub fn quartiles(values: &[f64]) -> [f64; 3] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    [0.25, 0.5, 0.75].map(|share| {
        let rank = share * (sorted.len() - 1) as f64;
        let (low, high) = (sorted[rank.floor() as usize], sorted[rank.ceil() as usize]);
        low + (high - low) * rank.fract()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_interpolate_between_the_numbers() {
        assert_eq!(quartiles(&[5.0]), [5.0; 3]);
        assert_eq!(quartiles(&[4.0, 1.0, 3.0, 2.0, 5.0]), [2.0, 3.0, 4.0]);
        assert_eq!(quartiles(&[1.0, 2.0]), [1.25, 1.5, 1.75]);
    }

    #[test]
    fn each_playback_ends_in_the_same_state() {
        let workload = Workload::golden("collapse", 60).unwrap().of_frames(5);
        let mut clocked = Clocked::new(&workload).unwrap();
        let (first, second) = (clocked.play().unwrap(), clocked.play().unwrap());
        assert_eq!(first.hash, second.hash);
        assert_eq!(first.frames.len(), 5);
        let mut world = workload.world().unwrap();
        workload.inputs[..65].iter().for_each(|input| drop(world.step(input)));
        assert_eq!(first.hash, hex(world.hash()), "restoring changes no later state");
    }

    #[test]
    fn the_sleeping_tower_is_asleep() {
        let world = Workload::asleep().unwrap().settled().unwrap();
        assert!(world.bodies().all(|body| world.is_asleep(body)));
    }
}
