//! Errors of a person's hand.

use std::f64::consts::TAU;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_scene::Random;

/// Frequencies of physiological tremor, Hz.
const TREMOR: [f64; 2] = [8.3, 11.1];
/// Deviations beyond which an error is drawn again, in standard deviations.
const MAX_DEVIATION: f64 = 2.5;

/// Size of the errors of a hand.
///
/// ```
/// use teeter_game::HandNoise;
///
/// let people = HandNoise::default();
/// assert_eq!((people.position, people.lag), (0.002, 0.15));
/// assert_eq!(HandNoise::none().tremor, 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HandNoise {
    /// Standard deviation of where the hand aims, along each axis, m.
    pub position: f64,
    /// Standard deviation of the angle at which it holds a block, rad.
    pub angle: f64,
    /// Time after which it reacts to what it sees and feels, s.
    pub lag: f64,
    /// Amplitude of its tremor along each axis, m.
    pub tremor: f64,
}

impl Default for HandNoise {
    /// People: 2 mm, 3 degrees, 150 ms, 0.2 mm.
    fn default() -> Self {
        Self { position: 0.002, angle: 3.0 * TAU / 360.0, lag: 0.15, tremor: 0.0002 }
    }
}

impl HandNoise {
    /// A hand without errors.
    pub fn none() -> Self {
        Self { position: 0.0, angle: 0.0, lag: 0.0, tremor: 0.0 }
    }
}

/// Source of a hand's errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    noise: HandNoise,
    random: Random,
    /// Phases of the tremor's parts along each axis, rad.
    phases: [[f64; 3]; 2],
    /// Time since the hand began, s.
    time: f64,
    /// Tremor at that time, m.
    tremor: DVec3,
}

impl Errors {
    /// Errors of a seed.
    pub fn new(noise: HandNoise, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let phases = std::array::from_fn(|_| std::array::from_fn(|_| TAU * random.uniform()));
        let mut errors = Self { noise, random, phases, time: 0.0, tremor: DVec3::ZERO };
        errors.tremor = errors.tremor_now();
        errors
    }

    /// Error of an aim, m.
    pub fn position(&mut self) -> DVec3 {
        let deviations = [0, 1, 2].map(|_| self.random.clipped_normal(MAX_DEVIATION));
        DVec3::from(deviations) * self.noise.position
    }

    /// Error of an angle, rad.
    pub fn angle(&mut self) -> f64 {
        self.random.clipped_normal(MAX_DEVIATION) * self.noise.angle
    }

    /// Displacement by tremor in a frame of `seconds`, m.
    pub fn shake(&mut self, seconds: f64) -> DVec3 {
        let before = self.tremor;
        self.time += seconds;
        self.tremor = self.tremor_now();
        self.tremor - before
    }

    fn tremor_now(&self) -> DVec3 {
        let part = |axis: usize| {
            let waves = TREMOR.iter().zip(&self.phases);
            waves.map(|(frequency, phase)| libm::sin(TAU * frequency * self.time + phase[axis])).sum::<f64>()
        };
        DVec3::new(part(0), part(1), part(2)) * (self.noise.tremor / TREMOR.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_their_size_and_no_bias_and_follow_from_the_seed() {
        let mut errors = Errors::new(HandNoise::default(), 5);
        assert_eq!(errors.clone().position(), Errors::new(HandNoise::default(), 5).position());
        assert_ne!(errors.clone().position(), Errors::new(HandNoise::default(), 6).position());
        let draws: Vec<f64> = (0..3000).flat_map(|_| errors.position().to_array()).collect();
        let mean = draws.iter().sum::<f64>() / draws.len() as f64;
        let sd = (draws.iter().map(|x| x * x).sum::<f64>() / draws.len() as f64).sqrt();
        // Normal deviates within 2.5 have a standard deviation of 0.955.
        assert!(mean.abs() < 1e-4 && (sd / 0.00191 - 1.0).abs() < 0.03, "{mean} {sd}");
        assert!(draws.iter().all(|x| x.abs() <= 0.005));
    }

    #[test]
    fn tremor_stays_within_its_amplitude_and_sums_to_nothing() {
        let mut errors = Errors::new(HandNoise::default(), 5);
        let (mut sum, mut largest) = (DVec3::ZERO, 0.0f64);
        let start = errors.tremor;
        for _ in 0..6000 {
            sum += errors.shake(1.0 / 60.0);
            largest = largest.max((start + sum).abs().max_element());
        }
        assert!(largest <= 0.000201 && largest > 0.0001, "{largest} m");
    }

    #[test]
    fn a_hand_without_errors_has_none() {
        let mut errors = Errors::new(HandNoise::none(), 1);
        assert_eq!((errors.position(), errors.angle(), errors.shake(0.1)), (DVec3::ZERO, 0.0, DVec3::ZERO));
    }
}
