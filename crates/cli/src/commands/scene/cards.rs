//! `teeter scene cards`: a house of cards.

use clap::Args;
use teeter_scene::{CardsOptions, MAX_STOREYS, Scene, cards};

use crate::arguments::{Material, number};
use crate::error::Error;

/// Arguments of `teeter scene cards`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Cards {
    /// Storeys.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_STOREYS)))]
    storeys: u32,
    /// Distance of adjacent A-frames, mm, 57 to 95.1 [default: 70].
    #[arg(long, value_parser = number(57.0, 95.1), value_name = "MM")]
    pitch: Option<f64>,
    /// Radius of the edges of the cards, mm, at most a third of their thickness [default: 0.1].
    #[arg(long, value_parser = number(0.0, 0.7 / 3.0), value_name = "MM")]
    edge_radius: Option<f64>,
    /// Coefficient of static friction.
    #[arg(long, default_value_t = CardsOptions::default().friction, value_parser = number(0.0, 2.0))]
    friction: f64,
    #[command(flatten)]
    material: Material,
}

impl Cards {
    /// Builds the house.
    pub fn scene(&self) -> Result<Scene, Error> {
        let default = CardsOptions::default();
        let options = CardsOptions {
            pitch: self.pitch.map_or(default.pitch, |mm| 1e-3 * mm),
            edge_radius: self.edge_radius.map_or(default.edge_radius, |mm| 1e-3 * mm),
            friction: self.friction,
            ..default
        };
        Ok(self.material.apply(cards(self.storeys, &options)?))
    }
}
