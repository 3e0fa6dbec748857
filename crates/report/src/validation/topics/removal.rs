//! Every legal single removal.

use serde_json::json;
use teeter_scene::Scene;
use teeter_study::{Removal, par_map, removable_blocks, remove};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{largest, quantile};
use super::built;
use crate::error::Error;
use crate::progress;

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "removal",
        "Every legal single removal",
        "Each tower is built without one block, for every block below the top row, and watched for 5 s; k = 1e6 N/m. A tower fell when a block came down by more than 3 mm, or went by more than 5 mm after 2 s. \
         Rigid blocks say exactly whether it stands. Creep is from 2 s to 5 s.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.options());
    let all: Vec<(&Scene, usize)> =
        scenes.iter().flat_map(|s| removable_blocks(s).into_iter().map(move |i| (s, i))).collect();
    let bar = progress(all.len() as u64, "removals");
    let removals = par_map(&all, |&(scene, block)| {
        let removal = remove(scene, block, params()).map_err(built);
        bar.inc(1);
        removal
    });
    bar.finish_and_clear();
    let removals: Vec<Removal> = removals.into_iter().collect::<Result<_, _>>()?;
    let (n, fell) = (removals.len(), removals.iter().filter(|r| r.fell).count());
    let agree = removals.iter().filter(|r| r.exact_fell == Some(r.fell)).count();
    let creeps: Vec<f64> = removals.iter().filter(|r| !r.fell).map(|r| r.creep_mm).collect();
    section.goal(
        "single removals: as rigid blocks say",
        format!("{agree} of {n}"),
        "99.5 %",
        agree as f64 >= 0.995 * n as f64,
    );
    section.say("towers that fall", format!("{fell} of {n}; jenga_sim_vision has none of 204 with PyBullet"));
    section.goal(
        "creep after a removal",
        format!("{:.1e} mm at most, median {:.1e}", largest(&creeps), quantile(&creeps, 0.5)),
        "1e-3 mm",
        largest(&creeps) < 1e-3,
    );
    section.say(
        "furthest lean of a tower that stands",
        format!("{:.1} mm", largest(&removals.iter().filter(|r| !r.fell).map(|r| r.lean_mm).collect::<Vec<_>>())),
    );
    let rows = removals.iter().zip(&all).filter(|(r, _)| r.fell || r.exact_fell != Some(r.fell) || r.creep_mm > 1e-4);
    let rows = rows.map(|(r, (s, _))| {
        vec![
            s.name.clone(),
            r.id.to_string(),
            r.fell.to_string(),
            format!("{:?}", r.exact_fell),
            format!("{:.1e}", r.creep_mm),
        ]
    });
    section.table(&["tower", "block", "falls", "rigid blocks", "creep mm"], rows.take(100).collect());
    let mut sorted = creeps.clone();
    sorted.sort_by(f64::total_cmp);
    let points = sorted.iter().enumerate().map(|(i, c)| (*c, 100.0 * (i + 1) as f64 / sorted.len() as f64)).collect();
    section.plots.push(Plot {
        title: "Creep after a removal".into(),
        x: Axis::log("creep from 2 s to 5 s, mm"),
        y: Axis::new("removals with less, %"),
        series: vec![Series { name: String::new(), points, line: true }],
        diagonal: false,
    });
    section.data = json!({"removals": removals});
    Ok(section)
}
