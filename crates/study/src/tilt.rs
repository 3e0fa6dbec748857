//! The angle at which a tower on a tilted floor collapses.
//!
//! Gravity is turned instead of the floor: g (sin t cos az, sin t sin az, -cos t). A tower that has just lost its balance falls slowly at first, so
//! a ramp that runs until blocks have moved reads late by a tenth of a degree or more. Therefore three stages:
//!
//! 1. a coarse ramp, only to find the neighbourhood;
//! 2. from a state some degrees before it, a fine ramp that keeps a snapshot at every [`GRAIN`] and again reads late;
//! 3. from those snapshots, gravity held still: a state from which the tower falls is past the angle, one from which it does not is before it.
//!    Bisection finds two neighbours of which one stands and one falls; the answer lies between them.

use glam::DVec3;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::places::Places;

/// Time to settle upright, s.
const SETTLE: f64 = 1.0;
/// Rate of the coarse ramp, degrees/s.
const COARSE: f64 = 3.0;
/// How far before the coarse reading the fine ramp begins, degrees. More than the coarse one's lag, which is about 1 degree for a tall tower.
const BACK: f64 = 2.5;
/// Rate of the fine ramp, degrees/s.
const FINE: f64 = 0.5;
/// Between the snapshots of the fine ramp, degrees: half of it is the error of the answer.
const GRAIN: f64 = 0.02;
/// How long gravity is held, s. What is past balance by 0.02 degrees grows e-fold in about 0.1 s and has fallen within 1 s; a block that is past
/// sliding by as much has gone 9 mm.
const HOLD: f64 = 2.5;
/// A tower has collapsed when a block has moved further than this from its place at the start of the tilt, m. Well above what contacts of
/// 1e6 N/m lean by, and soon passed by what falls.
const MOVED: f64 = 5e-3;
/// Steepest angle tried, degrees.
const STEEPEST: f64 = 60.0;

/// The angle at which the tower of `scene` collapses when tilted towards `az`, degrees; none where it does not up to [`STEEPEST`].
/// A tower that falls upright has 0.
pub fn collapse(scene: &Scene, az: f64, params: Params) -> Result<Option<f64>, BuildError> {
    let mut tower = Tilted::new(scene, az, params)?;
    if tower.settle_falls() {
        return Ok(Some(0.0));
    }
    // The states of the coarse ramp, one a degree.
    let mut states = vec![tower.state()];
    let reading = loop {
        if tower.ramp(COARSE) {
            break tower.angle;
        }
        if tower.angle >= STEEPEST {
            return Ok(None);
        }
        if tower.angle >= states.len() as f64 {
            states.push(tower.state());
        }
    };
    loop {
        let from = states.iter().rposition(|s| s.angle <= reading - BACK).unwrap_or(0);
        states.truncate(from + 1);
        tower.take(&states[from]);
        let fine = tower.fine_ramp();
        // States in order of angle: all before `stands` stand, all from `falls` on fall.
        let (mut stands, mut falls) = (0, fine.len());
        if from > 0 && tower.falls_from(&fine[0]) {
            // Even the first is past it: begin further back.
            states.pop();
            continue;
        }
        while falls - stands > 1 {
            let middle = (stands + falls) / 2;
            if tower.falls_from(&fine[middle]) { falls = middle } else { stands = middle }
        }
        let upper = fine.get(falls).map_or(tower.last_reading, |s| s.angle);
        return Ok(Some((fine[stands].angle + upper) / 2.0));
    }
}

/// A moment of a ramp.
struct State {
    angle: f64,
    bytes: Vec<u8>,
}

/// A tower on a floor that is being tilted.
struct Tilted {
    world: World,
    gravity: f64,
    az: f64,
    /// Tilt, degrees.
    angle: f64,
    /// Where the blocks were when the tilt began.
    start: Places,
    /// Angle at which the last ramp saw the tower fall, degrees.
    last_reading: f64,
}

impl Tilted {
    fn new(scene: &Scene, az: f64, params: Params) -> Result<Self, BuildError> {
        let world = World::new(scene, params)?;
        let start = Places::of(&world);
        Ok(Self { world, gravity: scene.gravity, az, angle: 0.0, start, last_reading: 0.0 })
    }

    /// Steps one frame; whether the tower has collapsed.
    fn step(&mut self) -> bool {
        let (sin, cos) = libm::sincos(self.angle.to_radians());
        let (sin_az, cos_az) = libm::sincos(self.az);
        let gravity = self.gravity * DVec3::new(sin * cos_az, sin * sin_az, -cos);
        let report = self.world.step(&Input { gravity: Some(gravity), ..Input::default() });
        // Written so that a distance that is no number counts as collapse.
        !(report.quarantined.is_empty() && self.start.furthest(&self.world) <= MOVED)
    }

    fn frames(&self, seconds: f64) -> u32 {
        (seconds / self.world.params().frame).round() as u32
    }

    /// Lets the tower settle upright; whether it falls.
    fn settle_falls(&mut self) -> bool {
        let falls = (0..self.frames(SETTLE)).any(|_| self.step());
        self.start = Places::of(&self.world);
        falls
    }

    /// One frame of a ramp of `rate` degrees/s; whether the tower has collapsed.
    fn ramp(&mut self, rate: f64) -> bool {
        self.angle += rate * self.world.params().frame;
        self.step()
    }

    /// Ramps until the tower falls; the states on the way.
    fn fine_ramp(&mut self) -> Vec<State> {
        let mut states = vec![self.state()];
        while !self.ramp(FINE) {
            if self.angle >= states[0].angle + GRAIN * states.len() as f64 {
                states.push(self.state());
            }
        }
        self.last_reading = self.angle;
        states
    }

    /// Whether the tower falls from a state with gravity held still.
    fn falls_from(&mut self, state: &State) -> bool {
        self.take(state);
        (0..self.frames(HOLD)).any(|_| self.step())
    }

    fn state(&self) -> State {
        State { angle: self.angle, bytes: self.world.snapshot() }
    }

    fn take(&mut self, state: &State) {
        self.angle = state.angle;
        self.world.restore(&state.bytes).expect("the snapshot is this world's own");
    }
}
