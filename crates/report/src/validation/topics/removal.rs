//! Legal single removals.

use serde_json::json;
use teeter_scene::Scene;
use teeter_study::{Removal, par_map, removable_blocks, remove};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Creep from which on a removal is listed, mm.
const LISTED_CREEP: f64 = 1e-4;
/// Maximum number of removals listed.
const MAX_LISTED: usize = 100;

/// Builds each tower without one block, for every block that may be removed.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "removal",
        "Every legal single removal",
        "Each tower is built without one block, for every block below the top row, and simulated \
         for 5 s; k = 1e6 N/m. A tower fell when a block dropped from its bearers by a sixth of \
         its height or tipped. Rigid blocks say exactly whether it stands. Creep is from 2 s to 5 \
         s.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.tower_options());
    let all: Vec<(&Scene, usize)> =
        scenes.iter().flat_map(|s| removable_blocks(s).into_iter().map(move |i| (s, i))).collect();
    let bar = progress(all.len() as u64, "removals");
    let removals = par_map(&all, |&(scene, block)| {
        let removal = remove(scene, block, params());
        bar.inc(1);
        removal
    });
    bar.finish_and_clear();
    let removals: Vec<Removal> = removals.into_iter().collect::<Result<_, _>>()?;
    figures(&mut section, &removals);
    let listed = removals
        .iter()
        .zip(&all)
        .filter(|(r, _)| r.fell || r.exact_fell != Some(r.fell) || r.creep_mm > LISTED_CREEP)
        .take(MAX_LISTED);
    let row = |(removal, (scene, _)): (&Removal, &(&Scene, usize))| {
        vec![
            scene.name.clone(),
            removal.id.to_string(),
            removal.fell.to_string(),
            removal.exact_fell.map_or("unknown".into(), |fell| fell.to_string()),
            format!("{:.1e}", removal.creep_mm),
        ]
    };
    section.table(&["tower", "block", "falls", "rigid blocks", "creep mm"], listed.map(row).collect());
    section.data = json!({"removals": removals});
    Ok(section)
}

fn figures(section: &mut Section, removals: &[Removal]) {
    let standing = || removals.iter().filter(|removal| !removal.fell);
    let (count, fell) = (removals.len(), removals.len() - standing().count());
    let agree = removals.iter().filter(|r| r.exact_fell == Some(r.fell)).count();
    let mut creeps: Vec<f64> = standing().map(|removal| removal.creep_mm).collect();
    let leans: Vec<f64> = standing().map(|removal| removal.lean_mm).collect();
    let met = agree as f64 >= 0.995 * count as f64;
    section.goal("single removals: as rigid blocks say", format!("{agree} of {count}"), "99.5 %", met);
    section.number("removals", count as f64);
    section.number("as_rigid", agree as f64);
    section.number("fell", fell as f64);
    section.number("creep_mm", max(&creeps));
    section.inform("towers that fall", format!("{fell} of {count}; jenga_sim_vision has none of 204 with PyBullet"));
    section.goal(
        "creep after a removal",
        format!("{:.1e} mm at most, median {:.1e}", max(&creeps), quantile(&creeps, 0.5)),
        "1e-3 mm",
        max(&creeps) < 1e-3,
    );
    section.inform("largest lean of a tower that stands", format!("{:.1} mm", max(&leans)));
    creeps.sort_by(f64::total_cmp);
    let share = |i: usize| 100.0 * (i + 1) as f64 / creeps.len() as f64;
    let points = creeps.iter().enumerate().map(|(i, creep)| (*creep, share(i))).collect();
    section.charts.push(Chart {
        title: "Creep after a removal".into(),
        x: Axis::log("creep from 2 s to 5 s, mm"),
        y: Axis::new("removals with less, %"),
        series: vec![Series::line("", points)],
        ..Chart::default()
    });
}
