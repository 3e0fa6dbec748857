//! Binding of a replay: a record played again, or its keyframes where its engine is missing.

use teeter_game::{Listener, Record, ReplayState, engine_id};
use wasm_bindgen::prelude::*;

use crate::{Error, Game, sounds, text, views};

/// Frames from one state that is kept to the next: ten seconds.
const STATE_INTERVAL: u32 = 600;
/// Memory of the states that are kept, bytes.
const MAX_STATE_BYTES: usize = 64_000_000;

/// A record that is played again, and compared with its checks as it plays.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Replay {
    replay: teeter_game::Replay<'static>,
    /// States that were passed, to go back to, in order of their frames.
    kept: Vec<ReplayState>,
    /// Update of the last frame.
    update: String,
    lattices: Vec<f32>,
    /// Listener, and the frame that it heard last.
    listener: Option<(u32, Listener)>,
}

#[wasm_bindgen]
impl Replay {
    /// A replay from the start of a record (bytes). A record of another engine plays too, and may
    /// diverge.
    #[wasm_bindgen(constructor)]
    pub fn new(record: &[u8]) -> Result<Replay, Error> {
        let record = Record::decode(record).map_err(Error::rejected)?;
        let replay = teeter_game::Replay::owning(record).map_err(Error::rejected)?;
        let kept = vec![replay.save()];
        Ok(Self { replay, kept, update: String::new(), lattices: Vec::new(), listener: None })
    }

    /// Carries out the next command, and returns the update as JSON; undefined after the last.
    pub fn step(&mut self) -> Result<Option<String>, Error> {
        let Some(update) = self.replay.step() else { return Ok(None) };
        self.keep();
        self.update = text::write("update", &update)?;
        Ok(Some(self.update.clone()))
    }

    /// Goes toward a frame by at most `limit` frames that are played, from the nearest state before
    /// it. Returns true if it is there; else call it again.
    pub fn seek(&mut self, frame: u32, limit: u32) -> Result<bool, Error> {
        let frame = frame.min(self.frames());
        let nearest = self.kept.iter().rfind(|state| state.frame() <= frame);
        let is_farther = frame < self.frame();
        if let Some(state) = nearest.filter(|state| is_farther || state.frame() > self.frame()) {
            self.replay.resume(state).map_err(Error::rejected)?;
            self.update.clear();
        }
        for _ in 0..limit {
            if self.frame() == frame {
                break;
            }
            let Some(update) = self.replay.step() else { break };
            self.keep();
            if self.frame() == frame {
                self.update = text::write("update", &update)?;
            }
        }
        Ok(self.frame() == frame)
    }

    /// Ends the replay, and leaves the game of this moment: it can be played on, and its record
    /// goes on too. A replay that has diverged is refused.
    #[wasm_bindgen(js_name = playOn)]
    pub fn play_on(self) -> Result<Game, Error> {
        let (game, writer) = self.replay.play_on().map_err(Error::rejected)?;
        Ok(Game::of(game, writer))
    }

    /// Update of the last frame that was played, as JSON; undefined at the start.
    #[wasm_bindgen(getter)]
    pub fn update(&self) -> Option<String> {
        Some(self.update.clone()).filter(|update| !update.is_empty())
    }

    /// Number of frames so far.
    #[wasm_bindgen(getter)]
    pub fn frame(&self) -> u32 {
        self.replay.frame()
    }

    /// Number of frames of the record.
    #[wasm_bindgen(getter)]
    pub fn frames(&self) -> u32 {
        self.replay.record().frames()
    }

    /// True while every frame was that of the record.
    #[wasm_bindgen(getter, js_name = isSame)]
    pub fn is_same(&self) -> bool {
        self.replay.is_same()
    }

    /// Divergence from the record, as JSON: `{"frame", "time_s", "block": {"body", "distance",
    /// "time_s"} | null}`, with the frame counted from 1 and the block that is visibly elsewhere
    /// at the next keyframe; undefined while it is the same.
    pub fn divergence(&self) -> Result<Option<String>, Error> {
        self.replay.divergence().map(|divergence| text::write("divergence", &divergence)).transpose()
    }

    /// Scene at the start, as JSON.
    pub fn scene(&self) -> String {
        self.replay.record().scene.to_json()
    }

    /// Rules of the game, as JSON.
    pub fn rules(&self) -> Result<String, Error> {
        text::write("rules", &self.replay.record().rules)
    }

    /// Address of the poses in wasm memory: seven doubles a body, position (m) and orientation (x,
    /// y, z, w). Any later call may move them, so each view is made again.
    #[wasm_bindgen(js_name = posesPtr)]
    pub fn poses_ptr(&self) -> *const f64 {
        self.replay.game().world().poses().as_ptr()
    }

    /// Address in wasm memory of the particles and springs of all bodies, as those of a game.
    #[wasm_bindgen(js_name = latticesPtr)]
    pub fn lattices_ptr(&mut self) -> *const f32 {
        views::write_lattices(self.replay.game().world(), &mut self.lattices);
        self.lattices.as_ptr()
    }

    /// Sounds of the last frame, as those of `Listener.hear`. None where the frame before it was
    /// not heard: after a jump to another frame, or at the first call.
    pub fn sounds(&mut self) -> Vec<f32> {
        let (game, frame) = (self.replay.game(), self.frame());
        if let Some((heard, listener)) = &mut self.listener
            && *heard + 1 == frame
        {
            *heard = frame;
            return sounds::hear(listener, game);
        }
        self.listener = Some((frame, Listener::new(game.world())));
        Vec::new()
    }

    /// Number of bodies.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.replay.game().world().len()
    }

    /// Edge lengths of all bodies, three numbers each, m.
    pub fn sizes(&self) -> Vec<f64> {
        views::sizes(self.replay.game().world())
    }

    /// Load and tightness of each body, as those of a game.
    pub fn xray(&self) -> Vec<f64> {
        let world = self.replay.game().world();
        views::loads(world, world.scene().friction)
    }

    /// The world of this moment as bytes, for `Thought` and `TowerAnalysis`.
    pub fn world(&self) -> Vec<u8> {
        teeter_game::save_world(self.replay.game().world())
    }

    /// Hash of the world's state, 16 hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.replay.game().hash())
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.replay.game().world().time()
    }
}

impl Replay {
    /// Keeps the state where the last one is long ago.
    fn keep(&mut self) {
        let last = self.kept.last().map_or(0, ReplayState::frame);
        if self.frame() < last + STATE_INTERVAL {
            return;
        }
        let state = self.replay.save();
        let kept: usize = self.kept.iter().map(ReplayState::size).sum();
        if kept + state.size() <= MAX_STATE_BYTES {
            self.kept.push(state);
        }
    }
}

/// Poses of a record each second, rounded. They need no engine.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Keyframes {
    record: Record,
    /// Position (m) and orientation of each body, seven numbers, of the start and each keyframe.
    poses: Vec<Vec<f64>>,
}

#[wasm_bindgen]
impl Keyframes {
    /// Reads the keyframes of a record (bytes).
    #[wasm_bindgen(constructor)]
    pub fn new(record: &[u8]) -> Result<Keyframes, Error> {
        let record = Record::decode(record).map_err(Error::rejected)?;
        let start = record.scene.blocks.iter().flat_map(|block| [&block.pos[..], &block.rotation()].concat()).collect();
        let flat = |(position, orientation): (glam::DVec3, glam::DQuat)| {
            [&position.to_array()[..], &orientation.to_array()].concat()
        };
        let keyframes = record.keyframes().map(|poses| poses.into_iter().flat_map(flat).collect());
        let poses = std::iter::once(start).chain(keyframes).collect();
        Ok(Self { record, poses })
    }

    /// Length of the record, s.
    #[wasm_bindgen(getter)]
    pub fn seconds(&self) -> f64 {
        self.record.seconds()
    }

    /// Number of frames of the record.
    #[wasm_bindgen(getter)]
    pub fn frames(&self) -> u32 {
        self.record.frames()
    }

    /// Scene at the start, as JSON.
    pub fn scene(&self) -> String {
        self.record.scene.to_json()
    }

    /// Rules of the game, as JSON.
    pub fn rules(&self) -> Result<String, Error> {
        text::write("rules", &self.record.rules)
    }

    /// Number of bodies.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.record.scene.blocks.len()
    }

    /// Edge lengths of all bodies, three numbers each, m.
    pub fn sizes(&self) -> Vec<f64> {
        self.record.scene.blocks.iter().flat_map(|block| block.size).collect()
    }

    /// Poses of all bodies at a time (s), seven numbers each, between the two keyframes around it.
    pub fn poses(&self, time: f64) -> Vec<f64> {
        let interval = self.record.keyframe_interval();
        let last = self.poses.len() - 1;
        let at = if time > 0.0 { time.min(self.record.seconds()) / interval } else { 0.0 };
        let index = (at as usize).min(last.saturating_sub(1));
        // The last keyframe is that of the end, which can be earlier than a whole second.
        let width = (self.record.seconds() / interval - index as f64).min(1.0);
        let part = if width > 0.0 { ((at - index as f64) / width).clamp(0.0, 1.0) } else { 0.0 };
        let pairs = self.poses[index].chunks_exact(7).zip(self.poses[(index + 1).min(last)].chunks_exact(7));
        pairs.flat_map(|(before, after)| between(before, after, part)).collect()
    }
}

/// Pose between two, of seven numbers: positions along the line, orientations along the shorter
/// arc.
fn between(before: &[f64], after: &[f64], part: f64) -> [f64; 7] {
    let dot: f64 = (3..7).map(|k| before[k] * after[k]).sum();
    let sign = if dot < 0.0 { -1.0 } else { 1.0 };
    let mixed: [f64; 7] = std::array::from_fn(|k| {
        let after = if k < 3 { after[k] } else { sign * after[k] };
        before[k] + part * (after - before[k])
    });
    let length = mixed[3..].iter().map(|x| x * x).sum::<f64>().sqrt();
    std::array::from_fn(|k| if k < 3 || length == 0.0 { mixed[k] } else { mixed[k] / length })
}

/// Identity of the engine of this module.
#[wasm_bindgen(js_name = engineId)]
pub fn engine() -> String {
    engine_id()
}

/// Identity of the engine of a record (bytes): the module that has it replays the record bit for
/// bit. It can be read whatever else the record holds.
#[wasm_bindgen(js_name = recordEngine)]
pub fn record_engine(record: &[u8]) -> Result<String, Error> {
    Record::engine_of(record).map_err(Error::rejected)
}
