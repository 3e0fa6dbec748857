//! Recorder: a game, and the writer of its record.

use teeter_physics::envelope::checksum;
use teeter_physics::{BodyId, POSE_STRIDE, Params, StepReport, World};
use teeter_scene::Scene;

use crate::command::Command;
use crate::game::Game;
use crate::record::engine::engine_id;
use crate::record::error::RecordError;
use crate::record::file::{Record, Sample, StateFrame};
use crate::record::player_names::PlayerNames;
use crate::record::pose_code::{PoseChange, RoundedPose, has_changed, of_scene, rounded};
use crate::record::tape::{Run, Tape};
use crate::rules::table::Rules;
use crate::update::Update;

/// Bytes of states beyond which no more are stored: a file must stay readable.
const MAX_STORED: usize = 32_000_000;

/// Writer of the record of a game that is played elsewhere.
///
/// ```
/// use teeter_game::{Command, Game, RecordWriter};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default()).unwrap());
/// let mut writer = RecordWriter::new(&scene, Params::default(), game.rules());
/// game.step(&Command::Idle);
/// writer.write(&Command::Idle, &game)?;
/// assert_eq!(writer.finish(&game).frames(), 1);
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RecordWriter {
    record: Record,
    poses: Vec<RoundedPose>,
    /// Number of frames from one stored state to the next; none where none is stored.
    state_interval: Option<u32>,
    /// Bytes of all states.
    stored: usize,
}

impl RecordWriter {
    /// Begins the record of a game that begins from these.
    pub fn new(scene: &Scene, params: Params, rules: Rules) -> Self {
        let record = Record {
            engine: engine_id(),
            players: PlayerNames::default(),
            scene: scene.clone(),
            params,
            rules,
            tape: Tape::default(),
            checks: Vec::new(),
            samples: Vec::new(),
            states: Vec::new(),
        };
        Self { record, poses: of_scene(scene), state_interval: None, stored: 0 }
    }

    /// Goes on with a record after some frames; the frames after them are dropped.
    pub(crate) fn resume(mut record: Record, frames: u32) -> Self {
        let frames = frames.min(record.frames());
        record.engine = engine_id();
        record.tape.truncate(frames);
        record.checks.truncate(frames as usize);
        record.samples.truncate((frames / record.interval()) as usize);
        record.states.retain(|state| state.frame <= frames);
        let mut poses = of_scene(&record.scene);
        let changes = record.samples.iter().flat_map(|sample| &sample.changes);
        changes.for_each(|change| poses[change.body.index()] = change.pose);
        let stored = record.states.iter().map(|state| state.bytes.len()).sum();
        Self { record, poses, state_interval: None, stored }
    }

    /// Names the players of the game.
    pub fn name_players(&mut self, players: PlayerNames) {
        self.record.players = players;
    }

    /// Takes in a command, and the game after the frame in which it was given.
    ///
    /// # Errors
    /// When the record has as many frames as there may be.
    pub fn write(&mut self, command: &Command, game: &Game) -> Result<(), RecordError> {
        self.record.tape.push(Run { command: *command, frames: 1 })?;
        self.record.checks.push(frame_check(game));
        let frames = self.record.frames();
        if frames.is_multiple_of(self.record.interval()) {
            self.sample(game);
        }
        if self.state_interval.is_some_and(|interval| frames.is_multiple_of(interval)) {
            self.store_state(frames, game);
        }
        Ok(())
    }

    /// Ends the record, wherever the game is.
    pub fn finish(mut self, game: &Game) -> Record {
        if !self.record.frames().is_multiple_of(self.record.interval()) {
            self.sample(game);
        }
        self.record
    }

    /// Ends the record with the whole state of the game, from which it can be resumed at once.
    pub fn finish_with_state(mut self, game: &Game) -> Record {
        let frame = self.record.frames();
        if self.record.states.last().is_none_or(|last| last.frame < frame) {
            self.record.states.push(StateFrame { frame, bytes: game.snapshot() });
        }
        self.finish(game)
    }

    fn store_state(&mut self, frame: u32, game: &Game) {
        let bytes = game.snapshot();
        self.stored += bytes.len();
        if self.stored <= MAX_STORED {
            self.record.states.push(StateFrame { frame, bytes });
        }
    }

    fn sample(&mut self, game: &Game) {
        let now = game.world().poses().chunks_exact(POSE_STRIDE);
        let mut changes = Vec::new();
        for (body, (before, pose)) in (0..).map(BodyId).zip(self.poses.iter_mut().zip(now)) {
            if has_changed(pose, before) {
                *before = rounded(pose);
                changes.push(PoseChange { body, pose: *before });
            }
        }
        self.record.samples.push(Sample { hash: game.state_hash(), changes });
    }
}

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
    writer: RecordWriter,
}

impl Recorder {
    /// Begins a game on a scene.
    ///
    /// # Errors
    /// When no game can begin like this.
    pub fn new(scene: &Scene, params: Params, rules: Rules) -> Result<Self, RecordError> {
        let writer = RecordWriter::new(scene, params, rules);
        Ok(Self { game: begin(&writer.record)?, writer })
    }

    /// Stores the whole state each `frames` frames, so that a replay can begin there. A state of a
    /// full tower takes tens of kilobytes.
    pub fn with_states(mut self, frames: u32) -> Self {
        self.writer.state_interval = Some(frames.max(1));
        self
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Carries out a command and advances by a frame, as [`Game::step`] does.
    ///
    /// # Errors
    /// When the record has as many frames as there may be; the game goes on then.
    pub fn step(&mut self, command: &Command) -> Result<Update<StepReport>, RecordError> {
        let update = self.game.step(command);
        self.writer.write(command, &self.game)?;
        Ok(update)
    }

    /// Ends the record, wherever the game is.
    pub fn finish(self) -> Record {
        self.writer.finish(&self.game)
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
