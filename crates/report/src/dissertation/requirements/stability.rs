//! Requirements about towers at rest.

use super::subject::{Answer, Subject};
use crate::dissertation::static_tests::outcome;
use crate::error::Error;

fn answer(subject: &Subject, scenes: &[&str], stable: bool) -> Result<Answer, Error> {
    let mut wrong = Vec::new();
    for scene in scenes {
        if outcome(subject.column, subject.constants, scene, |_| {})?.stands != stable {
            wrong.push(*scene);
        }
    }
    let right = scenes.len() - wrong.len();
    let except = if wrong.is_empty() { String::new() } else { format!(", not {}", wrong.join(", ")) };
    Ok(Answer::new(wrong.is_empty(), format!("{right} of {} towers{except}", scenes.len())))
}

/// 2.3: stable towers stand.
pub fn stays(subject: &Subject) -> Result<Answer, Error> {
    answer(subject, &["test-1", "test-5", "test-6", "test-2-out"], true)
}

/// 2.4: unstable towers fall.
pub fn collapses(subject: &Subject) -> Result<Answer, Error> {
    answer(subject, &["test-3", "test-4", "test-2-in"], false)
}

/// 2.9: displacement of corners from frame to frame in a tower at rest.
pub fn no_jitter(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_rows(6)?;
    tower.rest(180);
    let mut jitter = 0.0f64;
    for _ in 0..60 {
        let before: Vec<_> = (0..tower.len()).map(|block| tower.corners(block)).collect();
        tower.step(None);
        for (block, corners) in before.iter().enumerate() {
            let moved = tower.corners(block).into_iter().zip(corners).map(|(now, start)| now.distance(*start));
            jitter = moved.fold(jitter, f64::max);
        }
    }
    let evidence = format!("corners move by {} µm a frame at most", (1e7 * jitter).round() / 10.0);
    Ok(Answer::new(jitter < 1e-6, evidence))
}
