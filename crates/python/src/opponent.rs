//! Opponents of Python.

use pyo3::prelude::*;
use pyo3::types::{PyList, PyString};
use serde::Serialize;
use teeter_game::{Considered, Outcome, Strength, Thinking};
use teeter_physics::BodyId;

use crate::argument::{count, seed, shown};
use crate::error::{Kind, unexpected};
use crate::game::{Game, rules_of};
use crate::plain::{read, write};
use crate::pool::detached;
use crate::record::Record;
use crate::scene::scene_of;

/// An opponent: chooses a move in its turn and carries it out, a command a frame. Opponent(player,
/// strength="skilled", seed=0)
///
/// player: its number, from 0. strength: "random", "beginner", "skilled", "expert", "gentle", or a
/// dict of its manner of thinking. All that it does follows from these and the game.
///
/// Raises InputError.
#[pyclass(module = "teeter")]
#[derive(Debug, Clone)]
pub struct Opponent {
    opponent: teeter_game::Opponent,
}

/// Manner of thinking of an argument.
fn thinking_of(field: &str, object: &Bound<'_, PyAny>) -> PyResult<Thinking> {
    if object.is_instance_of::<PyString>() {
        return Ok(read::<Strength>(Kind::Input, field, object)?.thinking());
    }
    let thinking: Thinking = read(Kind::Input, field, object)?;
    let Thinking { candidates, budget, errors, trouble, risk, caution, .. } = thinking;
    let ranges = [
        ("candidates", f64::from(candidates), 1.0, 1000.0),
        ("budget", budget, 0.0, 1e5),
        ("errors.height", errors.height, 0.0, 1e-3),
        ("errors.friction", errors.friction, 0.0, 0.4),
        ("errors.position", errors.position, 0.0, 0.01),
        ("trouble", trouble, -10.0, 10.0),
        ("risk", risk, 0.0, 1.0),
        ("caution", caution, 0.0, 1000.0),
    ];
    for (part, value, min, max) in ranges {
        if !(min..=max).contains(&value) {
            return Err(unexpected(Kind::Input, &format!("{field}.{part}"), value, format_args!("{min} to {max}")));
        }
    }
    Ok(thinking)
}

/// Manner of thinking of a strength, a dict that Opponent and contest take as well: candidates, the
/// number of blocks that are tried; is_ranked, True when these are the best ones; budget, the
/// simulated time of all rollouts of a move, s; errors of the estimate: height (m), friction (a
/// share), position (m); trouble; risk; foresight; caution.
///
/// Raises InputError.
#[pyfunction]
pub fn thinking<'py>(strength: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    write(strength.py(), &thinking_of("strength", strength)?)
}

/// A move that was considered.
#[derive(Debug, Serialize)]
struct Move {
    body: BodyId,
    tightness_n: f64,
    falls_by_statics: Option<bool>,
    falls: u32,
    rollouts: u32,
    cost: f64,
}

impl From<&Considered> for Move {
    fn from(considered: &Considered) -> Self {
        Self {
            body: considered.candidate.body,
            tightness_n: considered.candidate.tightness_n,
            falls_by_statics: considered.candidate.falls,
            falls: considered.tally.falls.count,
            rollouts: considered.tally.falls.tries,
            cost: considered.cost,
        }
    }
}

#[pymethods]
impl Opponent {
    #[new]
    #[pyo3(signature = (player, strength=None, seed=None), text_signature = "(player, strength='skilled', seed=0)")]
    fn new(
        player: &Bound<'_, PyAny>,
        strength: Option<&Bound<'_, PyAny>>,
        seed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let player = count("player", player, 0..=7)? as u32;
        let thinking =
            strength.map_or(Ok(Strength::Skilled.thinking()), |strength| thinking_of("strength", strength))?;
        let seed = seed.map_or(Ok(0), self::seed)?;
        Ok(Self { opponent: teeter_game::Opponent::with_thinking(player, thinking, seed) })
    }

    /// Command for the next frame of a game, a dict; "idle" out of its turn. The frame in which it
    /// chooses a move takes as long as its rollouts.
    fn next<'py>(&mut self, py: Python<'py>, game: &Bound<'py, Game>) -> PyResult<Bound<'py, PyAny>> {
        let game = game.try_borrow()?;
        let (opponent, played) = (&mut self.opponent, &game.game);
        let command = detached(py, || opponent.next(played))?;
        write(py, &command)
    }

    /// Moves that it considered last, the chosen one first: a list of dicts.
    fn considered<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let moves: Vec<Move> = self.opponent.considered().iter().map(Move::from).collect();
        write(py, &moves)
    }
}

/// Plays opponents against each other and returns a tuple: the Record, and a dict of outcome, moves
/// and fell.
///
/// rules: a dict or the name of a table. players: a list of strengths, one a player.
///
/// Raises SceneError, RulesError, InputError or RecordError.
#[pyfunction]
#[pyo3(signature = (scene, rules, players, seed=None), text_signature = "(scene, rules, players, seed=0)")]
pub fn contest<'py>(
    scene: &Bound<'py, PyAny>,
    rules: &Bound<'py, PyAny>,
    players: &Bound<'py, PyAny>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Record, Bound<'py, PyAny>)> {
    #[derive(Serialize)]
    struct Result {
        outcome: Option<Outcome>,
        moves: u32,
        fell: bool,
    }

    let py = scene.py();
    let list = players.cast::<PyList>().ok().filter(|list| (1..=8).contains(&list.len()));
    let list = list.ok_or_else(|| unexpected(Kind::Input, "players", shown(players), "a list of 1 to 8 strengths"))?;
    let thinking = list.iter().enumerate().map(|(i, strength)| thinking_of(&format!("players[{i}]"), &strength));
    let thinking: Vec<Thinking> = thinking.collect::<PyResult<_>>()?;
    let rules = rules_of(rules, thinking.len() as u32)?;
    if !rules.has_turns() || rules.players as usize != thinking.len() {
        let expected = format!("rules with turns for {} players", thinking.len());
        return Err(unexpected(Kind::Rules, "rules", format_args!("for {} players", rules.players), expected));
    }
    let (scene, seed) = (scene_of(scene)?, seed.map_or(Ok(0), self::seed)?);
    let game = detached(py, || teeter_game::contest(&scene, rules, &thinking, seed))?;
    let game = game.map_err(|error| Kind::Record.error(error))?;
    let result = Result { outcome: game.outcome, moves: game.moves, fell: game.fell };
    Ok((Record { record: game.record }, write(py, &result)?))
}
