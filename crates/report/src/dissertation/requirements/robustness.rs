//! Requirements about the program: robustness and speed.

use glam::DVec3;

use super::subject::{Answer, ROWS, Subject};
use crate::dissertation::backend::Grasp;
use crate::dissertation::tower::FRAME_RATE;
use crate::error::Error;

/// Height of the tower that has to run in real time, rows.
const AIM: u32 = ROWS[ROWS.len() - 1];
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

/// 3.2: real time with the aim of 18 rows, by the frame rates that this machine showed.
///
/// A frame is a sixtieth of a second of simulated time, so simulated time keeps up with the clock
/// from 60 frames a second upwards. The dissertation's minimum of 12 pictures a second is then met
/// too. The operations of the most expensive frame while the tower settles are beside it.
pub fn real_time(subject: &Subject) -> Result<Answer, Error> {
    let mut tower = subject.build_rows(AIM)?;
    let operations = (0..30).fold(0.0, |max: f64, _| {
        tower.step(None);
        max.max(tower.operations())
    });
    Ok(judge(subject.rates, operations))
}

/// Answer for frame rates of towers of [`ROWS`] rows (frames per second), and the operations of the
/// most expensive frame of the last.
fn judge(rates: &[f64], operations: f64) -> Answer {
    let each: Vec<String> = ROWS.iter().zip(rates).map(|(rows, rate)| format!("{rows} rows {rate:.0}")).collect();
    let aim = rates.last().copied().unwrap_or_default();
    let speed = if aim < FRAME_RATE {
        format!(", so {AIM} rows at {:.2} of real time", aim / FRAME_RATE)
    } else {
        String::new()
    };
    let millions = 1e-6 * operations;
    let evidence = format!(
        "frames a second on this machine: {}{speed}; {millions:.0} million operations in the most expensive frame",
        each.join(", ")
    );
    Answer::new(aim >= FRAME_RATE, evidence)
}

#[cfg(test)]
mod tests {
    use super::super::subject::Judgement;
    use super::*;

    /// 22 frames of a sixtieth of a second are slow motion, whatever their count of operations.
    #[test]
    fn slow_motion_is_no_real_time() {
        let slow = judge(&[100.0, 61.0, 22.2], 1e6);
        assert_eq!(slow.judgement, Judgement::NotMet);
        let expected =
            "frames a second on this machine: 6 rows 100, 9 rows 61, 18 rows 22, so 18 rows at 0.37 of real time";
        assert!(slow.evidence.starts_with(expected), "{}", slow.evidence);
        let fast = judge(&[900.0, 500.0, 60.0], 1e12);
        assert_eq!(fast.judgement, Judgement::Met);
        assert!(fast.evidence.contains("18 rows 60; 1000000 million"), "{}", fast.evidence);
    }
}
