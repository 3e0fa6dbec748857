//! Binding of an opponent: the hand in the worker of the game, the thought in another one.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_game::{Considered, FallChance, MovePlan, Question, Strength, Thinking, load_world};
use teeter_physics::BodyId;
use wasm_bindgen::prelude::*;

use crate::{Error, Game, text};

/// Most simulated time for which an opponent may think about a move, s.
const MAX_BUDGET: f64 = 1e5;

/// An opponent in a game. It chooses a move by rollouts, and carries it out with the limited hand
/// of a person, one command a frame. All that it does follows from strength, budget, seed and game.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Opponent(teeter_game::Opponent);

#[wasm_bindgen]
impl Opponent {
    /// An opponent who plays as `player`, from 0, with a strength of the list, the seed of its
    /// errors, and the simulated time for which it thinks about a move, s (that of its strength
    /// where absent).
    #[wasm_bindgen(constructor)]
    pub fn new(player: u32, strength: &str, seed: u32, budget: Option<f64>) -> Result<Opponent, Error> {
        let unknown = |_| {
            let names: Vec<&str> = Strength::ALL.iter().map(|strength| strength.name()).collect();
            Error::rejected(format!("there is no strength `{strength}`, expected one of {}", names.join(", ")))
        };
        let strength: Strength = serde_json::from_value(strength.into()).map_err(unknown)?;
        let thinking = strength.thinking();
        let budget = budget.unwrap_or(thinking.budget);
        if !(0.0..=MAX_BUDGET).contains(&budget) {
            return Err(Error::rejected(format!("`budget` is {budget}, expected 0 to {MAX_BUDGET} s")));
        }
        let thinking = Thinking { budget, ..thinking };
        Ok(Self(teeter_game::Opponent::with_thinking(player, thinking, u64::from(seed))))
    }

    /// The list of strengths as JSON, the weakest first: `[{"strength", "budget_s"}]`, with the
    /// simulated time for which each thinks about a move.
    pub fn strengths() -> Result<String, Error> {
        let entry = |strength: &Strength| Entry { strength: *strength, budget_s: strength.thinking().budget };
        text::write("strengths", &Strength::ALL.iter().map(entry).collect::<Vec<_>>())
    }

    /// Question that the opponent has to answer before its next command, as JSON; undefined where
    /// it has none. [`Thought`] answers it, in another worker so that the game goes on, with
    /// commands `idle`. It is the same question until it is answered or the turn ends.
    pub fn question(&mut self, game: &Game) -> Result<Option<String>, Error> {
        self.0.question(game.inner()).map(|question| text::write("question", question)).transpose()
    }

    /// Takes in the answer to its question: the list of `considered` of a [`Thought`]. Of an empty
    /// list it gives up.
    pub fn answer(&mut self, considered: &str) -> Result<(), Error> {
        let moves: Vec<Answer> = text::read_all("answer", considered)?;
        self.0.answer(moves.first().map(|chosen| MovePlan::pull(BodyId(chosen.body), DVec3::from(chosen.toward))));
        Ok(())
    }

    /// Command for the next frame, as JSON; `idle` out of its turn. A question that was not
    /// answered is answered here, and the frame takes as long.
    pub fn next(&mut self, game: &Game) -> Result<String, Error> {
        text::write("command", &self.0.next(game.inner()))
    }
}

#[derive(Serialize)]
struct Entry {
    strength: Strength,
    budget_s: f64,
}

/// The part of a considered move that is carried out.
#[derive(Deserialize)]
struct Answer {
    body: u32,
    toward: [f64; 3],
}

/// Thought about the question of an opponent, a rollout at a time.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Thought(teeter_game::Thought);

#[wasm_bindgen]
impl Thought {
    /// Begins to think about a question, on the world of `Game.world` at that moment.
    #[wasm_bindgen(constructor)]
    pub fn new(world: &[u8], question: &str) -> Result<Thought, Error> {
        let question: Question = text::read_all("question", question)?;
        Ok(Self(teeter_game::Thought::new(load_world(world).map_err(Error::rejected)?, &question)))
    }

    /// Makes a rollout and returns the part of the work that is done, 1 at the end.
    pub fn step(&mut self) -> Result<f64, Error> {
        self.0.step().map_err(Error::rejected)?;
        Ok(self.0.progress())
    }

    /// Moves by their rollouts so far as JSON, the chosen one first: `[{"body", "toward",
    /// "chance_of_fall", "low", "high", "rollouts", "chance_stuck", "freedom", "cost"}]`.
    pub fn considered(&self) -> Result<String, Error> {
        let moves: Vec<Move> = self.0.considered().iter().map(Move::new).collect();
        text::write("moves", &moves)
    }
}

/// A considered move.
#[derive(Serialize)]
struct Move {
    body: u32,
    toward: [f64; 3],
    #[serde(flatten)]
    chance: FallChance,
    chance_stuck: f64,
    freedom: f64,
    cost: f64,
}

impl Move {
    fn new(considered: &Considered) -> Self {
        let Considered { candidate, tally, cost } = considered;
        Self {
            body: candidate.body.0,
            toward: candidate.toward.to_array(),
            chance: tally.falls.into(),
            chance_stuck: tally.stuck.share(),
            freedom: tally.freedom(),
            cost: *cost,
        }
    }
}
