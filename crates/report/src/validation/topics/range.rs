//! Block presets, friction and stiffness over the range in which a player may set them.

use serde_json::json;
use teeter_physics::{BodyId, World};
use teeter_scene::{BlockPreset, Scene, TowerOptions};
use teeter_study::{RigidTower, breakaway_force, extract, long_axis, par_map, settled, xray};

use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, mean, min, percent};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Loose blocks that are pulled and taken out of each tower.
const PULLED: usize = 3;
/// Speed at which blocks are taken out, m/s.
const SPEED: f64 = 0.05;
/// Maximum drop of a block of a tower that stands, m.
const MAX_DROP: f64 = 3e-3;
/// Maximum displacement of the other blocks, mm.
const MAX_DISPLACEMENT: f64 = 0.2;
/// Force on the upper face below which a rigid block is loose, N.
const NO_LOAD: f64 = 1e-3;

/// Setting of a tower.
#[derive(Clone, Copy)]
struct Setting {
    block: BlockPreset,
    friction: f64,
    stiffness: f64,
}

/// Measurements of a tower.
struct Tower {
    stands: bool,
    /// Blocks for which X-ray and rigid blocks agree whether they are loose; none where limit
    /// analysis has no solution.
    agree: Option<usize>,
    /// Blocks below the top row.
    blocks: usize,
    /// Relative errors of the breakaway forces of loose blocks against friction times their weight.
    errors: Vec<f64>,
    out: Vec<bool>,
    others_mm: Vec<f64>,
    penetration_mm: f64,
}

impl Tower {
    fn measure(scene: &Scene) -> Result<Self, Error> {
        let world = settled(scene, params())?;
        let loads = xray(&world, scene.friction);
        let blocks = scene.blocks.len() - 3;
        let loose: Vec<usize> = (0..blocks).filter(|&i| loads[i].is_loose()).collect();
        let agree = RigidTower::new(scene)
            .ok()
            .map(|rigid| (0..blocks).filter(|&i| loads[i].is_loose() == (rigid.force_above(i) < NO_LOAD)).count());
        let drop = scene.blocks.iter().zip(world.bodies()).map(|(b, body)| b.pos[2] - world.pose(body).position.z);
        let stands = drop.fold(0.0, f64::max) < MAX_DROP;
        let penetration_mm = 1e3 * world.penetration();
        let (errors, out, others_mm) = (Vec::new(), Vec::new(), Vec::new());
        let mut tower = Self { stands, agree, blocks, errors, out, others_mm, penetration_mm };
        for &i in loose.iter().step_by((loose.len() / PULLED).max(1)).take(PULLED) {
            tower.pull(scene, &world, i);
        }
        Ok(tower)
    }

    /// Pulls a loose block in both directions and takes it out.
    fn pull(&mut self, scene: &Scene, world: &World, i: usize) {
        let (block, body) = (&scene.blocks[i], BodyId(i as u32));
        let axis = long_axis(block).extend(0.0);
        let [forward, backward] = [axis, -axis].map(|axis| breakaway_force(world, body, axis).unwrap_or(f64::INFINITY));
        let expected = scene.friction * block.mass * scene.gravity;
        self.errors.push((0.5 * (forward + backward) / expected - 1.0).abs());
        let taken = extract(world, body, axis, SPEED);
        self.out.push(taken.out);
        self.others_mm.push(taken.others_mm);
    }
}

/// Summary of the towers of a setting.
struct Summary {
    /// Share of towers that stand, %.
    stand: f64,
    /// Share of loose blocks that come out, %.
    out: f64,
    /// Maximum displacement of other blocks, mm.
    others_mm: f64,
    row: Vec<String>,
}

impl Summary {
    fn new(setting: Setting, towers: &[Tower]) -> Self {
        let flat = |of: fn(&Tower) -> &[f64]| towers.iter().flat_map(of).copied().collect::<Vec<f64>>();
        let out: Vec<bool> = towers.iter().flat_map(|tower| &tower.out).copied().collect();
        let solved = towers.iter().filter_map(|tower| Some((tower.agree?, tower.blocks)));
        let (agree, blocks) = solved.fold((0, 0), |sum, tower| (sum.0 + tower.0, sum.1 + tower.1));
        let penetration: Vec<f64> = towers.iter().map(|tower| 1e3 * tower.penetration_mm).collect();
        let (stand, others_mm) = (percent(towers, |tower| tower.stands), max(&flat(|tower| &tower.others_mm)));
        let share = percent(&out, |out| *out);
        let row = vec![
            setting.block.to_string(),
            setting.friction.to_string(),
            format!("{:.0e}", setting.stiffness),
            format!("{stand:.0} %"),
            format!("{:.1} %", 100.0 * agree as f64 / blocks as f64),
            format!("{:.1} %", 100.0 * mean(&flat(|tower| &tower.errors))),
            format!("{share:.0} % of {}", out.len()),
            format!("{others_mm:.3}"),
            format!("{:.1}", max(&penetration)),
        ];
        Self { stand, out: share, others_mm, row }
    }
}

fn settings(quick: bool) -> Vec<Setting> {
    let (frictions, stiffnesses): (&[f64], &[f64]) =
        if quick { (&[0.25, 0.5], &[1e6]) } else { (&[0.25, 0.4, 0.5], &[3e5, 1e6, 3e6]) };
    let mut settings = Vec::new();
    for block in BlockPreset::ALL {
        for &friction in frictions {
            settings.extend(stiffnesses.iter().map(|&stiffness| Setting { block, friction, stiffness }));
        }
    }
    settings
}

/// Measures towers at every setting.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "range",
        "Block presets, friction and stiffness",
        "For each block preset, friction and stiffness towers settle. The X-ray is compared with \
         rigid blocks; three loose blocks of each tower are pulled until they slide (friction \
         times their weight is exact, the lean of the tower adds its slope) and taken out by the \
         hand at 5 cm/s.",
    );
    let (settings, count) = (settings(size.quick), size.share(4));
    let bar = progress(settings.len() as u64 * count, "towers");
    let mut all = Vec::new();
    for setting in settings {
        let Setting { block, friction, stiffness } = setting;
        let scenes = size.towers(count, stiffness, &TowerOptions { block, friction, ..size.tower_options() });
        let towers = par_map(&scenes, |scene| {
            let tower = Tower::measure(scene);
            bar.inc(1);
            tower
        });
        let towers = towers.into_iter().collect::<Result<Vec<_>, Error>>()?;
        all.push(Summary::new(setting, &towers));
    }
    bar.finish_and_clear();
    let worst = |of: fn(&Summary) -> f64| min(&all.iter().map(of).collect::<Vec<_>>());
    let (stand, out) = (worst(|summary| summary.stand), worst(|summary| summary.out));
    let others = max(&all.iter().map(|summary| summary.others_mm).collect::<Vec<_>>());
    section.goal("towers stand at every setting", format!("{stand:.0} % at the worst"), "all", stand == 100.0);
    section.number("stand_percent", stand);
    section.number("out_percent", out);
    section.number("others_mm", others);
    let what = "loose blocks come out at 5 cm/s at every setting";
    section.goal(what, format!("{out:.0} % at the worst"), "99 %", out >= 99.0);
    let value = format!("{others:.3} mm at most");
    section.goal("others move at every setting", value, "0.2 mm", others <= MAX_DISPLACEMENT);
    let rows: Vec<Vec<String>> = all.into_iter().map(|summary| summary.row).collect();
    section.data = json!({"rows": rows});
    section.table(
        &[
            "block",
            "friction",
            "stiffness N/m",
            "stand",
            "X-ray as rigid blocks",
            "start off by",
            "out at 5 cm/s",
            "others mm",
            "overlap um",
        ],
        rows,
    );
    Ok(section)
}
