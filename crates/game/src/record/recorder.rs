//! Recorder: plays a game and keeps its commands.

use teeter_physics::envelope::checksum;
use teeter_physics::{BodyId, POSE_STRIDE, Params, StepReport, World};
use teeter_scene::Scene;

use crate::command::Command;
use crate::game::Game;
use crate::record::engine::engine_id;
use crate::record::error::RecordError;
use crate::record::file::{Record, Sample, StateFrame};
use crate::record::pose_code::{PoseChange, RoundedPose, has_changed, of_scene, rounded};
use crate::record::tape::{Run, Tape};
use crate::rules::table::Rules;
use crate::update::Update;

/// Bytes of states beyond which no more are stored: a file must stay readable.
const MAX_STORED: usize = 32_000_000;

/// A game that is recorded.
///
/// ```
/// use teeter_game::{Command, Recorder, Rules};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// assert_eq!(recorder.finish().frames(), 1);
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recorder {
    game: Game,
    record: Record,
    poses: Vec<RoundedPose>,
    /// Number of frames from one stored state to the next; none where none is stored.
    state_interval: Option<u32>,
    /// Bytes of all states.
    stored: usize,
}

impl Recorder {
    /// Begins a game on a scene.
    ///
    /// # Errors
    /// When no game can begin like this.
    pub fn new(scene: &Scene, params: Params, rules: Rules) -> Result<Self, RecordError> {
        let record = Record {
            engine: engine_id(),
            scene: scene.clone(),
            params,
            rules,
            tape: Tape::default(),
            checks: Vec::new(),
            samples: Vec::new(),
            states: Vec::new(),
        };
        let poses = of_scene(scene);
        Ok(Self { game: begin(&record)?, record, poses, state_interval: None, stored: 0 })
    }

    /// Stores the whole state each `frames` frames, so that a replay can begin there. A state of a
    /// full tower takes tens of kilobytes.
    pub fn with_states(mut self, frames: u32) -> Self {
        self.state_interval = Some(frames.max(1));
        self
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Carries out a command and advances by a frame, as [`Game::step`] does.
    ///
    /// # Errors
    /// When the record has as many frames as there may be; the game is unchanged then.
    pub fn step(&mut self, command: &Command) -> Result<Update<StepReport>, RecordError> {
        self.record.tape.push(Run { command: *command, frames: 1 })?;
        let update = self.game.step(command);
        self.record.checks.push(frame_check(&self.game));
        let frames = self.record.frames();
        if frames.is_multiple_of(self.record.interval()) {
            self.sample();
        }
        if self.state_interval.is_some_and(|interval| frames.is_multiple_of(interval)) {
            self.store_state(frames);
        }
        Ok(update)
    }

    /// Ends the record, wherever the game is.
    pub fn finish(mut self) -> Record {
        if !self.record.frames().is_multiple_of(self.record.interval()) {
            self.sample();
        }
        self.record
    }

    fn store_state(&mut self, frame: u32) {
        let bytes = self.game.snapshot();
        self.stored += bytes.len();
        if self.stored <= MAX_STORED {
            self.record.states.push(StateFrame { frame, bytes });
        }
    }

    fn sample(&mut self) {
        let now = self.game.world().poses().chunks_exact(POSE_STRIDE);
        let mut changes = Vec::new();
        for (body, (before, pose)) in (0..).map(BodyId).zip(self.poses.iter_mut().zip(now)) {
            if has_changed(pose, before) {
                *before = rounded(pose);
                changes.push(PoseChange { body, pose: *before });
            }
        }
        self.record.samples.push(Sample { hash: self.game.state_hash(), changes });
    }
}

/// Begins the game of a record.
pub fn begin(record: &Record) -> Result<Game, RecordError> {
    let world = World::new(&record.scene, record.params).map_err(|error| RecordError::Start(error.to_string()))?;
    Game::with_rules(world, record.rules).map_err(|error| RecordError::Start(error.to_string()))
}

/// Check of a frame: four bits of the poses' checksum. One that differs stays so, and four bits
/// find fifteen of sixteen differences in their own frame.
pub fn frame_check(game: &Game) -> u8 {
    let bytes: Vec<u8> = game.world().poses().iter().flat_map(|x| x.to_le_bytes()).collect();
    (checksum(&bytes) >> 60) as u8
}
