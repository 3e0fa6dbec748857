//! Replay of a record, and the test that it is the same.

use std::borrow::Cow;

use serde::Serialize;
use teeter_physics::{BodyId, POSE_STRIDE, StepReport};

use crate::game::Game;
use crate::record::error::RecordError;
use crate::record::file::Record;
use crate::record::pose_code::{RoundedPose, of_scene, position, rounded};
use crate::record::recorder::{RecordWriter, begin, frame_check};
use crate::record::tape::Cursor;
use crate::update::Update;

/// Displacement from which a block is elsewhere than in the record, m: well above the rounding.
const ELSEWHERE: f64 = 2e-4;

/// A game that is played again from its record.
///
/// ```
/// use teeter_game::{Command, Recorder, Replay, Rules};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// let record = recorder.finish();
/// let mut replay = Replay::new(&record)?;
/// assert!(replay.step().is_some() && replay.is_same());
/// assert!(replay.step().is_none());
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Replay<'a> {
    record: Cow<'a, Record>,
    cursor: Cursor,
    game: Game,
    frame: u32,
    /// Poses of the record at the last sample.
    recorded: Vec<RoundedPose>,
    divergence: Option<Divergence>,
}

impl<'a> Replay<'a> {
    /// A replay from the start.
    ///
    /// # Errors
    /// When no game begins like this.
    pub fn new(record: &'a Record) -> Result<Self, RecordError> {
        Self::of(Cow::Borrowed(record))
    }

    /// A replay from the last stored state that is not after `frame`; from the start where there is
    /// none.
    ///
    /// # Errors
    /// When no game begins like this, or the state is not one of it.
    pub fn near(record: &'a Record, frame: u32) -> Result<Self, RecordError> {
        let mut replay = Self::new(record)?;
        replay.go_near(frame)?;
        Ok(replay)
    }

    fn of(record: Cow<'a, Record>) -> Result<Self, RecordError> {
        let (game, recorded) = (begin(&record)?, of_scene(&record.scene));
        Ok(Self { record, cursor: Cursor::default(), game, frame: 0, recorded, divergence: None })
    }

    /// Goes to the last stored state that is not after `frame`, where there is one.
    ///
    /// # Errors
    /// When the state is not one of this game; nothing has changed then.
    fn go_near(&mut self, frame: u32) -> Result<(), RecordError> {
        let Some(state) = self.record.states.iter().rfind(|state| state.frame <= frame) else { return Ok(()) };
        let (frame, bytes) = (state.frame, state.bytes.clone());
        self.resume(&ReplayState { frame, bytes, divergence: None })
    }

    /// The record.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// The game.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Ends the replay and leaves the game, which can be played on from there.
    pub fn into_game(self) -> Game {
        self.game
    }

    /// Ends the replay and leaves the game, with the writer of a record that is the same so far and
    /// goes on with what is played from here.
    ///
    /// # Errors
    /// When the replay has diverged from its record.
    ///
    /// ```
    /// use teeter_game::{Command, Recorder, Replay, Rules, verify};
    /// use teeter_physics::Params;
    ///
    /// let scene = teeter_scene::named("column").unwrap();
    /// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
    /// recorder.step(&Command::Idle)?;
    /// let mut replay = Replay::owning(recorder.finish())?;
    /// replay.step();
    /// let (mut game, mut writer) = replay.play_on()?;
    /// game.step(&Command::Idle);
    /// writer.write(&Command::Idle, &game)?;
    /// let record = writer.finish(&game);
    /// assert_eq!((record.frames(), verify(&record)?.same), (2, true));
    /// # Ok::<(), teeter_game::RecordError>(())
    /// ```
    pub fn play_on(self) -> Result<(Game, RecordWriter), RecordError> {
        if let Some(divergence) = self.divergence {
            return Err(RecordError::Diverged(divergence.frame));
        }
        Ok((self.game, RecordWriter::resume(self.record.into_owned(), self.frame)))
    }

    /// Number of frames so far.
    pub fn frame(&self) -> u32 {
        self.frame
    }

    /// True while every frame was that of the record.
    pub fn is_same(&self) -> bool {
        self.divergence.is_none()
    }

    /// First frame that was not that of the record, and the block that is elsewhere; none while
    /// every frame was.
    pub fn divergence(&self) -> Option<Divergence> {
        self.divergence
    }

    /// Plays the next frame; none after the last.
    pub fn step(&mut self) -> Option<Update<StepReport>> {
        let command = self.record.tape.next(&mut self.cursor)?;
        let update = self.game.step(&command);
        let mut is_same = self.record.checks.get(self.frame as usize) == Some(&frame_check(&self.game));
        self.frame += 1;
        let time_s = f64::from(self.frame) * self.record.params.frame;
        if let Some(sample) = self.sample_index().and_then(|index| self.record.samples.get(index)) {
            is_same &= sample.hash == self.game.state_hash();
            sample.changes.iter().for_each(|change| self.recorded[change.body.index()] = change.pose);
            if let Some(divergence) = self.divergence.as_mut().filter(|divergence| divergence.block.is_none()) {
                divergence.block = displaced(&self.game, &self.recorded, time_s);
            }
        }
        if !is_same && self.divergence.is_none() {
            let is_sampled = self.sample_index().is_some();
            let block = if is_sampled { displaced(&self.game, &self.recorded, time_s) } else { None };
            self.divergence = Some(Divergence { frame: self.frame, time_s, block });
        }
        Some(update)
    }

    /// State of the replay, to resume from.
    pub fn save(&self) -> ReplayState {
        ReplayState { frame: self.frame, bytes: self.game.snapshot(), divergence: self.divergence }
    }

    /// Goes back or forth to a state of this replay.
    ///
    /// # Errors
    /// When the state is not one of this game; nothing has changed then.
    pub fn resume(&mut self, state: &ReplayState) -> Result<(), RecordError> {
        self.game.restore(&state.bytes).map_err(|_| RecordError::Damaged("its states"))?;
        (self.frame, self.divergence) = (state.frame, state.divergence);
        self.cursor = self.record.tape.cursor(state.frame);
        self.recorded = of_scene(&self.record.scene);
        let passed = (state.frame / self.record.interval()) as usize;
        let changes = self.record.samples.iter().take(passed).flat_map(|sample| &sample.changes);
        changes.for_each(|change| self.recorded[change.body.index()] = change.pose);
        Ok(())
    }

    /// Sample at the end of this frame.
    fn sample_index(&self) -> Option<usize> {
        let interval = self.record.interval();
        let is_sampled = self.frame.is_multiple_of(interval) || self.frame == self.record.frames();
        is_sampled.then(|| self.frame.div_ceil(interval) as usize - 1)
    }
}

impl Replay<'static> {
    /// A replay that owns its record, from the start.
    ///
    /// # Errors
    /// When no game begins like this.
    pub fn owning(record: Record) -> Result<Self, RecordError> {
        Self::of(Cow::Owned(record))
    }
}

/// State of a replay after some frames.
///
/// ```
/// use teeter_game::{Command, Recorder, Replay, Rules};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// let mut replay = Replay::owning(recorder.finish())?;
/// let start = replay.save();
/// replay.step();
/// replay.resume(&start)?;
/// assert_eq!((replay.frame(), start.frame()), (0, 0));
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayState {
    frame: u32,
    bytes: Vec<u8>,
    divergence: Option<Divergence>,
}

impl ReplayState {
    /// Number of frames.
    pub fn frame(&self) -> u32 {
        self.frame
    }

    /// Memory that it takes, bytes.
    pub fn size(&self) -> usize {
        self.bytes.len()
    }
}

/// Divergence of a replay from its record.
///
/// ```
/// use teeter_game::{Command, Recorder, Rules, verify};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// let mut record = recorder.finish();
/// record.scene.gravity = 1.6;
/// let divergence = verify(&record)?.divergence.unwrap();
/// assert_eq!(divergence.frame, 1);
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Divergence {
    /// First frame whose check differs, from 1. Of sixteen divergences one is found a frame late.
    pub frame: u32,
    /// Simulated time at the end of that frame, s.
    pub time_s: f64,
    /// Block that is farthest from where the record has it, at the first keyframe after that at
    /// which one is visibly elsewhere; none where none is.
    pub block: Option<Displaced>,
}

/// Block that is elsewhere than in the record.
///
/// ```
/// use teeter_game::Displaced;
/// use teeter_physics::BodyId;
///
/// let block = Displaced { body: BodyId(4), distance: 0.002, time_s: 3.0 };
/// assert_eq!(block.body, BodyId(4));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Displaced {
    /// The block.
    pub body: BodyId,
    /// Distance from its position in the record, m.
    pub distance: f64,
    /// Simulated time of the keyframe, s.
    pub time_s: f64,
}

/// Result of a replay.
///
/// ```
/// use teeter_game::{Recorder, Rules, verify};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let record = Recorder::new(&scene, Params::default(), Rules::default())?.finish();
/// assert!(verify(&record)?.same);
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verification {
    /// True when every frame is that of the record.
    pub same: bool,
    /// Hash of the world's state at the end of the replay, or where it was given up.
    pub hash: u64,
    /// Divergence; none where the replay is the same.
    pub divergence: Option<Divergence>,
}

/// Replays a record to its end, or to the keyframe after its divergence at which a block is
/// visibly elsewhere.
///
/// # Errors
/// When no game begins like this.
pub fn verify(record: &Record) -> Result<Verification, RecordError> {
    let mut replay = Replay::new(record)?;
    while replay.step().is_some() {
        if replay.divergence.is_some_and(|divergence| divergence.block.is_some()) {
            break;
        }
    }
    Ok(Verification { same: replay.is_same(), hash: replay.game.hash(), divergence: replay.divergence })
}

/// The block that is farthest from where the record has it, where that is visible.
fn displaced(game: &Game, recorded: &[RoundedPose], time_s: f64) -> Option<Displaced> {
    let poses = game.world().poses().chunks_exact(POSE_STRIDE).map(rounded);
    let distances = poses.zip(recorded).map(|(pose, recorded)| position(&pose).distance(position(recorded)));
    let blocks = (0..).map(BodyId).zip(distances).map(|(body, distance)| Displaced { body, distance, time_s });
    let farthest = blocks.reduce(|a, b| if b.distance > a.distance { b } else { a });
    farthest.filter(|block| block.distance > ELSEWHERE)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use teeter_physics::Params;
    use teeter_scene::{TowerOptions, tower};

    use super::*;
    use crate::command::Command;
    use crate::hand::grip::GripMode;
    use crate::record::recorder::Recorder;
    use crate::record::tape::{Run, Tape};
    use crate::rules::table::{Rules, Table};

    /// Commands that lift a block off the top and wave it about.
    fn commands() -> Vec<Command> {
        let grasp = Command::Grasp { body: BodyId(10), anchor: DVec3::ZERO, normal: DVec3::Z, grip: GripMode::Auto };
        let step = |displacement| Command::Move { displacement, slot: None, toward_viewer: None };
        let up = vec![step(DVec3::Z * 0.002); 40];
        let about = (0..80).map(|k| step(DVec3::X * if k % 40 < 20 { 0.003 } else { -0.003 }));
        [vec![Command::Idle; 30], vec![grasp], up, about.collect(), vec![Command::Idle; 60]].concat()
    }

    fn recorded(commands: &[Command]) -> Record {
        let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::default() }).unwrap();
        let rules = Rules::of(Table::Dissertation, 2);
        let mut recorder = Recorder::new(&scene, Params::default(), rules).unwrap().with_states(50);
        commands.iter().for_each(|command| drop(recorder.step(command).unwrap()));
        recorder.finish()
    }

    #[test]
    fn a_command_that_is_changed_is_found_in_its_frame_with_the_block_that_it_moves() {
        let commands = commands();
        let record = recorded(&commands);
        assert_eq!(verify(&record).unwrap().divergence, None);
        for frame in [45, 100] {
            let mut tape = Tape::default();
            for (i, command) in commands.iter().enumerate() {
                let command = if i == frame { Command::Idle } else { *command };
                tape.push(Run { command, frames: 1 }).unwrap();
            }
            let altered = Record { tape, ..record.clone() };
            let result = verify(&altered).unwrap();
            let divergence = result.divergence.unwrap();
            let first = frame as u32 + 1;
            assert!(!result.same && (first..first + 3).contains(&divergence.frame), "{divergence:?}");
            assert!((divergence.time_s - f64::from(divergence.frame) / 60.0).abs() < 1e-9);
            let block = divergence.block.unwrap();
            assert!(block.body == BodyId(10) && block.distance > 1e-3, "{block:?}");
            assert!(block.time_s >= divergence.time_s && block.time_s < divergence.time_s + 1.0);
        }
    }

    #[test]
    fn a_replay_from_any_stored_state_ends_the_same() {
        let record = recorded(&commands());
        let mut whole = Replay::new(&record).unwrap();
        while whole.step().is_some() {}
        assert!(whole.is_same());
        assert_eq!(record.state_frames(), [50, 100, 150, 200]);
        for frame in record.state_frames() {
            let mut replay = Replay::near(&record, frame + 20).unwrap();
            assert_eq!(replay.frame(), frame);
            while replay.step().is_some() {}
            assert!(replay.is_same(), "from frame {frame}");
            assert_eq!(replay.game().snapshot(), whole.game().snapshot(), "from frame {frame}");
        }
        assert_eq!(Replay::near(&record, 49).unwrap().frame(), 0);
    }

    #[test]
    fn a_hash_that_is_changed_is_a_divergence_at_its_second() {
        let mut record = recorded(&commands());
        record.samples[1].hash ^= 1;
        let divergence = verify(&record).unwrap().divergence.unwrap();
        assert_eq!((divergence.frame, divergence.block), (120, None));
    }

    #[test]
    fn a_state_of_another_game_is_refused() {
        let mut record = recorded(&commands());
        record.states[0].bytes.truncate(40);
        assert_eq!(Replay::near(&record, 60).unwrap_err(), RecordError::Damaged("its states"));
    }
}
