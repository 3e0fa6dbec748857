//! Bindings of analyses: chances of a fall, block by block and move by move, a step at a time.

use serde::Serialize;
use teeter_game::{
    BlockAnalysis, BreakdownRun, FallAnalysis, FallChance, LostContact, MoveAnalysis, Record, Replay, Rules,
    StickingContact, Survey, Table, TrialErrors, load_world,
};
use teeter_physics::BodyId;
use wasm_bindgen::prelude::*;

use crate::{Error, text};

/// Analysis of a tower at rest: the chance that taking each block fells it.
#[wasm_bindgen]
#[derive(Debug)]
pub struct TowerAnalysis(teeter_game::TowerAnalysis);

#[wasm_bindgen]
impl TowerAnalysis {
    /// Begins with the world of `Game.world` or `Replay.world`, the rules (JSON; official for two
    /// players where empty), the seed of the errors of hand and eye, and the simulated time of the
    /// rollouts, s: each block is tried once at the least, and again until it is used up.
    #[wasm_bindgen(constructor)]
    pub fn new(world: &[u8], rules: &str, seed: u32, budget: f64) -> Result<TowerAnalysis, Error> {
        let rules =
            if rules.trim().is_empty() { Rules::of(Table::Official, 2) } else { text::read_all("rules", rules)? };
        let world = load_world(world).map_err(Error::rejected)?;
        Ok(Self(teeter_game::TowerAnalysis::new(world, survey(rules, seed, budget))))
    }

    /// Makes a rollout or pulls at a block, and returns the part of the work that is done, 1 at the
    /// end.
    pub fn step(&mut self) -> Result<f64, Error> {
        self.0.step().map_err(Error::rejected)?;
        Ok(self.0.progress())
    }

    /// The blocks so far, as JSON: `[{"body", "chance_of_fall", "low", "high", "rollouts",
    /// "force_N", "held_by", "sticks_by": [{"body", "side", "load_N", "friction_N"}],
    /// "chance_stuck", "falls_by_statics"}]`. The interval is that of 95 %; the force is null above
    /// 10 N and before it is known; a body that is null is the floor, and the side `above`, `below`
    /// or `beside`.
    pub fn blocks(&self) -> Result<String, Error> {
        let blocks: Vec<Block> = self.0.blocks().iter().map(Block::new).collect();
        text::write("blocks", &blocks)
    }
}

fn survey(rules: Rules, seed: u32, budget: f64) -> Survey {
    let budget = if budget.is_finite() { budget.max(0.0) } else { 0.0 };
    Survey { rules, errors: TrialErrors::default(), budget, seed: u64::from(seed) }
}

#[derive(Serialize)]
struct Block {
    body: BodyId,
    #[serde(flatten)]
    chance: FallChance,
    #[serde(rename = "force_N")]
    force_n: Option<f64>,
    held_by: Vec<BodyId>,
    sticks_by: Vec<StickingContact>,
    chance_stuck: f64,
    falls_by_statics: Option<bool>,
}

impl Block {
    fn new(block: &BlockAnalysis) -> Self {
        Self {
            body: block.candidate.body,
            chance: block.tally.falls.into(),
            force_n: block.force_n,
            held_by: block.held_by.clone(),
            sticks_by: block.sticking.clone(),
            chance_stuck: block.tally.stuck.share(),
            falls_by_statics: block.candidate.falls,
        }
    }
}

/// Analysis of a record: the chance of each move, the riskiest, the blunders, and why it fell.
#[wasm_bindgen]
#[derive(Debug)]
pub struct RecordAnalysis(BreakdownRun<'static>);

#[wasm_bindgen]
impl RecordAnalysis {
    /// Begins with a record (bytes), the seed of the errors, and the simulated time of the rollouts
    /// of all moves, s.
    #[wasm_bindgen(constructor)]
    pub fn new(record: &[u8], seed: u32, budget: f64) -> Result<RecordAnalysis, Error> {
        let record = Record::decode(record).map_err(Error::rejected)?;
        let survey = survey(record.rules, seed, budget);
        Ok(Self(BreakdownRun::new(Replay::owning(record).map_err(Error::rejected)?, survey)))
    }

    /// Replays a second or makes a rollout, and returns the part of the work that is done, 1 at the
    /// end.
    pub fn step(&mut self) -> Result<f64, Error> {
        self.0.step().map_err(Error::rejected)?;
        Ok(self.0.progress())
    }

    /// The moves so far, as JSON: `{"moves": [{"turn", "player", "body", "at_s", "chance_of_fall",
    /// "low", "high", "rollouts", "safest": {"body", "chance_of_fall", ...} | null, "blunder",
    /// "fell"}], "riskiest": index | null, "fall": {"at_s", "bodies", "taken", "first_lost":
    /// {"above", "below", "load_N", "at_s"} | null} | null, "diverged"}`. Players count from 0,
    /// `below` is null for the floor, and a replay that diverged may play other moves than the
    /// record.
    pub fn report(&self) -> Result<String, Error> {
        let breakdown = self.0.clone().finish();
        let report = Report {
            riskiest: breakdown.riskiest(),
            moves: breakdown.moves.iter().map(Move::new).collect(),
            fall: breakdown.fall.as_ref().map(Fall::new),
            diverged: breakdown.diverged,
        };
        text::write("report", &report)
    }
}

#[derive(Serialize)]
struct Report {
    moves: Vec<Move>,
    riskiest: Option<usize>,
    fall: Option<Fall>,
    diverged: bool,
}

#[derive(Serialize)]
struct Move {
    turn: u32,
    player: u32,
    body: BodyId,
    at_s: f64,
    #[serde(flatten)]
    chance: FallChance,
    safest: Option<Safest>,
    blunder: bool,
    fell: bool,
}

/// Safest of the other moves that were tried.
#[derive(Serialize)]
struct Safest {
    body: BodyId,
    #[serde(flatten)]
    chance: FallChance,
}

impl Move {
    fn new(played: &MoveAnalysis) -> Self {
        Self {
            turn: played.turn,
            player: played.player,
            body: played.body,
            at_s: played.time_s,
            chance: played.falls.into(),
            safest: played.safest.map(|(body, falls)| Safest { body, chance: falls.into() }),
            blunder: played.is_blunder(),
            fell: played.fell,
        }
    }
}

#[derive(Serialize)]
struct Fall {
    at_s: f64,
    bodies: Vec<BodyId>,
    taken: BodyId,
    first_lost: Option<LostContact>,
}

impl Fall {
    fn new(fall: &FallAnalysis) -> Self {
        Self { at_s: fall.time_s, bodies: fall.bodies.clone(), taken: fall.taken, first_lost: fall.first_lost }
    }
}
