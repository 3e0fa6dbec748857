//! Target: random scenes of bodies that fall onto each other. They gain no energy, and nothing
//! passes through anything.

use std::fmt;

use glam::{DQuat, DVec3};
use teeter_physics::{EnergyBalance, Input, Params, World};
use teeter_scene::{Block, Form, Penetration, Random, Scene, Springs};

/// Largest gain of a frame over the energy at the start.
const MAX_GAIN: f64 = 1e-3;
/// Largest depth of a block in another or the floor, over the smallest edge of the two.
const MAX_DEPTH: f64 = 0.5;
/// Time for which the target simulates a scene, s.
const TARGET_TIME: f64 = 0.5;

/// Range of the constants of random scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Blocks of wood with edges of 2 to 100 mm, as in games.
    Plausible,
    /// Blocks of any material with edges of 4 to 500 mm, fast, on soft and on stiff contacts.
    Wide,
}

/// Rule that a run breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Violation {
    /// A frame gained this part of the energy at the start.
    Gain(f64),
    /// A block was deeper in another or in the floor than is allowed, by this part of an edge.
    Depth(f64),
    /// A body was frozen.
    Quarantine,
    /// A frame had more substeps than the world has.
    Substeps(u32),
}

/// Largest figures of a run.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extremes {
    /// Gain of a frame over the energy at the start.
    pub gain: f64,
    /// Depth of a block in another or in the floor over the smallest edge of the two.
    pub depth: f64,
    /// Syncs of a frame over its substeps.
    pub syncs: f64,
    /// Bodies frozen.
    pub quarantined: usize,
    /// Excess of the substeps of a frame over those of the world.
    pub excess: u32,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gain(gain) => write!(f, "a frame gains {gain:.1e} of the energy"),
            Self::Depth(depth) => write!(f, "a block sinks by {depth:.2} of an edge"),
            Self::Quarantine => write!(f, "a body is frozen"),
            Self::Substeps(excess) => write!(f, "a frame has {excess} substeps too many"),
        }
    }
}

impl Extremes {
    /// Simulates a scene for `seconds` and measures it.
    ///
    /// # Panics
    /// When the scene cannot be simulated.
    pub fn of(scene: &Scene, seconds: f64) -> Self {
        let mut world = World::new(scene, Params::default()).expect("random scenes are valid");
        let start = world.energy().total();
        let substeps = (world.params().frame / world.substep()).round() as u32;
        let mut balance = EnergyBalance::new(&world);
        let mut extremes = Self::default();
        for _ in 0..world.frames(seconds) {
            let report = world.step(&Input::default());
            balance.record(&world, &report);
            let deepest = Penetration::deepest(&world.to_scene(), extremes.depth);
            extremes.depth = deepest.map_or(extremes.depth, |penetration| penetration.share);
            extremes.syncs = extremes.syncs.max(f64::from(report.syncs) / f64::from(report.substeps.max(1)));
            extremes.quarantined += report.quarantined.len();
            extremes.excess = extremes.excess.max(report.substeps.saturating_sub(substeps));
        }
        extremes.gain = balance.worst_gain() / start;
        extremes
    }

    /// Violations of the run.
    pub fn violations(&self) -> impl Iterator<Item = Violation> {
        let gain = (self.gain.is_nan() || self.gain > MAX_GAIN).then_some(Violation::Gain(self.gain));
        let depth = (self.depth.is_nan() || self.depth > MAX_DEPTH).then_some(Violation::Depth(self.depth));
        let quarantine = (self.quarantined > 0).then_some(Violation::Quarantine);
        let substeps = (self.excess > 0).then_some(Violation::Substeps(self.excess));
        [gain, depth, quarantine, substeps].into_iter().flatten()
    }
}

/// Scene of two to six blocks in any orientation above each other, thrown down and spinning.
pub fn random_scene(random: &mut Random, range: Range) -> Scene {
    let wide = range == Range::Wide;
    let mut between = |low: f64, high: f64| low + (high - low) * random.uniform();
    let mut power = |low: f64, high: f64| libm::exp(between(libm::log(low), libm::log(high)));
    let (base, stiffness) =
        if wide { (power(0.02, 0.5), power(1e5, 1e7)) } else { (power(0.01, 0.1), power(3e5, 3e6)) };
    let density = if wide { power(100.0, 8000.0) } else { power(300.0, 900.0) };
    let (max_speed, spins) = if wide { (power(0.3, 8.0), power(1.0, 60.0)) } else { (1.5, 20.0) };
    let (friction, restitution) = (between(0.0, 1.0), between(0.0, if wide { 0.96 } else { 0.9 }));
    let radius = if between(0.0, 1.0) < 0.5 { between(0.0, 0.3) } else { 0.0 };
    let lattice = between(0.0, 1.0) < 0.3;
    let count = between(2.0, 7.0) as u32;
    let mut height = between(0.0, 2.0 * base);
    let mut blocks: Vec<Block> = Vec::new();
    for id in 0..count {
        let size = [(); 3].map(|()| base * between(0.2, 1.0));
        let orientation = loop {
            let q = DQuat::from_array([(); 4].map(|()| between(-1.0, 1.0)));
            if (0.1..=1.0).contains(&q.length()) {
                break q.normalize();
            }
        };
        let reach = 0.51 * DVec3::from_array(size).length();
        let unit = [(); 3].map(|()| between(-1.0, 1.0));
        height += 2.0 * reach;
        let mass = density * between(if wide { 0.3 } else { 1.0 }, 1.0) * size[0] * size[1] * size[2];
        let position = [0.3 * base * unit[0], 0.3 * base * unit[1], height - reach];
        let block = Block::new(id, size, mass, position);
        blocks.push(Block {
            orientation: Some(orientation.to_array()),
            velocity: [max_speed * between(-1.0, 1.0), max_speed * between(-1.0, 1.0), -max_speed * between(0.0, 1.0)],
            spin: [(); 3].map(|()| spins * between(-1.0, 1.0)),
            ..block
        });
    }
    let smallest = blocks.iter().map(Block::smallest_edge).fold(f64::INFINITY, f64::min);
    Scene {
        name: "random".into(),
        gravity: 9.81,
        friction,
        kinetic_friction: None,
        restitution,
        stiffness,
        edge_radius: radius * smallest,
        form: if lattice { Form::Lattice } else { Form::Rigid },
        springs: Springs::default(),
        blocks,
        label: None,
        margin: None,
        tilt_az: None,
    }
}

/// Simulates the random scene of the seed that bytes stand for.
pub fn run(bytes: &[u8]) {
    let seed = bytes.iter().fold(0u64, |seed, &byte| seed.rotate_left(8) ^ u64::from(byte));
    let range = if seed & 1 == 0 { Range::Plausible } else { Range::Wide };
    let scene = random_scene(&mut Random::new(seed), range);
    let violations: Vec<String> =
        Extremes::of(&scene, TARGET_TIME).violations().map(|violation| violation.to_string()).collect();
    assert!(violations.is_empty(), "seed {seed}, {range:?}: {}", violations.join(", "));
}

/// Some seeds.
pub fn seeds() -> Vec<Vec<u8>> {
    (0..8u8).map(|seed| vec![seed]).collect()
}
