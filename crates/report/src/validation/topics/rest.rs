//! Simulated hours of rest without sleep.

use serde_json::json;
use teeter_study::{LongRest, long_rest, par_map, settled};

use crate::error::Error;
use crate::output::progress;
use crate::statistics::max;
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Measures creep and energies of towers at rest.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "rest",
        "Long rest",
        "Towers stand without sleep, k = 1e6 N/m, for the number of hours named, of all of them \
         together. Creep is the maximum displacement of any block from the settled tower, sampled \
         every minute; energies are those of the motion and of the heights of the centres.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.tower_options());
    let seconds = 3600.0 * size.hours / scenes.len() as f64;
    let bar = progress(scenes.len() as u64 * (seconds / 60.0) as u64, "minutes of rest");
    let rests = par_map(&scenes, |scene| {
        settled(scene, params()).map(|world| long_rest(world, seconds, scene.gravity, || bar.inc(1)))
    });
    bar.finish_and_clear();
    let rests = rests.into_iter().collect::<Result<Vec<_>, _>>()?;
    let max_of = |of: fn(&LongRest) -> f64| max(&rests.iter().map(of).collect::<Vec<_>>());
    let (creep, kinetic, potential) = (max_of(|r| r.creep_m), max_of(|r| r.kinetic_j), max_of(|r| r.potential_j));
    let what = format!("rest, {:.2} simulated hours of {} towers", size.hours, rests.len());
    section.goal(format!("{what}: creep"), format!("{creep:.1e} m"), "1e-6 m", creep < 1e-6);
    // Of the energy of a whole tower that is 1e-8 J a nanometre of height.
    section.goal(
        format!("{what}: change of potential energy"),
        format!("{potential:.1e} J"),
        "1e-8 J, a nanometre",
        potential < 1e-8,
    );
    section.number("creep_m", creep);
    section.number("potential_J", potential);
    section.number("kinetic_J", kinetic);
    section.inform("largest kinetic energy of any sample", format!("{kinetic:.1e} J"));
    section.data = json!({"rests": rests});
    Ok(section)
}
