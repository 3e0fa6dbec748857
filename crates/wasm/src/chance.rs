//! Chance of a fall, by rollouts.

use serde::Serialize;
use teeter_game::Proportion;

/// Share of the rollouts in which a block fell, and the ends of its interval of 95 %.
#[derive(Debug, Serialize)]
pub struct Chance {
    chance_of_fall: f64,
    low: f64,
    high: f64,
    rollouts: u32,
}

impl From<Proportion> for Chance {
    fn from(falls: Proportion) -> Self {
        let [low, high] = falls.interval();
        Self { chance_of_fall: falls.share(), low, high, rollouts: falls.tries }
    }
}
