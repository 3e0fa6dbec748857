//! Game of Python: a tower, the hand, and one command a frame.

mod moves;
mod replay;
mod state;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use rayon::prelude::*;
use teeter_game::{Command, RecordWriter, Rules, Table};
use teeter_physics::{POSE_STRIDE, Params};

use crate::argument::{body_of, count};
use crate::error::{Kind, unexpected};
use crate::plain::{keywords, read, write};
use crate::pool::detached;
use crate::record::Record;
use crate::scene::{dict, scene_of};
use crate::twist::{TWIST_STRIDE, write_twists};
use crate::world::World;

/// Largest number of frames of one call: ten minutes.
const MAX_FRAMES: u64 = 36_000;

/// A tower in play. Game(scene, rules="free", players=2, *, record=False, precision="single",
/// width="auto", sleep=True, ramp=0.0, frame=1/60)
///
/// scene: as World takes it. rules: the name of a table ("free", "official", "strict", "friendly",
/// "dissertation", "solo", "throw-and-go") or a dict of rules, see rules(). players: 1 to 8.
/// record: True to write a record. Scene, constants, rules and one command a frame are the whole of
/// a game.
///
/// Raises SceneError, ParamError or RulesError.
#[pyclass(module = "teeter")]
#[derive(Debug, Clone)]
pub struct Game {
    pub game: teeter_game::Game,
    /// None where the game is not recorded.
    writer: Option<RecordWriter>,
}

impl Game {
    /// A game without a record.
    pub fn unrecorded(game: teeter_game::Game) -> Self {
        Self { game, writer: None }
    }

    /// Carries out a command, and writes it into the record.
    fn advance(&mut self, command: &Command) -> PyResult<teeter_game::Update<teeter_physics::StepReport>> {
        let update = self.game.step(command);
        if let Some(writer) = &mut self.writer {
            writer.write(command, &self.game).map_err(|error| Kind::Record.error(error))?;
        }
        Ok(update)
    }
}

/// Rules of an argument: the name of a table, or a dict.
pub fn rules_of(object: &Bound<'_, PyAny>, players: u32) -> PyResult<Rules> {
    let rules = if object.is_instance_of::<PyString>() {
        Rules::of(read::<Table>(Kind::Rules, "rules", object)?, players)
    } else {
        read(Kind::Rules, "rules", object)?
    };
    rules.validate().map_err(|error| Kind::Rules.error(error))?;
    Ok(rules)
}

/// Number of players of an argument.
pub fn players_of(players: Option<&Bound<'_, PyAny>>) -> PyResult<u32> {
    players.map_or(Ok(2), |players| Ok(count("players", players, 1..=8)? as u32))
}

/// Command of an argument: a dict, the name of a command without fields, or None for `idle`.
pub fn command_of(object: Option<&Bound<'_, PyAny>>, len: usize) -> PyResult<Command> {
    let Some(object) = object.filter(|object| !object.is_none()) else { return Ok(Command::Idle) };
    let named = PyDict::new(object.py());
    let object = if object.is_instance_of::<PyString>() {
        named.set_item("command", object)?;
        named.as_any()
    } else {
        object
    };
    let command: Command = read(Kind::Command, "command", object)?;
    if let Command::Grasp { body, .. } | Command::Place { body: Some(body), .. } = command
        && body.index() >= len
    {
        return Err(crate::argument::no_body("command.body", body, len));
    }
    Ok(command)
}

/// Rules of a table for a number of players, as a dict: a start for rules of one's own.
#[pyfunction]
#[pyo3(signature = (table, players=None), text_signature = "(table, players=2)")]
pub fn rules<'py>(table: &Bound<'py, PyAny>, players: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
    write(table.py(), &rules_of(table, players_of(players)?)?)
}

/// Advances several games by a frame, each with its command, on all cores, and returns their
/// updates. A game may be in the list once.
#[pyfunction]
pub fn step_games<'py>(
    py: Python<'py>,
    games: Vec<Bound<'py, Game>>,
    commands: &Bound<'py, PyList>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    if commands.len() != games.len() {
        return Err(unexpected(
            Kind::Input,
            "commands",
            commands.len(),
            format_args!("{} commands, one a game", games.len()),
        ));
    }
    let mut games: Vec<PyRefMut<'py, Game>> =
        games.iter().map(|game| Ok(game.try_borrow_mut()?)).collect::<PyResult<_>>()?;
    let commands: Vec<Command> = commands
        .iter()
        .zip(&games)
        .map(|(command, game)| command_of(Some(&command), game.game.world().len()))
        .collect::<PyResult<_>>()?;
    let mut stepped: Vec<&mut Game> = games.iter_mut().map(|game| &mut **game).collect();
    let updates: Vec<PyResult<_>> =
        detached(py, || stepped.par_iter_mut().zip(&commands).map(|(game, command)| game.advance(command)).collect())?;
    updates.into_iter().map(|update| write(py, &update?)).collect()
}

#[pymethods]
impl Game {
    #[new]
    #[pyo3(signature = (scene, rules=None, players=None, *, record=false, **params))]
    fn new(
        scene: &Bound<'_, PyAny>,
        rules: Option<&Bound<'_, PyAny>>,
        players: Option<&Bound<'_, PyAny>>,
        record: bool,
        params: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let params: Params = keywords(Kind::Param, params)?;
        let players = players_of(players)?;
        let rules = rules.map_or_else(|| Ok(Rules::of(Table::Free, players)), |rules| rules_of(rules, players))?;
        let description = scene_of(scene)?;
        let world = World::build(scene.py(), &description, params)?.world;
        let game = teeter_game::Game::with_rules(world, rules).map_err(|error| Kind::Rules.error(error))?;
        Ok(Self { game, writer: record.then(|| RecordWriter::new(&description, params, rules)) })
    }

    /// Number of bodies.
    fn __len__(&self) -> usize {
        self.game.world().len()
    }

    fn __repr__(&self) -> String {
        let world = self.game.world();
        format!("<Game '{}': {} bodies, {:.3} s>", world.scene().name, world.len(), world.time())
    }

    /// Carries out a command, advances by `frames` frames and returns the last update, a dict, with
    /// the events of all of them.
    ///
    /// command: a dict such as {"command": "release"}, the name of a command without fields, or
    /// None for "idle"; docs/python.md lists them. It is given in the first frame. A command that
    /// the rules or the hand refuse changes nothing, and the update has the reason. Raises
    /// CommandError for what is no command, and InputError.
    #[pyo3(signature = (command=None, *, frames=None), text_signature = "($self, command=None, *, frames=1)")]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        command: Option<&Bound<'py, PyAny>>,
        frames: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frames = frames.map_or(Ok(1), |frames| count("frames", frames, 1..=MAX_FRAMES))?;
        let command = command_of(command, self.game.world().len())?;
        let update = detached(py, || {
            let mut update = self.advance(&command)?;
            for _ in 1..frames {
                let events = std::mem::take(&mut update.events);
                update = self.advance(&Command::Idle)?;
                update.events.splice(..0, events);
            }
            Ok::<_, PyErr>(update)
        })??;
        write(py, &update)
    }

    /// Reason why the rules forbid a command now; None where they do not.
    #[pyo3(signature = (command))]
    fn judge(&self, command: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
        let command = command_of(Some(command), self.game.world().len())?;
        Ok(self.game.judge(&command).err().map(|rule| rule.to_string()))
    }

    /// State of the turn, a dict; None in free play.
    #[getter]
    fn turn<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.game.turn().map(|turn| write(py, &turn)).transpose()
    }

    /// Rules, a dict.
    #[getter]
    fn rules<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.game.rules())
    }

    /// Scene at the start, a dict.
    #[getter]
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, self.game.world().scene())
    }

    /// Copy of the world, for measurements.
    #[getter]
    fn world(&self) -> World {
        World { world: self.game.world().clone() }
    }

    /// Poses of all bodies, see World.poses. A copy.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let world = self.game.world();
        PyArray1::from_slice(py, world.poses()).reshape([world.len(), POSE_STRIDE])
    }

    /// Velocities of all bodies, see World.velocities. A copy.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let world = self.game.world();
        let mut twists = vec![0.0; world.len() * TWIST_STRIDE];
        write_twists(world, &mut twists);
        PyArray1::from_vec(py, twists).reshape([world.len(), TWIST_STRIDE])
    }

    /// Simulated time, s.
    #[getter]
    fn time(&self) -> f64 {
        self.game.world().time()
    }

    /// Free slots for a block, a list of dicts: row, cell, position (m), orientation, clearance
    /// (m).
    #[pyo3(text_signature = "($self, body)")]
    fn slots<'py>(&self, of: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        write(of.py(), &self.game.slots(body_of(self.game.world().len(), "body", of)?))
    }

    /// True where a block can be lifted: nothing is above it.
    #[pyo3(text_signature = "($self, body)")]
    fn is_free(&self, of: &Bound<'_, PyAny>) -> PyResult<bool> {
        Ok(self.game.is_free(body_of(self.game.world().len(), "body", of)?))
    }

    /// Record of the game so far.
    ///
    /// Raises RecordError where the game is not recorded.
    fn record(&self) -> PyResult<Record> {
        let writer = self.writer.clone();
        let writer =
            writer.ok_or_else(|| Kind::Record.error("the game is not recorded: begin it with `record=True`"))?;
        Ok(Record { record: writer.finish(&self.game) })
    }

    /// Row and cell of each block in the tower, int64 of shape (n, 2); -1 where it is in none.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let blocks = self.game.blocks();
        let mut cells = vec![[-1i64; 2]; blocks.len()];
        for (body, cell) in teeter_game::TowerMap::new(blocks, None).cells() {
            cells[body.index()] = [i64::from(cell.row), i64::from(cell.cell)];
        }
        PyArray1::from_vec(py, cells.into_flattened()).reshape([blocks.len(), 2])
    }
}
