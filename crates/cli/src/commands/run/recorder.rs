//! Measurements while a world runs.

use teeter_game::{Blocks, FallDetector, FrameEnd};
use teeter_physics::{BodyId, EnergyBalance, StepReport, World};
use teeter_scene::{Block, Penetration, Scene};
use teeter_study::{Footing, ReferencePositions, max_height, scene_height};

use super::report::{EnergyReport, Report};
use crate::warnings::Warnings;

/// Time from which on creep counts, s: before, the tower settles.
const CREEP_FROM: f64 = 2.0;
/// Gain of a frame over the energy available from which a run is doubtful.
const MAX_GAIN: f64 = 1e-3;

/// Penetration over the smallest edge of the two blocks from which a run is doubtful.
const MAX_PENETRATION: f64 = 0.5;

/// Deepest penetration at the end of a frame.
struct Deepest {
    time: f64,
    penetration: Penetration,
}

/// Measurements while a world runs.
pub struct Recorder {
    /// Height of the top without load, m: the sum of the tallest blocks of a tower.
    top: f64,
    start: ReferencePositions,
    blocks: Blocks,
    falls: FallDetector,
    /// Blocks whose state ran away.
    lost: Vec<BodyId>,
    /// Positions from which creep counts.
    settled: Option<ReferencePositions>,
    displacement: f64,
    creep: Option<f64>,
    penetration: f64,
    /// Smallest edge of all blocks, m.
    smallest_edge: f64,
    /// Deepest penetration of those above [`MAX_PENETRATION`].
    deepest: Option<Deepest>,
    rms_speed: f64,
    asleep_at_s: Option<f64>,
    energy: EnergyBalance,
}

impl Recorder {
    /// Starts the measurements of a world, which was built from `scene`.
    pub fn new(scene: &Scene, world: &World) -> Self {
        Self {
            top: scene_height(scene),
            start: ReferencePositions::of(world),
            blocks: Blocks::of(world),
            falls: FallDetector::with_footing(Footing::of_scene(scene)),
            lost: Vec::new(),
            settled: None,
            displacement: 0.0,
            creep: None,
            penetration: 0.0,
            smallest_edge: scene.blocks.iter().map(Block::smallest_edge).fold(f64::INFINITY, f64::min),
            deepest: None,
            rms_speed: 0.0,
            asleep_at_s: None,
            energy: EnergyBalance::new(world),
        }
    }

    /// Records a step of the world with a body in the hand.
    pub fn record(&mut self, world: &World, step: &StepReport, held: Option<BodyId>) {
        self.lost.extend(&step.quarantined);
        self.blocks.refresh(world);
        self.falls.observe(&self.blocks, FrameEnd { time: step.time, max_speed: step.rms_speed, held });
        self.displacement = self.displacement.max(self.start.max_displacement(world));
        self.penetration = self.penetration.max(step.penetration);
        self.record_deepest(world, step);
        self.rms_speed = step.rms_speed;
        self.energy.record(world, step);
        self.asleep_at_s = if step.awake == 0 { self.asleep_at_s.or(Some(step.time)) } else { None };
        match &self.settled {
            Some(settled) => self.creep = Some(self.creep.unwrap_or(0.0).max(settled.max_displacement(world))),
            None if step.time >= CREEP_FROM - 1e-9 => self.settled = Some(ReferencePositions::of(world)),
            None => {}
        }
    }

    fn record_deepest(&mut self, world: &World, step: &StepReport) {
        let share = self.deepest.as_ref().map_or(MAX_PENETRATION, |deepest| deepest.penetration.share);
        if step.penetration <= share * self.smallest_edge {
            return;
        }
        if let Some(penetration) = Penetration::deepest(&world.to_scene(), share) {
            self.deepest = Some(Deepest { time: step.time, penetration });
        }
    }

    /// Returns a warning about a block that was pressed into another one or the floor by more than
    /// half of an edge, as impacts do to soft contacts.
    pub fn depth_warning(&self, scene: &Scene) -> Option<String> {
        let Deepest { time, penetration } = self.deepest.as_ref()?;
        let id = |i: usize| scene.blocks[i].id;
        let other = penetration.other.map_or("the floor".into(), |other| format!("block {}", id(other)));
        Some(format!(
            "at {time:.2} s block {} was {:.1} mm deep in {other}, {:.0} % of an edge: results are doubtful, and a \
             larger `stiffness` gives a smaller depth",
            id(penetration.block),
            1e3 * penetration.depth(),
            1e2 * penetration.share,
        ))
    }

    /// Returns a warning about a frame that gained energy.
    pub fn energy_warning(&self) -> Option<String> {
        let share = self.energy.worst_share();
        let gain = self.energy.worst_gain();
        (share > MAX_GAIN).then(|| {
            format!(
                "a frame gained {gain:.1e} J that nobody put in, up to {share:.1e} of the energy: results are doubtful"
            )
        })
    }

    /// Returns the report at the end of a run.
    pub fn report(&self, scene: &Scene, world: &World, cpu_s: f64, warnings: Warnings) -> Report {
        let mut fallen = vec![false; world.len()];
        self.falls.fallen().iter().chain(&self.lost).for_each(|body| fallen[body.index()] = true);
        let blocks = scene.blocks.iter().zip(fallen);
        let fell: Vec<u32> = blocks.filter(|(_, fell)| *fell).map(|(block, _)| block.id).collect();
        Report {
            stands: fell.is_empty(),
            fell,
            max_displacement_mm: 1e3 * self.displacement,
            creep_mm: self.creep.map(|creep| 1e3 * creep),
            sink_mm: 1e3 * (self.top - max_height(world)),
            penetration_mm: 1e3 * self.penetration,
            rms_speed: self.rms_speed,
            energy: EnergyReport {
                put_in: self.energy.put_in(),
                lost: self.energy.lost(),
                worst_gain: self.energy.worst_gain(),
            },
            cpu_s,
            simulated_s: world.time(),
            hash: format!("{:016x}", world.hash()),
            asleep_at_s: self.asleep_at_s,
            warnings,
        }
    }
}
