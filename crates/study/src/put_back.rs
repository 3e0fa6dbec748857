//! Put-back: a block drawn some distance out of a tower by the hand, and pushed in again.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Hand, Input, World};

use crate::cuboid::Cuboid;
use crate::end_grip::EndGrip;
use crate::fall::Footing;
use crate::hand_path::HandPath;

/// Displacements from which another block counts as moved and as displaced, m.
const MOVED: f64 = 1e-3;
const DISPLACED: f64 = 5e-3;

/// Speed and pauses of the hand.
///
/// ```
/// let careful = teeter_study::PutBackOptions { speed: 0.03, ..Default::default() };
/// assert!(careful.speed < teeter_study::PutBackOptions::default().speed);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PutBackOptions {
    /// Speed of the hand, m/s. That of the game goes up to 0.25.
    pub speed: f64,
    /// Time for which the hand holds still when the block is out, and again when it is back, s.
    pub pause: f64,
    /// Time from the release until the others are compared, s.
    pub rest: f64,
}

impl Default for PutBackOptions {
    fn default() -> Self {
        Self { speed: 0.05, pause: 0.25, rest: 1.0 }
    }
}

/// Outcome of a put-back.
///
/// ```
/// # use teeter_physics::{BodyId, Params};
/// # use teeter_study::{PutBackOptions, put_back, settled};
/// # let options = teeter_scene::TowerOptions::exact();
/// let scene = teeter_scene::loose("(000)-(0L0)-(000)", &options).unwrap();
/// let world = settled(&scene, Params::default())?;
/// let back = put_back(&world, BodyId(4), 0.01, &PutBackOptions::default());
/// assert!(back.out && back.fell == 0 && back.aside_mm < 0.5);
/// assert!(back.moved_1_mm == 0 && back.moved_5_mm == 0 && back.worst_mm < 0.2);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PutBack {
    /// True when the block followed the hand for at least half of the distance.
    pub out: bool,
    /// Other blocks that lie more than 1 mm from where they were.
    pub moved_1_mm: usize,
    /// Other blocks that lie more than 5 mm from where they were.
    pub moved_5_mm: usize,
    /// Largest displacement of another block at the end, mm.
    pub worst_mm: f64,
    /// Other blocks that fell.
    pub fell: usize,
    /// Median force of the hand along the block while it pushes the block in, N; what it carries of
    /// the weight not included.
    pub force_n: f64,
    /// Distance of the block from where it was, mm.
    pub aside_mm: f64,
}

/// Draws `body` out of a settled world by `distance` (m) along its long axis, pushes it in to where
/// it was, lets go, and compares the others once the tower rests.
///
/// The hand holds the middle of the block's end face, keeps the orientation and has the default
/// force of a careful hand.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use teeter_physics::{BodyId, Params};
/// use teeter_study::{PutBackOptions, put_back, settled};
///
/// let scene = teeter_scene::named("block").unwrap();
/// let world = settled(&scene, Params::default())?;
/// let back = put_back(&world, BodyId(0), 0.04, &PutBackOptions::default());
/// // the hand carries four fifths of the weight, and friction resists with the rest
/// let friction = scene.friction * 0.2 * scene.blocks[0].mass * scene.gravity;
/// assert!(back.out && (back.force_n / friction - 1.0).abs() < 0.1);
/// assert!(back.aside_mm < 1.0);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn put_back(settled: &World, body: BodyId, distance: f64, options: &PutBackOptions) -> PutBack {
    let grip = EndGrip::new(settled, body, long_axis(settled, body));
    let mut trial = Trial {
        world: settled.clone(),
        footing: Footing::of(settled),
        body,
        axis: grip.axis,
        fallen: vec![false; settled.len()],
        forces: Vec::new(),
    };
    let path = |hand| HandPath::new(hand, settled.params().frame);
    let start = grip.hand();
    trial.follow(path(start.clone()).line_along(grip.axis, distance, options.speed).pause(options.pause));
    let travel = grip.axis.dot(trial.world.pose(body).position - settled.pose(body).position);
    trial.forces.clear();
    let end = Hand { target: start.target + grip.axis * distance, ..start.clone() };
    trial.follow(path(end).line(start.target, options.speed));
    let force_n = median(std::mem::take(&mut trial.forces));
    trial.follow(path(start).pause(options.pause));
    for _ in 0..trial.world.frames(options.rest) {
        trial.step(&Input::default());
    }
    let Trial { world, fallen, .. } = trial;
    let moved = |body: BodyId| world.pose(body).position.distance(settled.pose(body).position);
    let others: Vec<f64> = world.bodies().filter(|other| *other != body).map(moved).collect();
    let beyond = |limit: f64| others.iter().filter(|moved| **moved > limit || moved.is_nan()).count();
    PutBack {
        out: travel > 0.5 * distance,
        moved_1_mm: beyond(MOVED),
        moved_5_mm: beyond(DISPLACED),
        worst_mm: 1e3 * others.iter().copied().fold(0.0, f64::max),
        fell: fallen.iter().filter(|fell| **fell).count(),
        force_n,
        aside_mm: 1e3 * moved(body),
    }
}

/// Put-back in progress.
struct Trial {
    world: World,
    footing: Footing,
    /// Block that the hand moves.
    body: BodyId,
    /// Direction of the path, a unit vector.
    axis: DVec3,
    fallen: Vec<bool>,
    /// Force of the hand along the path in each frame, N.
    forces: Vec<f64>,
}

impl Trial {
    fn follow(&mut self, path: HandPath) {
        path.into_iter().for_each(|hand| self.step(&Input::hand(hand)));
    }

    fn step(&mut self, input: &Input) {
        let report = self.world.step(input);
        self.forces.extend(report.hand.map(|hand| hand.force.dot(self.axis).abs()));
        let body = self.body;
        self.footing.mark_fallen(&Cuboid::all(&self.world), |other| other == body, &mut self.fallen);
    }
}

/// Unit vector of the world along the longest edge of a block.
fn long_axis(world: &World, body: BodyId) -> DVec3 {
    let size = world.size(body);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let longest = (0..3).fold(0, |longest, k| if size[k] > size[longest] { k } else { longest });
    world.pose(body).orientation * axes[longest]
}

/// Median; 0 for no values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
