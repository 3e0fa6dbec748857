//! `teeter run`: simulates a scene and measures it.

mod report;

use std::path::PathBuf;

use clap::Args;
use cpu_time::ProcessTime;
use teeter_physics::{Input, StepReport, World};
use teeter_report::progress;
use teeter_scene::Scene;
use teeter_study::{ReferencePositions, max_height};

use crate::arguments::{EngineArguments, number};
use crate::error::Error;
use crate::{input, output};
use report::Report;

/// Time from which on creep counts, s: before, the tower settles.
const CREEP_FROM: f64 = 2.0;

/// Arguments of `teeter run`.
#[derive(Debug, Args)]
pub struct Run {
    /// File of a scene, `-` for standard input, or the name of a scene of the list.
    scene: PathBuf,
    /// Time to simulate, s.
    #[arg(long, default_value_t = 10.0, value_parser = number(0.02, 86_400.0))]
    seconds: f64,
    #[command(flatten)]
    engine: EngineArguments,
    /// Simulate every block in every frame: slower, and shows that rest does not depend on sleep.
    #[arg(long)]
    no_sleep: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Simulates the scene and prints its report.
    pub fn run(self) -> Result<(), Error> {
        let scene = self.engine.material.apply(input::scene(&self.scene)?);
        let world = World::new(&scene, self.engine.params(!self.no_sleep))
            .map_err(|source| Error::Build { name: scene.name.clone(), source })?;
        let report = simulate(&scene, world, self.seconds);
        if self.json { output::json(&report) } else { report.print(&scene) }
    }
}

/// Measurements while a world runs.
struct Recorder {
    /// Height of the top before the first frame, m. A scene begins without load, so this is the sum
    /// of the tallest blocks.
    top: f64,
    start: ReferencePositions,
    /// Positions from which creep counts.
    settled: Option<ReferencePositions>,
    fallen: Vec<bool>,
    displacement: f64,
    creep: Option<f64>,
    penetration: f64,
    rms_speed: f64,
    asleep_at_s: Option<f64>,
}

impl Recorder {
    fn new(world: &World) -> Self {
        Self {
            top: max_height(world),
            start: ReferencePositions::of(world),
            settled: None,
            fallen: vec![false; world.len()],
            displacement: 0.0,
            creep: None,
            penetration: 0.0,
            rms_speed: 0.0,
            asleep_at_s: None,
        }
    }

    fn record(&mut self, world: &World, step: &StepReport) {
        for body in &step.quarantined {
            self.fallen[body.index()] = true;
        }
        self.start.mark_fallen(world, &mut self.fallen);
        self.displacement = self.displacement.max(self.start.max_displacement(world));
        self.penetration = self.penetration.max(step.penetration);
        self.rms_speed = step.rms_speed;
        self.asleep_at_s = if step.awake == 0 { self.asleep_at_s.or(Some(step.time)) } else { None };
        match &self.settled {
            Some(settled) => self.creep = Some(self.creep.unwrap_or(0.0).max(settled.max_displacement(world))),
            None if step.time >= CREEP_FROM - 1e-9 => self.settled = Some(ReferencePositions::of(world)),
            None => {}
        }
    }

    fn report(&self, scene: &Scene, world: &World, cpu_s: f64) -> Report {
        let blocks = scene.blocks.iter().zip(&self.fallen);
        let fell: Vec<u32> = blocks.filter(|(_, fell)| **fell).map(|(block, _)| block.id).collect();
        Report {
            stands: fell.is_empty(),
            fell,
            max_displacement_mm: 1e3 * self.displacement,
            creep_mm: self.creep.map(|creep| 1e3 * creep),
            sink_mm: 1e3 * (self.top - max_height(world)),
            penetration_mm: 1e3 * self.penetration,
            rms_speed: self.rms_speed,
            cpu_s,
            simulated_s: world.time(),
            hash: format!("{:016x}", world.hash()),
            asleep_at_s: self.asleep_at_s,
        }
    }
}

fn simulate(scene: &Scene, mut world: World, seconds: f64) -> Report {
    let frames = (seconds / world.params().frame).round().max(1.0) as u64;
    let bar = progress(frames, "frames");
    let mut recorder = Recorder::new(&world);
    let clock = ProcessTime::now();
    for _ in 0..frames {
        let step = world.step(&Input::default());
        for body in &step.quarantined {
            let (id, time) = (scene.blocks[body.index()].id, step.time);
            bar.suspend(|| output::warn(&format!("block {id} ran away at {time:.2} s and was frozen there")));
        }
        recorder.record(&world, &step);
        bar.inc(1);
    }
    let cpu_s = clock.elapsed().as_secs_f64();
    bar.finish_and_clear();
    recorder.report(scene, &world, cpu_s)
}
