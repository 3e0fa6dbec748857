//! Rotation of a tower above a tight block that is pulled beside its middle.

use serde_json::json;
use teeter_physics::{BodyId, Params, Precision, World};
use teeter_scene::Scene;
use teeter_study::{Drag, RigidTower, Spread, drag_rotation, long_axis, mechanism, par_map, settled};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{correlation, mean, percent};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Distance by which a block is pulled, m.
const PULL: f64 = 2e-3;
/// Speed at which a block is pulled, m/s.
const SPEED: f64 = 5e-3;
/// Maximum breakaway force of a block whose tower turns, over that of sliding straight.
const TURNS: f64 = 0.9;
/// Rotation below which the direction does not count, mrad/mm.
const NO_ROTATION: f64 = 3.0;

/// Rotations of the row above a block, mrad/mm, and the forces of the three models of rigid blocks,
/// N.
struct Measurement {
    block: String,
    /// Engine at 1e6 N/m, and in double precision at 1e7 N/m.
    engine: [f64; 2],
    /// Friction at the lever of each patch, at its corners, and on a mesh.
    rigid: [f64; 3],
    force_n: [f64; 3],
}

impl Measurement {
    fn values(&self) -> [f64; 5] {
        [self.engine[0], self.engine[1], self.rigid[0], self.rigid[1], self.rigid[2]]
    }
}

/// Settled tower, in single precision and in double precision on stiff contacts, and its rigid
/// twin.
struct Tower<'a> {
    scene: &'a Scene,
    worlds: [World; 2],
    rigid: RigidTower<'a>,
    /// Cells of a mesh along each side of a patch.
    cells: usize,
}

impl<'a> Tower<'a> {
    fn new(scene: &'a Scene, quick: bool) -> Result<Self, Error> {
        let stiff = Scene { stiffness: if quick { 1e6 } else { 1e7 }, ..scene.clone() };
        let double = Params { precision: Precision::Double, ..params() };
        let worlds = [settled(scene, params())?, settled(&stiff, double)?];
        Ok(Self { scene, worlds, rigid: RigidTower::new(scene)?, cells: if quick { 4 } else { 12 } })
    }

    /// Blocks below the two top rows whose tower turns when they are pulled.
    fn turning_blocks(&self) -> Vec<usize> {
        let blocks: Vec<usize> = (0..self.scene.blocks.len() - 6).collect();
        let turns = par_map(&blocks, |&i| {
            let answer = self.rigid.breakaway(i).ok()?;
            (answer.turning_n < TURNS * answer.straight_n && !answer.rocks()).then_some(i)
        });
        turns.into_iter().flatten().collect()
    }

    /// Pulls block `i`; none where a model of rigid blocks has no solution.
    fn measure(&self, i: usize) -> Option<Measurement> {
        let axis = long_axis(&self.scene.blocks[i]).extend(0.0);
        let row = 3 * (i / 3 + 1);
        let above: Vec<BodyId> = (row as u32..).take(3).map(BodyId).collect();
        let drag = Drag { axis, distance: PULL, speed: SPEED };
        let engine = self.worlds.each_ref().map(|world| drag_rotation(world, BodyId(i as u32), &above, &drag));
        let [lever, corners, mesh] = [Spread::ScaledCorners, Spread::Corners, Spread::Mesh(self.cells)]
            .map(|spread| mechanism(&self.rigid, i, spread));
        let models = [lever?, corners?, mesh?];
        Some(Measurement {
            block: format!("{} {i}", self.scene.name),
            engine,
            rigid: models.each_ref().map(|m| (row..row + 3).map(|j| m.velocities[j].z).sum::<f64>() / 3.0),
            force_n: models.each_ref().map(|m| m.force_n),
        })
    }
}

/// Measures the rotation above tight blocks.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "turning",
        "Rotation of a tower above a tight block",
        "A tight block beside the middle is drawn 2 mm at 5 mm/s by a hand that leaves it free to \
         turn; the figure is the rotation of the row above for each millimetre. Rigid blocks move \
         so that, of all motions with the normal forces of rest, friction takes the least power, \
         with friction on the engine's lever, at the corners of each patch, and on a mesh of 12 x \
         12 points under a pressure that varies evenly (which has the torsion of theory by \
         itself). The engine runs in single precision at 1e6 N/m and in double at 1e7.",
    );
    let scenes = size.towers(size.share(5), 1e6, &size.tower_options());
    let mut all: Vec<Measurement> = Vec::new();
    for scene in &scenes {
        let tower = Tower::new(scene, size.quick)?;
        let mut blocks = tower.turning_blocks();
        blocks.truncate(if size.quick { 2 } else { usize::MAX });
        let bar = progress(blocks.len() as u64, "blocks");
        let measured = par_map(&blocks, |&i| {
            let measured = tower.measure(i);
            bar.inc(1);
            measured
        });
        bar.finish_and_clear();
        all.extend(measured.into_iter().flatten());
    }
    figures(&mut section, &all);
    let row = |m: &Measurement| {
        let cells = m.values().map(|rotation| format!("{rotation:+.1}"));
        [&[m.block.clone()][..], &cells].concat()
    };
    let head = ["block", "engine 1e6", "engine 1e7 f64", "lever", "corners", "mesh"];
    section.table(&head, all.iter().map(row).collect());
    section.charts.push(chart(&all));
    let rotations: Vec<[f64; 5]> = all.iter().map(Measurement::values).collect();
    let forces: Vec<[f64; 3]> = all.iter().map(|m| m.force_n).collect();
    section.data = json!({"mrad_per_mm": rotations, "force_n": forces});
    Ok(section)
}

/// Pairs (reference, value) of two of the five rotations.
fn pairs(all: &[Measurement], value: usize, reference: usize) -> Vec<(f64, f64)> {
    all.iter().map(|m| (m.values()[reference], m.values()[value])).collect()
}

fn figures(section: &mut Section, all: &[Measurement]) {
    let size = mean(&all.iter().map(|m| m.rigid[2].abs()).collect::<Vec<_>>());
    section.inform("blocks, and mean rotation of the row above on a mesh", format!("{}, {size:.1} mrad/mm", all.len()));
    for (what, value, reference) in [
        ("engine at 1e6 against mesh: correlation, mean difference", 0, 4),
        ("engine at 1e7 in double against mesh", 1, 4),
        ("engine at 1e6 against that at 1e7", 0, 1),
        ("lever of the patch at four corners against mesh", 2, 4),
        ("friction at the corners themselves against mesh", 3, 4),
    ] {
        let pairs = pairs(all, value, reference);
        let difference = mean(&pairs.iter().map(|(a, b)| (a - b).abs()).collect::<Vec<_>>());
        section.inform(what, format!("{:.3}, {difference:.1} mrad/mm", correlation(&pairs)));
    }
    let error = |model: usize| {
        100.0 * mean(&all.iter().map(|m| (m.force_n[model] / m.force_n[2] - 1.0).abs()).collect::<Vec<_>>())
    };
    section.inform("force against mesh: lever, corners", format!("{:.1} %, {:.1} % off", error(0), error(1)));
    let same = percent(all, |m| m.engine[0] * m.rigid[2] > 0.0 || m.rigid[2].abs() < NO_ROTATION);
    section.number("blocks", all.len() as f64);
    section.number("same_direction_percent", same);
    let what = "the row above turns in the direction that rigid blocks give";
    section.goal(what, format!("{same:.0} %"), "95 %", same >= 95.0);
}

fn chart(all: &[Measurement]) -> Chart {
    Chart {
        title: "Rotation of the row above".into(),
        x: Axis::new("rigid blocks on a mesh, mrad per mm pulled"),
        y: Axis::new("mrad per mm"),
        series: vec![
            Series::points("engine 1e6", pairs(all, 0, 4)),
            Series::points("engine 1e7 f64", pairs(all, 1, 4)),
            Series::points("friction at corners", pairs(all, 3, 4)),
        ],
        diagonal: true,
        ..Chart::default()
    }
}
