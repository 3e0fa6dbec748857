//! `teeter analyse`: chance that taking each block fells the tower, and the moves of a record.

mod text;

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use teeter_game::{
    BlockAnalysis, Breakdown, FallChance, MoveAnalysis, Record, Rules, Side, StickingContact, Survey, Table,
    TrialErrors, analyse_tower, breakdown, engine_id,
};
use teeter_physics::{BodyId, Params, World};
use teeter_report::progress;
use teeter_scene::Scene;
use teeter_study::settled;

use crate::arguments::number;
use crate::error::Error;
use crate::input::{self, Subject};
use crate::output;
use crate::warnings::Warnings;

/// Simulated time for which a settled tower goes on to rest, s.
const REST: f64 = 1.0;

/// Arguments of `teeter analyse`.
#[derive(Debug, Args)]
pub struct Analyse {
    /// File of a scene or of a record, `-` for standard input, or the name of a scene of the list.
    subject: PathBuf,
    /// Seed of the errors of hand and eye.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Simulated time of the rollouts, s: each block is tried once at the least, and again until it
    /// is used up. For a record, half is for its moves and half for the tower before the last one.
    #[arg(long, default_value_t = 1000.0, value_parser = number(0.0, 1e7), value_name = "SECONDS")]
    budget: f64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// A block of the tower.
#[derive(Debug, Serialize)]
struct Block {
    id: u32,
    #[serde(flatten)]
    chance: FallChance,
    #[serde(rename = "force_N")]
    force_n: Option<f64>,
    held_by: Vec<u32>,
    sticks_by: Vec<Sticks>,
    /// Share of the rollouts in which the block did not come out.
    chance_stuck: f64,
    /// True when rigid blocks fall without it.
    falls_by_statics: Option<bool>,
}

/// Contact that holds a block by friction.
#[derive(Debug, Serialize)]
struct Sticks {
    /// None for the floor.
    block: Option<u32>,
    side: Side,
    #[serde(rename = "load_N")]
    load_n: f64,
    #[serde(rename = "friction_N")]
    friction_n: f64,
}

/// A move of a record.
#[derive(Debug, Serialize)]
struct Move {
    turn: u32,
    player: u32,
    block: u32,
    at_s: f64,
    #[serde(flatten)]
    chance: FallChance,
    safest_block: Option<u32>,
    safest_chance: Option<f64>,
    blunder: bool,
    fell: bool,
}

/// Fall of a recorded tower.
#[derive(Debug, Serialize)]
struct Fall {
    at_s: f64,
    blocks: Vec<u32>,
    taken: u32,
    /// Loaded contact that was lost first.
    first_lost: Option<Lost>,
}

#[derive(Debug, Serialize)]
struct Lost {
    above: u32,
    /// None for the floor.
    below: Option<u32>,
    #[serde(rename = "load_N")]
    load_n: f64,
    at_s: f64,
}

#[derive(Debug, Serialize)]
struct Report {
    blocks: Vec<Block>,
    #[serde(flatten)]
    game: Option<GameReport>,
    warnings: Warnings,
}

/// Part of the report that only records have. Moves are named by their index in the list.
#[derive(Debug, Serialize)]
struct GameReport {
    moves: Vec<Move>,
    riskiest: Option<usize>,
    blunders: Vec<usize>,
    fall: Option<Fall>,
}

impl Analyse {
    /// Analyses a tower or a game and prints the report.
    pub fn run(self) -> Result<(), Error> {
        let (name, report) = match input::record_or_scene(&self.subject)? {
            Subject::Scene(scene) => (scene.name.clone(), self.scene(&scene)?),
            Subject::Record(record, name) => (record.scene.name.clone(), self.record(&record, &name)?),
        };
        if self.json { output::json(&report) } else { report.print(&name) }
    }

    fn survey(&self, rules: Rules, budget: f64) -> Survey {
        Survey { rules, errors: TrialErrors::default(), budget, seed: self.seed }
    }

    fn scene(&self, scene: &Scene) -> Result<Report, Error> {
        let build = |source| Error::Build { name: scene.name.clone(), source };
        let mut world = settled(scene, Params::default()).map_err(build)?;
        let mut warnings = Warnings::default();
        warnings.add_all_of(&world);
        world.run_for(REST);
        let survey = self.survey(Rules::of(Table::Official, 2), self.budget);
        Ok(Report { blocks: self.blocks(scene, &world, &survey)?, game: None, warnings })
    }

    fn record(&self, record: &Record, name: &str) -> Result<Report, Error> {
        let mut warnings = Warnings::default();
        if record.engine != engine_id() {
            warnings.add_engine(&record.engine, "its game is analysed as this engine plays it");
        }
        let survey = self.survey(record.rules, 0.5 * self.budget);
        let bar = progress(0, "rollouts");
        let breakdown = breakdown(record, &survey, || bar.inc(1));
        bar.finish_and_clear();
        let breakdown = breakdown.map_err(|source| Error::Record { name: name.to_owned(), source })?;
        let blocks = self.blocks(&record.scene, &breakdown.tower, &survey)?;
        let game = Some(GameReport::new(&record.scene, &breakdown));
        if breakdown.diverged {
            warnings.add("the replay is not the same as the record: moves can differ from those that were played");
        }
        Ok(Report { blocks, game, warnings })
    }

    fn blocks(&self, scene: &Scene, world: &World, survey: &Survey) -> Result<Vec<Block>, Error> {
        let bar = progress(0, "rollouts");
        let blocks = analyse_tower(world, survey, || bar.inc(1));
        bar.finish_and_clear();
        let blocks = blocks.map_err(|source| Error::Build { name: scene.name.clone(), source })?;
        Ok(blocks.iter().map(|block| Block::new(scene, block)).collect())
    }
}

/// Id of a body in its scene.
fn id(scene: &Scene, body: BodyId) -> u32 {
    scene.blocks[body.index()].id
}

impl Block {
    fn new(scene: &Scene, block: &BlockAnalysis) -> Self {
        Self {
            id: id(scene, block.candidate.body),
            chance: block.tally.falls.into(),
            force_n: block.force_n,
            held_by: block.held_by.iter().map(|body| id(scene, *body)).collect(),
            sticks_by: block.sticking.iter().map(|contact| Sticks::new(scene, contact)).collect(),
            chance_stuck: block.tally.stuck.share(),
            falls_by_statics: block.candidate.falls,
        }
    }
}

impl Sticks {
    fn new(scene: &Scene, contact: &StickingContact) -> Self {
        let StickingContact { other, side, load_n, friction_n } = *contact;
        Self { block: other.map(|body| id(scene, body)), side, load_n, friction_n }
    }
}

impl Move {
    fn new(scene: &Scene, played: &MoveAnalysis) -> Self {
        Self {
            turn: played.turn,
            player: played.player,
            block: id(scene, played.body),
            at_s: played.time_s,
            chance: played.falls.into(),
            safest_block: played.safest.map(|(body, _)| id(scene, body)),
            safest_chance: played.safest.map(|(_, falls)| falls.share()),
            blunder: played.is_blunder(),
            fell: played.fell,
        }
    }
}

impl GameReport {
    fn new(scene: &Scene, breakdown: &Breakdown) -> Self {
        let moves: Vec<Move> = breakdown.moves.iter().map(|played| Move::new(scene, played)).collect();
        let fall = breakdown.fall.as_ref().map(|fall| Fall {
            at_s: fall.time_s,
            blocks: fall.bodies.iter().map(|body| id(scene, *body)).collect(),
            taken: id(scene, fall.taken),
            first_lost: fall.first_lost.map(|lost| Lost {
                above: id(scene, lost.above),
                below: lost.below.map(|body| id(scene, body)),
                load_n: lost.load_n,
                at_s: lost.time_s,
            }),
        });
        Self {
            riskiest: breakdown.riskiest(),
            blunders: (0..moves.len()).filter(|index| moves[*index].blunder).collect(),
            moves,
            fall,
        }
    }
}
