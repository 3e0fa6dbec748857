//! Measurements while the simulator of 2003 runs.

use glam::DVec3;
use teeter_dissertation::jenga3d::counters::Rounds;
use teeter_dissertation::jenga3d::{FrameReport, Jenga3D};
use teeter_scene::Scene;
use teeter_study::{Cuboid, Footing, scene_height};

use super::summary::Summary;
use crate::warnings::Warnings;

/// Time after the rows have met from which on displacements count, s: before, the tower settles.
const SETTLING: f64 = 0.5;
/// Time from which on creep counts, s.
const CREEP_FROM: f64 = 2.0;

/// Measurements while the simulator runs.
pub struct Measurements {
    footing: Footing,
    fallen: Vec<bool>,
    /// Positions of the scene, m.
    start: Vec<DVec3>,
    /// Time from which on displacements count, s.
    settled_at: f64,
    displacement: Option<f64>,
    /// Positions from which creep counts, m.
    settled: Option<Vec<DVec3>>,
    creep: Option<f64>,
    rounds: Rounds,
    collisions: u64,
    frames: u64,
    /// Sum over the frames of the number of disabled blocks.
    disabled: u64,
}

impl Measurements {
    /// Starts the measurements of a simulator that was built from `scene`.
    pub fn new(scene: &Scene, jenga: &Jenga3D) -> Self {
        let start: Vec<DVec3> = scene.blocks.iter().map(|block| block.pos.into()).collect();
        let lift = start.iter().zip(jenga.centres()).map(|(start, now)| now.z - start.z).fold(0.0, f64::max);
        let gravity = jenga.constants.gravity;
        let fall = if gravity > 0.0 { (2.0 * lift / gravity).sqrt() } else { 0.0 };
        Self {
            footing: Footing::of_scene(scene),
            fallen: vec![false; start.len()],
            start,
            settled_at: fall + SETTLING,
            displacement: None,
            settled: None,
            creep: None,
            rounds: Rounds::default(),
            collisions: 0,
            frames: 0,
            disabled: 0,
        }
    }

    /// Records a frame.
    pub fn record(&mut self, jenga: &Jenga3D, report: &FrameReport) {
        self.frames += 1;
        self.rounds += report.rounds;
        self.collisions += report.tests.collisions;
        self.disabled += disabled(jenga);
        self.footing.mark_fallen(&cuboids(jenga), |_| false, &mut self.fallen);
        let centres = jenga.centres();
        if jenga.time >= self.settled_at {
            self.displacement = Some(self.displacement.unwrap_or(0.0).max(max_distance(&self.start, &centres)));
        }
        match &self.settled {
            Some(settled) => self.creep = Some(self.creep.unwrap_or(0.0).max(max_distance(settled, &centres))),
            None if jenga.time >= CREEP_FROM - 1e-9 => self.settled = Some(centres),
            None => {}
        }
    }

    /// Counts a block as fallen whose position is lost.
    pub fn end(&mut self, block: usize) {
        self.fallen[block] = true;
    }

    /// Returns the summary at the end of a run, which took `cpu_s` of the processor.
    pub fn summary(&self, scene: &Scene, jenga: &Jenga3D, cpu_s: f64, warnings: Warnings) -> Summary {
        let blocks = scene.blocks.iter().zip(&self.fallen);
        let fell: Vec<u32> = blocks.filter(|(_, fell)| **fell).map(|(block, _)| block.id).collect();
        let displacement = self.displacement.unwrap_or_else(|| max_distance(&self.start, &jenga.centres()));
        let frames = self.frames.max(1) as f64;
        Summary {
            stands: fell.is_empty(),
            fell,
            rows: rows(scene),
            blocks: scene.blocks.len(),
            max_displacement_mm: 1e3 * displacement,
            creep_mm: self.creep.map(|creep| 1e3 * creep),
            sink_mm: 1e3 * (scene_height(scene) - jenga.top()),
            simulated_s: jenga.time,
            frames: self.frames,
            cpu_s,
            frames_per_s: self.frames as f64 / cpu_s,
            collisions_per_frame: self.collisions as f64 / frames,
            mean_rounds: self.rounds.mean(),
            max_rounds: self.rounds.max,
            calls: self.rounds.calls,
            unresolved_calls: self.rounds.unresolved,
            unresolved_steps: self.rounds.unresolved_steps,
            unresolved_frames: self.rounds.unresolved_frames,
            calls_by_rounds: self.rounds.calls_by_rounds,
            disabled: disabled(jenga),
            mean_disabled: self.disabled as f64 / frames,
            hash: format!("{:016x}", jenga.hash()),
            warnings,
        }
    }
}

/// Number of disabled blocks.
fn disabled(jenga: &Jenga3D) -> u64 {
    jenga.model.blocks.iter().filter(|block| !block.active).count() as u64
}

fn max_distance(from: &[DVec3], to: &[DVec3]) -> f64 {
    from.iter().zip(to).map(|(from, to)| from.distance(*to)).fold(0.0, f64::max)
}

fn cuboids(jenga: &Jenga3D) -> Vec<Cuboid> {
    let points = |first: usize| std::array::from_fn(|corner| jenga.curr[first + corner].position);
    jenga.model.blocks.iter().map(|block| Cuboid::from_points(&points(block.corners().start), 1.0)).collect()
}

/// Number of rows of a scene: of heights of blocks, where half a block separates two rows.
fn rows(scene: &Scene) -> usize {
    let height = scene.blocks.iter().map(|block| block.size[2]).fold(f64::INFINITY, f64::min);
    let mut heights: Vec<f64> = scene.blocks.iter().map(|block| block.pos[2]).collect();
    heights.sort_by(f64::total_cmp);
    heights.chunk_by(|a, b| b - a < 0.5 * height).count()
}
