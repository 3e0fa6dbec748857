//! `teeter run`: one scene, simulated and measured.

use cpu_time::ProcessTime;
use serde::Serialize;
use teeter_physics::{Input, World};
use teeter_scene::Scene;
use teeter_study::{ReferencePositions, max_height};

use crate::args::Run;
use crate::fault::{self, Fault};
use crate::{input, output};

/// When creep begins to count, s: what comes before is the tower settling.
const CREEP_FROM: f64 = 2.0;

/// What a run showed.
#[derive(Debug, Serialize)]
struct Report {
    /// No block fell.
    stands: bool,
    /// Ids of the blocks that fell.
    fell: Vec<u32>,
    /// Furthest that any block was from its start at any time.
    max_displacement_mm: f64,
    /// Furthest that any block was from its place at 2 s at any time after; null in shorter runs.
    creep_mm: Option<f64>,
    /// How far the top is below where the sum of the tallest blocks puts it.
    sink_mm: f64,
    /// Deepest overlap at the end of any frame.
    penetration_mm: f64,
    /// Over all blocks at the end, m/s.
    rms_speed: f64,
    /// Time of the processor that the steps took, s.
    cpu_s: f64,
    /// Time that passed in the world, s.
    simulated_s: f64,
    /// Hash of the whole state at the end.
    hash: String,
    /// Since when all blocks have slept, s; null where one is awake at the end.
    asleep_at_s: Option<f64>,
}

/// Simulates a scene and prints what it showed.
pub fn main(args: Run) -> Result<(), Fault> {
    let scene = args.engine.material.applied(input::scene(&args.scene)?);
    let mut world = World::new(&scene, args.engine.params(!args.no_sleep)).map_err(|e| Fault::at(&scene.name, e))?;
    let report = simulate(&scene, &mut world, args.seconds);
    if args.json { output::line(&output::json(&report)) } else { print(&scene, &report) }
}

fn simulate(scene: &Scene, world: &mut World, seconds: f64) -> Report {
    let frames = (seconds / world.params().frame).round().max(1.0) as u64;
    let bar = output::progress(frames, "frames");
    let input = Input::default();
    let start = ReferencePositions::of(world);
    // A scene begins without load, so its top is the sum of the tallest blocks.
    let top = max_height(world);
    let mut settled: Option<ReferencePositions> = None;
    let mut creep: Option<f64> = None;
    let mut fallen = vec![false; world.len()];
    let (mut furthest, mut penetration, mut rms_speed): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let mut asleep_at_s = None;
    let clock = ProcessTime::now();
    for _ in 0..frames {
        let step = world.step(&input);
        for &body in &step.quarantined {
            fallen[body.index()] = true;
            let id = scene.blocks[body.index()].id;
            bar.suspend(|| fault::warn(&format!("block {id} ran away at {:.2} s and was frozen there", step.time)));
        }
        start.mark_fallen(world, &mut fallen);
        furthest = furthest.max(start.max_displacement(world));
        penetration = penetration.max(step.penetration);
        rms_speed = step.rms_speed;
        asleep_at_s = if step.awake == 0 { asleep_at_s.or(Some(step.time)) } else { None };
        match &settled {
            Some(places) => creep = Some(creep.unwrap_or(0.0).max(places.max_displacement(world))),
            None if step.time >= CREEP_FROM - 1e-9 => settled = Some(ReferencePositions::of(world)),
            None => {}
        }
        bar.inc(1);
    }
    let cpu_s = clock.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let fell: Vec<u32> = scene.blocks.iter().zip(&fallen).filter(|(_, fell)| **fell).map(|(b, _)| b.id).collect();
    Report {
        stands: fell.is_empty(),
        fell,
        max_displacement_mm: 1e3 * furthest,
        creep_mm: creep.map(|m| 1e3 * m),
        sink_mm: 1e3 * (top - max_height(world)),
        penetration_mm: 1e3 * penetration,
        rms_speed,
        cpu_s,
        simulated_s: world.time(),
        hash: format!("{:016x}", world.hash()),
        asleep_at_s,
    }
}

fn print(scene: &Scene, r: &Report) -> Result<(), Fault> {
    let count = scene.blocks.len();
    let verdict = match r.fell.as_slice() {
        [] => "stands".to_owned(),
        [id] => format!("block {id} fell"),
        ids if ids.len() == count => format!("all {count} blocks fell"),
        ids => {
            let some: Vec<String> = ids.iter().take(10).map(u32::to_string).collect();
            format!(
                "{} of {count} blocks fell: {}{}",
                ids.len(),
                some.join(", "),
                if ids.len() > 10 { ", ..." } else { "" }
            )
        }
    };
    let weight: f64 = scene.blocks.iter().map(|b| b.mass * scene.gravity).sum();
    output::line(&format!("{}: {verdict}", scene.name))?;
    let row = |name: &str, value: String| output::line(&format!("  {name:22} {value}"));
    row("blocks", format!("{count}, {weight:.2} N in all"))?;
    row("largest displacement", millimetres(r.max_displacement_mm))?;
    row("creep after 2 s", r.creep_mm.map_or("not seen: the run ends before".into(), millimetres))?;
    row("sink of the top", millimetres(r.sink_mm))?;
    row("deepest overlap", millimetres(r.penetration_mm))?;
    row("speed at the end", format!("{}/s (root mean square)", millimetres(1e3 * r.rms_speed)))?;
    row("asleep", r.asleep_at_s.map_or("not all blocks".into(), |t| format!("since {t:.2} s")))?;
    row("time", format!("{:.2} s simulated in {:.2} s of the processor", r.simulated_s, r.cpu_s))?;
    row("hash", r.hash.clone())
}

/// A length for reading: figures after the point for what is seen, powers of ten for what is not.
fn millimetres(mm: f64) -> String {
    if mm == 0.0 || mm.abs() >= 0.01 { format!("{mm:.3} mm") } else { format!("{mm:.1e} mm") }
}
