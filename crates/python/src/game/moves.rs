//! Whole moves, carried out by a hand with the errors of a person.

use pyo3::prelude::*;
use pyo3::types::PyString;
use serde::Serialize;
use teeter_game::{CellId, Command, Event, Extraction, HandNoise, MoveEnd, MovePlan, Phase, PlayerHand, slide_axis};
use teeter_physics::BodyId;

use super::Game;
use crate::argument::{body_of, count, direction, seed, within};
use crate::error::{Kind, unexpected};
use crate::plain::{read, write};
use crate::pool::detached;

/// Frames after which a move ends in any case.
const MAX_FRAMES: u32 = 3600;

/// Result of a move or of waiting.
#[derive(Debug, Serialize)]
struct Played {
    /// End of the move; none where the game was over before, or where nothing was moved.
    end: Option<MoveEnd>,
    frames: u32,
    /// Blocks that fell.
    fell: Vec<BodyId>,
    at_rest: bool,
    events: Vec<Event>,
}

impl Played {
    fn new() -> Self {
        Self { end: None, frames: 0, fell: Vec::new(), at_rest: false, events: Vec::new() }
    }
}

impl Game {
    /// Carries out a command and adds the frame to what was played.
    fn play(&mut self, command: &Command, played: &mut Played) -> PyResult<()> {
        let update = self.advance(command)?;
        played.frames += 1;
        played.at_rest = update.at_rest;
        for event in &update.events {
            if let Event::Fell { bodies } = event {
                played.fell.extend(bodies);
            }
        }
        played.events.extend(update.events);
        Ok(())
    }

    fn is_over(&self) -> bool {
        self.game.turn().is_some_and(|turn| turn.phase == Phase::Over)
    }

    /// Carries out a plan to its end, or until a block falls.
    fn carry_out(&mut self, plan: MovePlan, noise: HandNoise, seed: u64) -> PyResult<Played> {
        let mut hand = PlayerHand::new(&self.game, plan, noise, seed);
        let mut played = Played::new();
        while let Some(command) = hand.next(&self.game) {
            self.play(&command, &mut played)?;
            if !played.fell.is_empty() || self.is_over() || played.frames >= MAX_FRAMES {
                break;
            }
        }
        played.end = hand.end();
        Ok(played)
    }

    /// Waits until the tower is at rest, and where there are turns until the next begins.
    fn wait(&mut self, frames: u32) -> PyResult<Played> {
        let mut played = Played::new();
        let settles = |game: &teeter_game::Game| game.turn().is_some_and(|turn| turn.phase == Phase::Settling);
        while played.frames < frames && !self.is_over() {
            self.play(&Command::Idle, &mut played)?;
            if played.at_rest && !settles(&self.game) {
                break;
            }
        }
        Ok(played)
    }

    /// Direction in which a block leaves the tower where none is given: away from its middle.
    fn outward(&self, body: BodyId) -> glam::DVec3 {
        let blocks = self.game.blocks();
        let along = slide_axis(blocks.orientation(body));
        let middle = blocks.positions().iter().sum::<glam::DVec3>() / blocks.len() as f64;
        if (blocks.position(body) - middle).dot(along) < -1e-3 { -along } else { along }
    }
}

/// Errors of a hand: "person", "none" or a dict of `position`, `angle`, `lag`, `tremor`.
pub fn noise_of(object: Option<&Bound<'_, PyAny>>) -> PyResult<HandNoise> {
    let Some(object) = object else { return Ok(HandNoise::default()) };
    let noise = match object.cast::<PyString>() {
        Ok(name) if name == "person" => HandNoise::default(),
        Ok(name) if name == "none" => HandNoise::none(),
        Ok(_) => {
            return Err(unexpected(Kind::Input, "noise", crate::argument::shown(object), "'person', 'none' or a dict"));
        }
        Err(_) => read(Kind::Input, "noise", object)?,
    };
    let HandNoise { position, angle, lag, tremor } = noise;
    for (field, value, max) in
        [("position", position, 0.1), ("angle", angle, 1.6), ("lag", lag, 2.0), ("tremor", tremor, 0.1)]
    {
        if !(0.0..=max).contains(&value) {
            return Err(unexpected(Kind::Input, &format!("noise.{field}"), value, format_args!("0 to {max}")));
        }
    }
    Ok(noise)
}

#[pymethods]
impl Game {
    /// Takes a block out of the tower and puts it down in a slot, a frame at a time, until it is
    /// done or a block falls. Returns a dict: end ("placed", "stuck", "dropped", or None where a
    /// block fell or the game ended before), frames, fell (bodies), at_rest, events.
    ///
    /// toward: direction in which the block leaves; away from the middle of the tower where absent.
    /// extraction: "pull", "push_through" or "test". slot: a pair (row, cell), any where absent.
    /// noise: errors of the hand, "person", "none" or a dict. Raises InputError or BodyError.
    #[pyo3(signature = (of, toward=None, *, extraction=None, slot=None, noise=None, seed=None))]
    #[pyo3(text_signature = "($self, body, toward=None, *, extraction='pull', slot=None, noise='person', seed=0)")]
    fn take<'py>(
        &mut self,
        of: &Bound<'py, PyAny>,
        toward: Option<&Bound<'py, PyAny>>,
        extraction: Option<&Bound<'py, PyAny>>,
        slot: Option<&Bound<'py, PyAny>>,
        noise: Option<&Bound<'py, PyAny>>,
        seed: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let body = body_of(self.game.world().len(), "body", of)?;
        let toward = toward.map_or_else(|| Ok(self.outward(body)), |toward| direction("toward", toward))?;
        let extraction =
            extraction.map_or(Ok(Extraction::Pull), |extraction| read(Kind::Input, "extraction", extraction))?;
        let slot = slot.map(cell_of).transpose()?;
        let (noise, seed) = (noise_of(noise)?, seed.map_or(Ok(0), self::seed)?);
        let plan = MovePlan { body, toward, extraction, slot };
        let played = detached(of.py(), || self.carry_out(plan, noise, seed))??;
        write(of.py(), &played)
    }

    /// Waits until the tower is at rest and the next turn begins, for at most `seconds` s. Returns
    /// a dict as take() does.
    #[pyo3(signature = (seconds=None), text_signature = "($self, seconds=15.0)")]
    fn settle<'py>(&mut self, py: Python<'py>, seconds: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let seconds = seconds.map_or(Ok(15.0), |seconds| within("seconds", seconds, 0.0..=3600.0))?;
        let frames = self.game.world().frames(seconds) as u32;
        let played = detached(py, || self.wait(frames))??;
        write(py, &played)
    }
}

/// Cell of a pair (row, cell), or of a dict with both.
fn cell_of(object: &Bound<'_, PyAny>) -> PyResult<CellId> {
    if object.is_instance_of::<pyo3::types::PyDict>() {
        return read(Kind::Input, "slot", object);
    }
    let wrong = || unexpected(Kind::Input, "slot", crate::argument::shown(object), "a pair (row, cell)");
    let items: Vec<Bound<'_, PyAny>> =
        object.try_iter().map_err(|_| wrong())?.take(3).collect::<PyResult<_>>().map_err(|_| wrong())?;
    let [row, cell] = items.as_slice() else { return Err(wrong()) };
    Ok(CellId { row: count("slot[0]", row, 0..=10_000)? as u32, cell: count("slot[1]", cell, 0..=2)? as u32 })
}
