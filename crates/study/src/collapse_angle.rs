//! Angle at which a tower on a tilted floor collapses.
//!
//! Gravity turns instead of the floor: g (sin t cos az, sin t sin az, -cos t). A tower just beyond
//! its balance falls slowly at first, so a ramp that runs until blocks have moved reads late by a
//! tenth of a degree or more. Therefore three stages:
//!
//! 1. a coarse ramp, which finds the neighbourhood;
//! 2. from a state some degrees before it, a fine ramp with a snapshot at every [`RESOLUTION`],
//!    which reads late as well;
//! 3. from those snapshots, constant gravity: where the tower falls the angle is above that of
//!    collapse, elsewhere below. Bisection finds two neighbours, and the angle lies between them.

use glam::DVec3;
use teeter_physics::{BuildError, Input, Params, World};
use teeter_scene::Scene;

use crate::fall::Footing;

/// Time to settle upright, s.
const SETTLE_TIME: f64 = 1.0;
/// Rate of the coarse ramp, degrees/s.
const COARSE_RATE: f64 = 3.0;
/// Angle from the beginning of the fine ramp to the reading of the coarse one, degrees: more than
/// the lag of that reading, which is about 1 degree for a tall tower.
const BACKTRACK: f64 = 2.5;
/// Rate of the fine ramp, degrees/s.
const FINE_RATE: f64 = 0.5;
/// Angle between the snapshots of the fine ramp, degrees: half of it is the error of the result.
const RESOLUTION: f64 = 0.02;
/// Time of constant gravity, s. A tower 0.02 degrees beyond balance grows e-fold in about 0.1 s and
/// falls within 1 s; a block as far beyond sliding goes 9 mm.
const HOLD: f64 = 2.5;
/// Largest angle tried, degrees.
const MAX_ANGLE: f64 = 60.0;

/// Returns the angle at which the tower of `scene` collapses when tilted towards `azimuth` (rad),
/// degrees; none where it stands up to 60 degrees. A tower that falls upright has 0.
///
/// # Errors
/// When the world cannot be built.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::collapse_angle;
///
/// let scene = teeter_scene::named("block").unwrap();
/// let angle = collapse_angle(&scene, 0.0, Params { sleep: false, ..Params::default() })?.unwrap();
/// // the block slides at the angle of friction
/// assert!((angle.to_radians().tan() / scene.friction - 1.0).abs() < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn collapse_angle(scene: &Scene, azimuth: f64, params: Params) -> Result<Option<f64>, BuildError> {
    let mut tower = TiltedTower::new(scene, azimuth, params)?;
    if tower.falls_upright() {
        return Ok(Some(0.0));
    }
    let Some((mut states, reading)) = tower.coarse_ramp() else { return Ok(None) };
    loop {
        let from = states.iter().rposition(|s| s.angle <= reading - BACKTRACK).unwrap_or(0);
        states.truncate(from + 1);
        tower.restore(&states[from]);
        let (fine, reading) = tower.fine_ramp();
        // states in order of angle: all before `stands` stand, all from `falls` on fall
        let (mut stands, mut falls) = (0, fine.len());
        if from > 0 && tower.falls_from(&fine[0]) {
            // even the first state is beyond collapse
            states.pop();
            continue;
        }
        while falls - stands > 1 {
            let middle = (stands + falls) / 2;
            if tower.falls_from(&fine[middle]) { falls = middle } else { stands = middle }
        }
        let upper = fine.get(falls).map_or(reading, |s| s.angle);
        return Ok(Some((fine[stands].angle + upper) / 2.0));
    }
}

/// Snapshot of a ramp.
struct State {
    /// Tilt, degrees.
    angle: f64,
    snapshot: Vec<u8>,
}

/// Tower on a floor that is being tilted.
struct TiltedTower {
    world: World,
    /// Gravity, m/s².
    gravity: f64,
    /// Direction of the tilt, rad.
    azimuth: f64,
    /// Tilt, degrees.
    angle: f64,
    /// Footing at the beginning of the tilt.
    footing: Footing,
}

impl TiltedTower {
    fn new(scene: &Scene, azimuth: f64, params: Params) -> Result<Self, BuildError> {
        let world = World::new(scene, params)?;
        let footing = Footing::of_scene(scene);
        Ok(Self { world, gravity: scene.gravity, azimuth, angle: 0.0, footing })
    }

    /// Advances by a frame; returns true if the tower has collapsed: a block has fallen or slid.
    fn step(&mut self) -> bool {
        let (sin, cos) = libm::sincos(self.angle.to_radians());
        let (sin_az, cos_az) = libm::sincos(self.azimuth);
        let gravity = self.gravity * DVec3::new(sin * cos_az, sin * sin_az, -cos);
        let report = self.world.step(&Input::gravity(gravity));
        !report.quarantined.is_empty() || self.footing.any_fallen_or_slid(&self.world)
    }

    /// Lets the tower settle upright; returns true if it falls.
    fn falls_upright(&mut self) -> bool {
        let falls = (0..self.world.frames(SETTLE_TIME)).any(|_| self.step());
        self.footing = Footing::of(&self.world);
        falls
    }

    /// Advances a ramp of `rate` (degrees/s) by a frame; returns true if the tower has collapsed.
    fn ramp(&mut self, rate: f64) -> bool {
        self.angle += rate * self.world.params().frame;
        self.step()
    }

    /// Ramps until the tower collapses. Returns states a degree apart and the last angle, degrees;
    /// none where the tower stands up to [`MAX_ANGLE`].
    fn coarse_ramp(&mut self) -> Option<(Vec<State>, f64)> {
        let mut states = vec![self.state()];
        loop {
            if self.ramp(COARSE_RATE) {
                return Some((states, self.angle));
            }
            if self.angle >= MAX_ANGLE {
                return None;
            }
            if self.angle >= states.len() as f64 {
                states.push(self.state());
            }
        }
    }

    /// Ramps until the tower collapses. Returns states [`RESOLUTION`] apart and the last angle,
    /// degrees.
    fn fine_ramp(&mut self) -> (Vec<State>, f64) {
        let mut states = vec![self.state()];
        while !self.ramp(FINE_RATE) {
            if self.angle >= states[0].angle + RESOLUTION * states.len() as f64 {
                states.push(self.state());
            }
        }
        (states, self.angle)
    }

    /// Returns true if the tower falls from a state under constant gravity.
    fn falls_from(&mut self, state: &State) -> bool {
        self.restore(state);
        (0..self.world.frames(HOLD)).any(|_| self.step())
    }

    fn state(&self) -> State {
        State { angle: self.angle, snapshot: self.world.snapshot() }
    }

    fn restore(&mut self, state: &State) {
        self.angle = state.angle;
        self.world.restore(&state.snapshot).expect("the snapshot is this world's own");
    }
}
