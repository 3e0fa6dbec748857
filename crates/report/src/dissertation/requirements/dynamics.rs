//! Requirements about gravity and friction.

use glam::DVec3;

use super::subject::{Answer, Subject};
use crate::dissertation::backend::Grasp;
use crate::dissertation::column::kinetic_friction;
use crate::dissertation::length::mm;
use crate::dissertation::tower::FRAME_RATE;
use crate::error::Error;

/// 2.1: acceleration of a block that the hand has let go.
pub fn gravity(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_named("block")?;
    tower.rest(30);
    let target = tower.centre(0) + 0.3 * DVec3::Z;
    for _ in 0..120 {
        tower.step(Some(&Grasp { block: 0, target, carried: true }));
    }
    // Second difference of the height over a tenth of a second.
    let span = 6;
    let heights = [(); 3].map(|()| {
        let height = tower.centre(0).z;
        tower.rest(span);
        height
    });
    let time = f64::from(span) / FRAME_RATE;
    let g = -(heights[0] - 2.0 * heights[1] + heights[2]) / (time * time);
    Ok(Answer::new((g / subject.constants.gravity - 1.0).abs() < 0.02, format!("a block falls with {g:.2} m/s²")))
}

/// 2.2: a sliding block stops after v² / (2 µ g), and a tower at rest does not creep.
pub fn friction(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_named("block")?;
    tower.rest(60);
    let start = tower.centre(0).x;
    let speed = 0.4;
    let deceleration = kinetic_friction(subject.constants) * subject.constants.gravity;
    tower.set_velocity(0, speed * DVec3::X);
    tower.rest(60);
    let (slid, expected) = (tower.centre(0).x - start, speed * speed / (2.0 * deceleration));
    let mut six = subject.build_rows(6)?;
    six.rest(120);
    let before = six.centres();
    six.rest(120);
    let creep = six.centres().iter().zip(&before).map(|(now, start)| now.distance(*start)).fold(0.0, f64::max);
    let (slid_mm, expected_mm, creep_mm) = (mm(slid), mm(expected), mm(creep));
    let evidence = format!("slides {slid_mm} mm for {expected_mm}; six rows creep by {creep_mm} mm in 2 s");
    Ok(Answer::new((slid / expected - 1.0).abs() < 0.15 && creep < 5e-5, evidence))
}
