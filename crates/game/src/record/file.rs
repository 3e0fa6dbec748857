//! A record and its bytes.

use glam::{DQuat, DVec3};
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use teeter_physics::envelope::checksum;
use teeter_physics::{Params, Width};
use teeter_scene::Scene;

use crate::command::Command;
use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;
use crate::record::player_names::PlayerNames;
use crate::record::pose_code::{PoseChange, RoundedPose, of_scene, orientation, position};
use crate::record::tape::Tape;
use crate::record::{command_code, pose_code, scene_code};
use crate::rules::table::Rules;

/// Beginning of a file, and the version of its layout after it.
const MAGIC: &[u8] = b"teeter-record";
const VERSION: u8 = 2;
/// Version without names of players, and with scenes as JSON.
const NAMELESS: u8 = 1;
/// Largest content, bytes.
const MAX_CONTENT: usize = 64_000_000;
/// Effort of the compression, 0 to 10.
const LEVEL: u8 = 9;
/// Longest name of an engine, bytes.
const MAX_ENGINE: usize = 64;

/// State at the end of a second.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Hash of the game's state.
    pub hash: u64,
    /// Blocks that moved since the sample before.
    pub changes: Vec<PoseChange>,
}

/// Whole state of the game after some frames.
#[derive(Debug, Clone, PartialEq)]
pub struct StateFrame {
    /// Number of frames.
    pub frame: u32,
    /// Snapshot of the game.
    pub bytes: Vec<u8>,
}

/// Record of a game: all that it follows from, and checks that a replay is the same.
///
/// ```
/// use teeter_game::{Command, Record, Recorder, Rules, Table, verify};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::of(Table::Official, 2))?;
/// for _ in 0..90 {
///     recorder.step(&Command::Idle)?;
/// }
/// let bytes = recorder.finish().encode();
/// let record = Record::decode(&bytes)?;
/// assert_eq!((record.frames(), record.seconds()), (90, 1.5));
/// assert!(verify(&record)?.same);
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Identity of the engine that played the game, see [`engine_id`](crate::engine_id).
    pub engine: String,
    /// Names of the players; as many as were given.
    pub players: PlayerNames,
    /// Scene at the start.
    pub scene: Scene,
    /// Constants of the run. The register width changes no bit and is not stored.
    pub params: Params,
    /// Rules.
    pub rules: Rules,
    pub(crate) tape: Tape,
    /// Check of each frame, four bits.
    pub(crate) checks: Vec<u8>,
    pub(crate) samples: Vec<Sample>,
    pub(crate) states: Vec<StateFrame>,
}

impl Record {
    /// Number of frames.
    pub fn frames(&self) -> u32 {
        self.tape.frames()
    }

    /// Simulated time, s.
    pub fn seconds(&self) -> f64 {
        f64::from(self.frames()) * self.params.frame
    }

    /// Commands from a frame on, one a frame.
    pub fn commands(&self, from: u32) -> impl Iterator<Item = Command> + '_ {
        self.tape.from(from)
    }

    /// Frames after which the whole state is stored, so that a replay can begin there.
    pub fn state_frames(&self) -> Vec<u32> {
        self.states.iter().map(|state| state.frame).collect()
    }

    /// Positions (m) and orientations of all blocks at the end of each second and of the record,
    /// rounded to a twentieth of a millimetre. They need no engine.
    pub fn keyframes(&self) -> impl Iterator<Item = Vec<(DVec3, DQuat)>> + '_ {
        let mut poses = of_scene(&self.scene);
        self.samples.iter().map(move |sample| {
            sample.changes.iter().for_each(|change| poses[change.body.index()] = change.pose);
            poses.iter().map(|pose| (position(pose), orientation(pose))).collect()
        })
    }

    /// Time from one keyframe to the next, s.
    pub fn keyframe_interval(&self) -> f64 {
        f64::from(self.interval()) * self.params.frame
    }

    /// Number of frames from one sample to the next.
    pub(crate) fn interval(&self) -> u32 {
        sample_interval(&self.params)
    }

    /// Identity of the engine of a record, from its bytes: all that is read of one that another
    /// engine wrote, whatever its scene is.
    ///
    /// # Errors
    /// As [`Record::decode`], except for the content after the identity.
    pub fn engine_of(bytes: &[u8]) -> Result<String, RecordError> {
        let (_, content) = inflate(bytes)?;
        read_engine(&mut Reader::new(&content, "its content"))
    }

    /// The record as bytes.
    ///
    /// # Panics
    /// Never: parameters and rules are plain numbers, which can always be written.
    pub fn encode(&self) -> Vec<u8> {
        let mut content = Writer::default();
        content.bytes(self.engine.as_bytes());
        self.players.write(&mut content);
        scene_code::write(&mut content, &self.scene);
        let params = Params { width: Width::Auto, ..self.params };
        content.bytes(&postcard::to_stdvec(&params).expect("plain numbers can always be written"));
        content.bytes(&postcard::to_stdvec(&self.rules).expect("plain numbers can always be written"));
        content.bytes(&command_code::write(&self.tape));
        let pairs = self.checks.chunks(2).map(|pair| pair[0] << 4 | pair.get(1).unwrap_or(&0));
        content.bytes(&pairs.collect::<Vec<u8>>());
        content.bytes(&self.samples.iter().flat_map(|sample| sample.hash.to_le_bytes()).collect::<Vec<u8>>());
        let (mut changes, mut poses) = (Writer::default(), of_scene(&self.scene));
        self.samples.iter().for_each(|sample| pose_code::write(&mut changes, &mut poses, &sample.changes));
        content.bytes(&changes.0);
        content.unsigned(self.states.len() as u64);
        for state in &self.states {
            content.unsigned(u64::from(state.frame));
            content.bytes(&state.bytes);
        }
        seal(&compress_to_vec(&content.0, LEVEL))
    }

    /// Reads a record.
    ///
    /// # Errors
    /// Names the fault of bytes that are none: foreign, of another version, truncated, altered, or
    /// with a content that no record can have.
    pub fn decode(bytes: &[u8]) -> Result<Self, RecordError> {
        let (version, content) = inflate(bytes)?;
        let mut reader = Reader::new(&content, "its content");
        let engine = read_engine(&mut reader)?;
        let players = if version == NAMELESS { PlayerNames::default() } else { PlayerNames::read(&mut reader)? };
        let scene = scene_code::read(&mut reader)?;
        let params: Params = read_plain(&mut reader, "its parameters")?;
        let rules: Rules = read_plain(&mut reader, "its rules")?;
        rules.validate().map_err(|_| RecordError::Damaged("its rules"))?;
        let tape = command_code::read(reader.bytes()?)?;
        let checks = read_checks(reader.bytes()?, tape.frames())?;
        let samples = read_samples(reader.bytes()?, reader.bytes()?, &scene)?;
        let states = read_states(&mut reader, tape.frames())?;
        reader.end()?;
        let is_frame = (1e-4..=0.1).contains(&params.frame);
        let count = if is_frame { tape.frames().div_ceil(sample_interval(&params)) } else { 0 };
        if samples.len() != count as usize {
            return Err(RecordError::Damaged("its samples"));
        }
        Ok(Self { engine, players, scene, params, rules, tape, checks, samples, states })
    }
}

/// Number of frames of a second.
fn sample_interval(params: &Params) -> u32 {
    (1.0 / params.frame).round().max(1.0) as u32
}

/// Puts the version, the length and the checksum before compressed content.
fn seal(compressed: &[u8]) -> Vec<u8> {
    let len = (compressed.len() as u32).to_le_bytes();
    let sum = checksum(compressed).to_le_bytes();
    [MAGIC, &[VERSION], &len, &sum, compressed].concat()
}

/// Returns the version and the compressed content of a file.
fn open(bytes: &[u8]) -> Result<(u8, &[u8]), RecordError> {
    let found = bytes.len() as u64;
    let header = MAGIC.len() + 1 + 4 + 8;
    let short = RecordError::Truncated { found, expected: header as u64 };
    if !bytes.is_empty() && MAGIC.starts_with(bytes) {
        return Err(short);
    }
    let rest = bytes.strip_prefix(MAGIC).ok_or(RecordError::Foreign)?;
    let (&version, rest) = rest.split_first().ok_or(short.clone())?;
    if ![NAMELESS, VERSION].contains(&version) {
        return Err(RecordError::Version { found: version, expected: VERSION });
    }
    let (len, rest) = rest.split_first_chunk().ok_or(short.clone())?;
    let (sum, content) = rest.split_first_chunk().ok_or(short)?;
    let expected = header as u64 + u64::from(u32::from_le_bytes(*len));
    if found < expected {
        return Err(RecordError::Truncated { found, expected });
    }
    if found > expected {
        return Err(RecordError::TooLong { found, expected });
    }
    if u64::from_le_bytes(*sum) == checksum(content) { Ok((version, content)) } else { Err(RecordError::Altered) }
}

/// Returns the version and the content of a file.
fn inflate(bytes: &[u8]) -> Result<(u8, Vec<u8>), RecordError> {
    let (version, compressed) = open(bytes)?;
    let content = decompress_to_vec_with_limit(compressed, MAX_CONTENT);
    content.map(|content| (version, content)).map_err(|_| RecordError::Damaged("its compression"))
}

/// Reads the identity of the engine. It comes first in every version of the layout.
fn read_engine(reader: &mut Reader) -> Result<String, RecordError> {
    let name = std::str::from_utf8(reader.bytes()?).ok();
    let is_printable = |name: &&str| name.len() <= MAX_ENGINE && name.chars().all(|c| c.is_ascii_graphic());
    name.filter(is_printable).map(str::to_owned).ok_or(RecordError::Damaged("its engine"))
}

/// Reads plain numbers that were written by postcard.
fn read_plain<T: serde::de::DeserializeOwned>(reader: &mut Reader, part: &'static str) -> Result<T, RecordError> {
    match postcard::take_from_bytes(reader.bytes()?) {
        Ok((value, [])) => Ok(value),
        _ => Err(RecordError::Damaged(part)),
    }
}

fn read_checks(bytes: &[u8], frames: u32) -> Result<Vec<u8>, RecordError> {
    let mut checks: Vec<u8> = bytes.iter().flat_map(|pair| [pair >> 4, pair & 0xf]).collect();
    let is_padded = frames % 2 == 1 && checks.last() == Some(&0);
    if is_padded {
        checks.pop();
    }
    if checks.len() == frames as usize { Ok(checks) } else { Err(RecordError::Damaged("its checks")) }
}

fn read_samples(hashes: &[u8], changes: &[u8], scene: &Scene) -> Result<Vec<Sample>, RecordError> {
    let (hashes, rest) = hashes.as_chunks::<8>();
    let mut reader = Reader::new(changes, "its keyframes");
    let mut poses: Vec<RoundedPose> = of_scene(scene);
    let mut samples = Vec::new();
    for hash in hashes {
        let changes = pose_code::read(&mut reader, &mut poses)?;
        samples.push(Sample { hash: u64::from_le_bytes(*hash), changes });
    }
    reader.end()?;
    if rest.is_empty() { Ok(samples) } else { Err(RecordError::Damaged("its hashes")) }
}

fn read_states(reader: &mut Reader, frames: u32) -> Result<Vec<StateFrame>, RecordError> {
    let mut states: Vec<StateFrame> = Vec::new();
    for _ in 0..reader.unsigned()? {
        let state = StateFrame { frame: reader.index()?, bytes: reader.bytes()?.to_vec() };
        let is_later = states.last().is_none_or(|last| last.frame < state.frame);
        if !is_later || state.frame > frames {
            return Err(RecordError::Damaged("its states"));
        }
        states.push(state);
    }
    Ok(states)
}
