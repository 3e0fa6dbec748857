//! Requirements about the program: robustness and speed.

use glam::DVec3;

use super::subject::{Answer, Subject};
use crate::dissertation::backend::Grasp;
use crate::dissertation::cost;
use crate::error::Error;

/// Minimum frame rate, frames per second.
const MIN_FRAME_RATE: f64 = 12.0;
/// Distance from the origin beyond which a block is lost, m.
const MAX_DISTANCE: f64 = 10.0;

/// 3.1: blocks stay finite and above the floor when a hand pulls one to and fro through a tower.
pub fn no_crash(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_rows(6)?;
    tower.rest(15);
    for frame in 0..180 {
        let side = if frame / 20 % 2 == 0 { 0.3 } else { -0.3 };
        let target = DVec3::new(side, 0.5 * side, 0.1);
        tower.step(Some(&Grasp { block: 7, target, carried: false }));
    }
    tower.rest(60);
    let is_valid = |c: &DVec3| c.is_finite() && c.length() < MAX_DISTANCE && c.z > 0.0;
    let lost = tower.centres().iter().filter(|centre| !is_valid(centre)).count();
    Ok(Answer::new(lost == 0, format!("{lost} blocks lost when a hand shakes a tower for 3 s")))
}

/// 3.2: frame rate by the operations of the most expensive frame while a tower settles. Figure 6.23
/// is by a clock.
pub fn real_time(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_rows(18)?;
    let operations = (0..30).fold(0.0, |max: f64, _| {
        tower.step(None);
        max.max(tower.operations())
    });
    let (rate, millions) = (cost::CORE / operations, 1e-6 * operations);
    let evidence = format!(
        "18 rows take {millions:.0} million operations a frame at most: {rate:.0} frames a second \
         of a core that does one a cycle at 2 GHz"
    );
    Ok(Answer::new(rate >= MIN_FRAME_RATE, evidence))
}
