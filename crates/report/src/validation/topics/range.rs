//! Both makes of block, friction and stiffness: the same questions over the range in which a player may set them.

use serde_json::json;
use teeter_physics::BodyId;
use teeter_scene::{BlockPreset, TowerOptions};
use teeter_study::{RigidTower, breakaway_force, extract, long_axis, par_map, settled, xray};

use super::super::section::{Section, Size, params};
use super::super::stats::{largest, mean, percent};
use super::built;
use crate::error::Error;
use crate::progress;

/// One tower at one setting.
struct Seen {
    stands: bool,
    /// Loose in the X-ray and for rigid blocks, and blocks of which the two agree.
    agree: Option<usize>,
    blocks: usize,
    /// Force that starts a loose block over mu m g, off by.
    off: Vec<f64>,
    out: Vec<bool>,
    others_mm: Vec<f64>,
    penetration_mm: f64,
}

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "range",
        "Both makes of block, friction and stiffness",
        "For each make, friction and stiffness towers settle; the X-ray is held against rigid blocks, three loose blocks of each tower are pulled until they slide (mu times their weight is exact, \
         the lean of the tower adds its slope) and taken out by the hand at 5 cm/s.",
    );
    let (frictions, steps): (&[f64], &[f64]) =
        if size.quick { (&[0.25, 0.5], &[1e6]) } else { (&[0.25, 0.4, 0.5], &[3e5, 1e6, 3e6]) };
    let towers = size.share(4);
    let bar = progress((2 * frictions.len() * steps.len()) as u64 * towers, "towers");
    let mut rows = Vec::new();
    let mut all = Vec::new();
    for block in BlockPreset::ALL {
        for &friction in frictions {
            for &stiffness in steps {
                let scenes = size.towers(towers, stiffness, &TowerOptions { block, friction, ..size.options() });
                let seen = par_map(&scenes, |scene| {
                    let world = settled(scene, params()).map_err(built)?;
                    let (loads, rigid) = (xray(&world, friction), RigidTower::new(scene).ok());
                    let below_top = scene.blocks.len() - 3;
                    let loose: Vec<usize> = (0..below_top).filter(|&i| loads[i].is_loose()).collect();
                    // none where the programme is not solved
                    let agree = rigid.map(|rigid| {
                        (0..below_top).filter(|&i| loads[i].is_loose() == (rigid.force_above(i) < 1e-3)).count()
                    });
                    let step = (loose.len() / 3).max(1);
                    let (mut off, mut out, mut others_mm) = (Vec::new(), Vec::new(), Vec::new());
                    for &i in loose.iter().step_by(step).take(3) {
                        let axis = long_axis(&scene.blocks[i]).extend(0.0);
                        let both = [axis, -axis]
                            .map(|axis| breakaway_force(&world, BodyId(i as u32), axis).unwrap_or(f64::INFINITY));
                        off.push(
                            (0.5 * (both[0] + both[1]) / (friction * scene.blocks[i].mass * scene.gravity) - 1.0).abs(),
                        );
                        let taken = extract(&world, BodyId(i as u32), axis, 0.05);
                        out.push(taken.out);
                        others_mm.push(taken.others_mm);
                    }
                    bar.inc(1);
                    let top =
                        scene.blocks.iter().zip(world.bodies()).map(|(b, body)| b.pos[2] - world.pose(body).position.z);
                    let stands = top.fold(0.0, f64::max) < 3e-3;
                    Ok::<_, Error>(Seen {
                        stands,
                        agree,
                        blocks: below_top,
                        off,
                        out,
                        others_mm,
                        penetration_mm: 1e3 * world.penetration(),
                    })
                });
                let seen = seen.into_iter().collect::<Result<Vec<_>, _>>()?;
                let flat = |f: &dyn Fn(&Seen) -> Vec<f64>| seen.iter().flat_map(f).collect::<Vec<f64>>();
                let (off, others) = (flat(&|s| s.off.clone()), flat(&|s| s.others_mm.clone()));
                let out: Vec<bool> = seen.iter().flat_map(|s| s.out.clone()).collect();
                let answered: Vec<(usize, usize)> = seen.iter().filter_map(|s| Some((s.agree?, s.blocks))).collect();
                let agree = 100.0 * answered.iter().map(|a| a.0).sum::<usize>() as f64
                    / answered.iter().map(|a| a.1).sum::<usize>() as f64;
                rows.push(vec![
                    block.to_string(),
                    friction.to_string(),
                    format!("{stiffness:.0e}"),
                    format!("{:.0} %", percent(&seen, |s| s.stands)),
                    format!("{agree:.1} %"),
                    format!("{:.1} %", 100.0 * mean(&off)),
                    format!("{:.0} % of {}", percent(&out, |o| *o), out.len()),
                    format!("{:.3}", largest(&others)),
                    format!("{:.1}", largest(&flat(&|s| vec![1e3 * s.penetration_mm]))),
                ]);
                all.push((percent(&seen, |s| s.stands), percent(&out, |o| *o), stiffness, largest(&others)));
            }
        }
    }
    bar.finish_and_clear();
    section.goal(
        "towers stand at every setting",
        format!("{:.0} % at the worst", all.iter().map(|a| a.0).fold(100.0, f64::min)),
        "all",
        all.iter().all(|a| a.0 == 100.0),
    );
    let worst = all.iter().map(|a| a.1).fold(100.0, f64::min);
    section.goal(
        "loose blocks come out at 5 cm/s at every setting",
        format!("{worst:.0} % at the worst"),
        "99 %",
        worst >= 99.0,
    );
    let moved = all.iter().map(|a| a.3).fold(0.0, f64::max);
    section.goal("others move at every setting", format!("{moved:.3} mm at most"), "0.2 mm", moved <= 0.2);
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
        rows.clone(),
    );
    section.data = json!({"rows": rows});
    Ok(section)
}
