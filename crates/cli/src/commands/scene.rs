//! `teeter scene`: prints scenes.

mod cards;

use clap::{Args, Parser, Subcommand};
use serde::Serialize;
use teeter_scene::{
    BlockPreset, MAX_ROWS, NAMED, Scene, Stability, TowerOptions, WOOD_RESTITUTION, config, field, loose, tower,
};

use crate::arguments::{Material, number};
use crate::error::Error;
use crate::{input, output};
use cards::Cards;

/// Arguments of `teeter scene`.
#[derive(Debug, Args)]
#[command(arg_required_else_help = true, disable_help_subcommand = true)]
pub struct Scenes {
    #[command(subcommand)]
    kind: Kind,
}

#[derive(Debug, Subcommand)]
#[command(subcommand_help_heading = "What", allow_external_subcommands = true)]
enum Kind {
    /// Print a full tower as JSON.
    Tower(Tower),
    /// Print the tower of a configuration such as (010)-(010)-(011) as JSON.
    Config(Config),
    /// Print a house of cards as JSON.
    Cards(Cards),
    /// List the scenes that have names; `teeter scene NAME` prints one.
    List(List),
    /// Words of a [`Named`] scene.
    #[command(external_subcommand)]
    Named(Vec<String>),
}

/// Arguments after `teeter scene` that begin with no subcommand.
#[derive(Debug, Parser)]
#[command(name = "teeter scene", no_binary_name = true, allow_negative_numbers = true)]
struct Named {
    /// Name of a scene of the list.
    name: String,
    #[command(flatten)]
    material: Material,
}

#[derive(Debug, Args)]
struct List {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
struct Tower {
    /// Rows of three.
    #[arg(long, default_value_t = 18, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_ROWS)))]
    rows: u32,
    /// Number of towers, half a metre apart in a square field.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    towers: u32,
    /// Standard deviation of the heights, mm; the maximum deviation is twice that.
    #[arg(long, default_value_t = 0.1, value_parser = number(0.0, 1.0), value_name = "MM")]
    height_sd: f64,
    /// Standard deviation of the masses, g [default: 1.85, in proportion for other blocks].
    #[arg(long, value_parser = number(0.0, 4.9), value_name = "G")]
    mass_sd: Option<f64>,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
struct Config {
    /// Rows from the bottom: 1 is a block, 0 is none, L is a loose block (0.2 mm lower).
    #[arg(long, required_unless_present = "loose", conflicts_with = "loose", value_name = "ROWS")]
    config: Option<String>,
    /// Loose blocks of a full tower: L is a loose block, 0 an ordinary one.
    #[arg(long, value_name = "ROWS")]
    loose: Option<String>,
    /// Standard deviation of the heights, mm.
    #[arg(long, default_value_t = 0.0, value_parser = number(0.0, 1.0), value_name = "MM")]
    height_sd: f64,
    /// Standard deviation of the masses, g.
    #[arg(long, default_value_t = 0.0, value_parser = number(0.0, 4.9), value_name = "G")]
    mass_sd: f64,
    #[command(flatten)]
    common: Common,
}

/// Options of all towers.
#[derive(Debug, Args)]
struct Common {
    /// Seed of the scatter of heights and masses.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Block preset: dissertation (81 x 26.8 x 18 mm, 19.6 g) or official (75 x 25 x 15 mm, 14.1
    /// g).
    #[arg(long, default_value_t = BlockPreset::Dissertation)]
    block: BlockPreset,
    /// Coefficient of static friction.
    #[arg(long, default_value_t = 0.4, value_parser = number(0.0, 2.0))]
    friction: f64,
    /// Coefficient of kinetic friction [default: that of static friction].
    #[arg(long, value_parser = number(0.0, 2.0))]
    kinetic_friction: Option<f64>,
    /// Coefficient of restitution.
    #[arg(long, default_value_t = WOOD_RESTITUTION, value_parser = number(0.0, 1.0))]
    restitution: f64,
    /// Radius of the edges of the blocks, mm, at most a third of their smallest edge [default: that
    /// of wooden blocks].
    #[arg(long, value_parser = number(0.0, 10.0), value_name = "MM")]
    edge_radius: Option<f64>,
    #[command(flatten)]
    material: Material,
}

impl Scenes {
    /// Prints a scene, or the list of those that have names.
    pub fn run(self) -> Result<(), Error> {
        let scene = match self.kind {
            Kind::List(list) => return list.print(),
            Kind::Tower(tower) => tower.scene()?,
            Kind::Config(config) => config.scene()?,
            Kind::Cards(cards) => cards.scene()?,
            Kind::Named(words) => {
                let named = Named::try_parse_from(words)?;
                named.material.apply(input::named_scene(&named.name)?)
            }
        };
        output::json(&scene)
    }
}

impl Common {
    fn options(&self) -> TowerOptions {
        let default = TowerOptions::default();
        TowerOptions {
            seed: self.seed,
            block: self.block,
            friction: self.friction,
            kinetic_friction: self.kinetic_friction,
            restitution: self.restitution,
            edge_radius: self.edge_radius.map_or(default.edge_radius, |mm| 1e-3 * mm),
            ..default
        }
    }
}

impl Tower {
    fn scene(&self) -> Result<Scene, Error> {
        let options = TowerOptions {
            rows: self.rows,
            height_sd: 1e-3 * self.height_sd,
            mass_sd: self.mass_sd.map(|grams| 1e-3 * grams),
            ..self.common.options()
        };
        let scene = if self.towers == 1 { tower(&options) } else { field(self.towers, &options) };
        Ok(self.common.material.apply(scene?))
    }
}

impl Config {
    fn scene(&self) -> Result<Scene, Error> {
        let options = TowerOptions {
            height_sd: 1e-3 * self.height_sd,
            mass_sd: Some(1e-3 * self.mass_sd),
            ..self.common.options()
        };
        let scene = match &self.loose {
            Some(rows) => loose(rows, &options),
            None => config(self.config.as_deref().unwrap_or_default(), &options),
        };
        Ok(self.common.material.apply(scene?))
    }
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    title: &'static str,
    expect: Option<Stability>,
}

#[derive(Serialize)]
struct Entries {
    scenes: Vec<Entry>,
}

impl List {
    fn print(&self) -> Result<(), Error> {
        if self.json {
            let entry =
                |scene: &teeter_scene::NamedScene| Entry { name: scene.name, title: scene.title, expect: scene.expect };
            return output::json(&Entries { scenes: NAMED.iter().map(entry).collect() });
        }
        let width = NAMED.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
        NAMED.iter().try_for_each(|scene| {
            let expect = scene.expect.map_or(String::new(), |stability| stability.to_string());
            output::line(&format!("{:width$}  {expect:8}  {}", scene.name, scene.title))
        })
    }
}
