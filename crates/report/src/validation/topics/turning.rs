//! How a tower turns above a tight block that is pulled beside its middle.

use serde_json::json;
use teeter_physics::{BodyId, Params, Precision};
use teeter_scene::Scene;
use teeter_study::{Drag, RigidTower, Spread, drag_rotation, long_axis, mechanism, par_map, settled};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{correlation, mean, percent};
use super::built;
use crate::error::Error;
use crate::progress;

/// How far a block is pulled, m, and how fast, m/s.
const WAY: f64 = 2e-3;
const SPEED: f64 = 5e-3;
/// What of the force that slides it straight a block must start below to count as one whose tower turns.
const TURNS: f64 = 0.9;

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "turning",
        "How a tower turns above a tight block",
        "A tight block beside the middle is drawn 2 mm at 5 mm/s by a hand that leaves it free to turn; what counts is by how much the row above has turned for each millimetre. \
         Beside it what rigid blocks do: of all motions with the normal forces of rest the one for which friction takes the least power, with friction on the engine's lever, \
         at the corners of each patch, and on a mesh of 12 x 12 points under a pressure that varies evenly (which has the torsion of theory by itself). \
         The engine in single precision at 1e6 N/m and in double at 1e7.",
    );
    let scenes = size.towers(size.share(5), 1e6, &size.options());
    let mut rows = Vec::new();
    let mut all: Vec<[f64; 5]> = Vec::new();
    let mut forces: Vec<[f64; 3]> = Vec::new();
    for scene in &scenes {
        let rigid = RigidTower::new(scene).map_err(built)?;
        let blocks: Vec<usize> = (0..scene.blocks.len() - 6).collect();
        let turning = par_map(&blocks, |&i| {
            let answer = rigid.breakaway(i).ok()?;
            (answer.turning_n < TURNS * answer.straight_n && !answer.rocks()).then_some(i)
        });
        let turning: Vec<usize> = turning.into_iter().flatten().take(if size.quick { 2 } else { usize::MAX }).collect();
        let stiff = Scene { stiffness: if size.quick { 1e6 } else { 1e7 }, ..scene.clone() };
        let usual = settled(scene, params()).map_err(built)?;
        let fine = settled(&stiff, Params { precision: Precision::Double, ..params() }).map_err(built)?;
        let bar = progress(turning.len() as u64, "blocks");
        let seen = par_map(&turning, |&i| {
            let axis = long_axis(&scene.blocks[i]).extend(0.0);
            let above: Vec<BodyId> = (3 * (i / 3 + 1) as u32..).take(3).map(BodyId).collect();
            let drag = Drag { axis, distance: WAY, speed: SPEED };
            let engine = [&usual, &fine].map(|world| drag_rotation(world, BodyId(i as u32), &above, &drag));
            let theory = [Spread::ScaledCorners, Spread::Corners, Spread::Mesh(if size.quick { 4 } else { 12 })]
                .map(|spread| mechanism(&rigid, i, spread));
            bar.inc(1);
            let [a, b, c] = theory;
            Some((i, engine, [a?, b?, c?]))
        });
        bar.finish_and_clear();
        for (i, engine, theory) in seen.into_iter().flatten() {
            let row = 3 * (i / 3 + 1);
            let spins = theory.each_ref().map(|m| (row..row + 3).map(|j| m.velocities[j].z).sum::<f64>() / 3.0);
            let [lever, corners, mesh] = spins;
            all.push([engine[0], engine[1], lever, corners, mesh]);
            forces.push(theory.each_ref().map(|m| m.force_n));
            let cells = [engine[0], engine[1], lever, corners, mesh].map(|v| format!("{v:+.1}"));
            rows.push([vec![format!("{} {i}", scene.name)], cells.to_vec()].concat());
        }
    }
    let pairs = |i: usize, j: usize| all.iter().map(|r| (r[j], r[i])).collect::<Vec<_>>();
    let off = |i: usize, j: usize| mean(&all.iter().map(|r| (r[i] - r[j]).abs()).collect::<Vec<_>>());
    let size_of = mean(&all.iter().map(|r| r[4].abs()).collect::<Vec<_>>());
    section.say(
        "blocks, and how much the row above turns on average on a mesh",
        format!("{}, {size_of:.1} mrad/mm", all.len()),
    );
    section.say(
        "engine at 1e6 against mesh: correlation, mean difference",
        format!("{:.3}, {:.1} mrad/mm", correlation(&pairs(0, 4)), off(0, 4)),
    );
    section.say(
        "engine at 1e7 in double against mesh",
        format!("{:.3}, {:.1} mrad/mm", correlation(&pairs(1, 4)), off(1, 4)),
    );
    section.say(
        "engine at 1e6 against that at 1e7",
        format!("{:.3}, {:.1} mrad/mm", correlation(&pairs(0, 1)), off(0, 1)),
    );
    section.say(
        "lever of the patch at four corners against mesh",
        format!("{:.3}, {:.1} mrad/mm", correlation(&pairs(2, 4)), off(2, 4)),
    );
    section.say(
        "friction at the corners themselves against mesh",
        format!("{:.3}, {:.1} mrad/mm", correlation(&pairs(3, 4)), off(3, 4)),
    );
    let force = |i: usize| 100.0 * mean(&forces.iter().map(|f| (f[i] / f[2] - 1.0).abs()).collect::<Vec<_>>());
    section.say("force against mesh: lever, corners", format!("{:.1} %, {:.1} % off", force(0), force(1)));
    let same = percent(&all, |r| r[0] * r[4] > 0.0 || r[4].abs() < 3.0);
    section.goal("the row above turns the way that rigid blocks say", format!("{same:.0} %"), "95 %", same >= 95.0);
    section.table(&["block", "engine 1e6", "engine 1e7 f64", "lever", "corners", "mesh"], rows);
    section.plots.push(Plot {
        title: "Turn of the row above".into(),
        x: Axis::new("rigid blocks on a mesh, mrad per mm pulled"),
        y: Axis::new("mrad per mm"),
        series: vec![
            Series { name: "engine 1e6".into(), points: pairs(0, 4), line: false },
            Series { name: "engine 1e7 f64".into(), points: pairs(1, 4), line: false },
            Series { name: "friction at corners".into(), points: pairs(3, 4), line: false },
        ],
        diagonal: true,
    });
    section.data = json!({"mrad_per_mm": all, "force_n": forces});
    Ok(section)
}
