//! Measurements: rest and cost of the tower, the column, and the breakaway force of blocks.

use glam::{DMat3, DQuat, DVec3};
use teeter_scene::Scene;
use teeter_study::{LimitError, RigidTower, long_axis};

use crate::clock::thread_seconds;
use crate::engine::{Engine, FRAME, Pull};
use crate::entries::Entry;
use crate::report::{Result, Slid};

/// Time of settling before a measurement, s.
pub const SETTLE: f64 = 2.0;
/// Displacement of a block that has started to slide, m.
pub const SLID: f64 = 0.5e-3;
/// Rate of the force on a block, N/s. While the block moves by the first 0.5 mm the force grows by
/// about 0.015 N.
pub const RAMP: f64 = 0.25;
/// Maximum force of a pull, N.
pub const MAX_FORCE: f64 = 12.0;
/// Maximum displacement of the blocks of a standing tower, m.
const MAX_DISPLACEMENT: f64 = 5e-3;

/// Block to pull, with its exact breakaway forces.
pub struct Target {
    block: usize,
    turning: f64,
    straight: f64,
}

impl Target {
    /// Computes the exact forces of a block.
    pub fn new(block: usize, rigid: &RigidTower) -> std::result::Result<Self, LimitError> {
        let answer = rigid.breakaway(block)?;
        Ok(Self { block, turning: answer.turning_n, straight: answer.straight_n })
    }
}

/// Running engine with its measurements.
struct Running<'a> {
    entry: &'a Entry,
    engine: Box<dyn Engine>,
    settled: Vec<DVec3>,
    creep: f64,
    costs: Vec<f64>,
}

/// Runs the tower in all engines for `seconds`, in turn and a second at a time, so that the load of
/// the machine affects all alike. The top is compared with `rigid_top`, m.
pub fn rest_and_cost(entries: &[Entry], scene: &Scene, seconds: usize, rigid_top: f64) -> Vec<Result> {
    let mut all: Vec<Running> = entries
        .iter()
        .map(|entry| {
            let mut engine = entry.start(scene);
            run(engine.as_mut(), SETTLE);
            let settled = centers(engine.as_ref(), scene);
            Running { entry, engine, settled, creep: 0.0, costs: Vec::new() }
        })
        .collect();
    let (rounds, engines) = (seconds - SETTLE as usize, all.len());
    for round in 0..rounds {
        for turn in 0..engines {
            let it = &mut all[(round + turn) % engines];
            let start = thread_seconds();
            run(it.engine.as_mut(), 1.0);
            it.costs.push(1e3 * (thread_seconds() - start));
            let moved =
                centers(it.engine.as_ref(), scene).into_iter().zip(&it.settled).map(|(now, then)| now.distance(*then));
            it.creep = moved.fold(it.creep, f64::max);
        }
        eprintln!("second {} of {rounds} timed", round + 1);
    }
    all.into_iter()
        .map(|it| {
            let sideways = scene.blocks.iter().enumerate().map(|(i, block)| {
                let moved = it.engine.pose(i).0 - DVec3::from(block.pos);
                moved.truncate().length()
            });
            Result {
                engine: it.entry.engine.into(),
                setting: it.entry.setting.into(),
                details: it.entry.details.clone(),
                stands: it.creep < MAX_DISPLACEMENT && sideways.fold(0.0, f64::max) < MAX_DISPLACEMENT,
                creep_mm: 1e3 * it.creep,
                sink_mm: 1e3 * (rigid_top - top(it.engine.as_ref(), scene)),
                cpu_ms_per_s: median(&it.costs),
                cpu_ms_stretches: it.costs,
                push_over_coulomb: 0.0,
                reproducible: true,
                pulls: Vec::new(),
            }
        })
        .collect()
}

/// Returns the force, over Coulomb's limit, at which the fourth block of a column of ten slips with
/// the six above it.
///
/// The force is bisected, each time on a new column; it grows over 2 s and stays for 1 s.
pub fn column_push(entry: &Entry, column: &Scene) -> f64 {
    let limit = 7.0 * column.friction * column.blocks[0].mass * column.gravity;
    let slips = |share: f64| {
        let mut engine = entry.start(column);
        run(engine.as_mut(), 1.0);
        let start = engine.pose(3).0;
        (1..=180).any(|i| {
            let force = |i: i32| DVec3::X * (share * limit * f64::from(i.min(120)) / 120.0);
            engine.frame(Some(Pull { body: 3, from: force(i - 1), to: force(i) }));
            (engine.pose(3).0 - start).x > SLID
        })
    };
    let (mut holds, mut moves) = (0.0, 1.28);
    if !slips(moves) {
        return f64::NAN;
    }
    while moves - holds > 0.003 {
        let share = 0.5 * (holds + moves);
        if slips(share) { moves = share } else { holds = share }
    }
    0.5 * (holds + moves)
}

/// Pulls each block out of the same settled tower along its long axis, with a slowly growing force.
/// Returns true if the tower had the same bits each time.
pub fn pulls(entry: &Entry, scene: &Scene, blocks: &[Target]) -> (Vec<Slid>, bool) {
    let mut first: Option<Vec<DVec3>> = None;
    let mut same = true;
    let slid = blocks.iter().map(|target| {
        let body = target.block;
        let mut engine = entry.start(scene);
        run(engine.as_mut(), SETTLE);
        let settled = centers(engine.as_ref(), scene);
        same &= first.get_or_insert_with(|| settled.clone()) == &settled;
        let force_n = pull(engine.as_mut(), body, long_axis(&scene.blocks[body]).extend(0.0));
        Slid { block: body, turning_n: target.turning, straight_n: target.straight, force_n }
    });
    (slid.collect(), same)
}

/// Returns the force at which a block has moved by [`SLID`], N.
fn pull(engine: &mut dyn Engine, body: usize, axis: DVec3) -> f64 {
    let start = engine.pose(body).0;
    let (mut force, mut moved) = (0.0, 0.0);
    while force < MAX_FORCE {
        let next = force + RAMP * FRAME;
        engine.frame(Some(Pull { body, from: axis * force, to: axis * next }));
        let now = (engine.pose(body).0 - start).dot(axis);
        if now >= SLID {
            return force + (next - force) * (SLID - moved) / (now - moved);
        }
        (force, moved) = (next, now);
    }
    MAX_FORCE
}

fn run(engine: &mut dyn Engine, seconds: f64) {
    (0..(seconds / FRAME).round() as usize).for_each(|_| engine.frame(None));
}

fn centers(engine: &dyn Engine, scene: &Scene) -> Vec<DVec3> {
    (0..scene.blocks.len()).map(|i| engine.pose(i).0).collect()
}

/// Height of the highest corner, m.
fn top(engine: &dyn Engine, scene: &Scene) -> f64 {
    let corner = |(i, block): (usize, &teeter_scene::Block)| {
        let (center, turn): (DVec3, DQuat) = engine.pose(i);
        let up = DMat3::from_quat(turn).row(2).abs();
        center.z + 0.5 * up.dot(DVec3::from(block.size))
    };
    scene.blocks.iter().enumerate().map(corner).fold(0.0, f64::max)
}

/// Returns the median of some numbers.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    if n % 2 == 1 { sorted[n / 2] } else { 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]) }
}
