//! Simulated hours of rest with nothing asleep.

use serde_json::json;
use teeter_study::{LongRest, long_rest, par_map, settled};

use super::super::section::{Section, Size, params};
use super::super::stats::largest;
use super::built;
use crate::error::Error;
use crate::progress;

/// Measures it.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "rest",
        "Long rest",
        "Towers stand with sleep off, k = 1e6 N/m; all of them together for so many hours. Creep is how far any block is from where it was when the tower had settled, looked at \
         every minute; energy is that of the motion of the centres, and of their heights.",
    );
    let scenes = size.towers(size.towers, 1e6, &size.options());
    let each_s = 3600.0 * size.hours / scenes.len() as f64;
    let bar = progress(scenes.len() as u64 * (each_s / 60.0) as u64, "minutes of rest");
    let rests = par_map(&scenes, |scene| {
        settled(scene, params()).map(|w| long_rest(w, each_s, scene.gravity, || bar.inc(1))).map_err(built)
    });
    bar.finish_and_clear();
    let rests = rests.into_iter().collect::<Result<Vec<_>, _>>()?;
    let of = |f: fn(&LongRest) -> f64| largest(&rests.iter().map(f).collect::<Vec<_>>());
    let (creep, kinetic, potential) = (of(|r| r.creep_m), of(|r| r.kinetic_j), of(|r| r.potential_j));
    let what = format!("rest, {:.2} simulated hours of {} towers", size.hours, rests.len());
    section.goal(format!("{what}: creep"), format!("{creep:.1e} m"), "1e-6 m", creep < 1e-6);
    // the heights of a whole tower may change by less than a nanometre
    section.goal(
        format!("{what}: change of potential energy"),
        format!("{potential:.1e} J"),
        "1e-8 J, a nanometre",
        potential < 1e-8,
    );
    section.say("largest kinetic energy at any look", format!("{kinetic:.1e} J"));
    section.data = json!({"rests": rests});
    Ok(section)
}
