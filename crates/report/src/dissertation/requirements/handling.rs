//! Requirements about moves: blocks are removed, placed and moved by the hand.

use glam::DVec3;

use super::subject::{Answer, Subject};
use crate::dissertation::backend::Grasp;
use crate::dissertation::length::mm;
use crate::dissertation::moves::unlike_real;
use crate::dissertation::tower::Tower;
use crate::error::Error;

/// 1.1: the first move takes a block out.
pub fn removes(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves.outcomes[0];
    let evidence = format!("3-3 is out, {} mm from the hand", mm(outcome.error));
    Ok(Answer::new(outcome.stands && outcome.error < 0.02, evidence))
}

/// 1.2: the second move lays it on top.
pub fn lays_on_top(subject: &Subject) -> Result<Answer, Error> {
    let Some(outcome) = subject.moves.outcomes.get(1) else {
        return Ok(Answer::new(false, "the tower fell before".into()));
    };
    let evidence = format!("{} mm from its target", mm(outcome.error));
    Ok(Answer::new(outcome.stands && outcome.error < 3e-3, evidence))
}

/// 1.3: a hand that moves twice as far moves a carried block twice as far.
pub fn analogue(subject: &Subject) -> Result<Answer, Error> {
    let carried = |displacement: f64| {
        let mut tower = subject.build_named("block")?;
        tower.rest(30);
        let lifted = tower.centre(0) + 0.1 * DVec3::Z;
        let hold = |tower: &mut Tower, target| {
            (0..60).for_each(|_| tower.step(Some(&Grasp { block: 0, target, carried: true })));
        };
        hold(&mut tower, lifted);
        let start = tower.centre(0);
        hold(&mut tower, lifted + displacement * DVec3::X);
        Ok::<f64, Error>((tower.centre(0) - start).x)
    };
    let (one, two) = (carried(0.01)?, carried(0.02)?);
    let evidence = format!("{} mm for 10, {} mm for 20", mm(one), mm(two));
    Ok(Answer::new((two / one - 2.0).abs() < 0.05 && one > 5e-3, evidence))
}

/// 2.5: after each of the six moves that take a block out the tower is as the real one was.
pub fn removal_disturbs(subject: &Subject) -> Result<Answer, Error> {
    Ok(as_expected(subject, true))
}

/// 2.6: after each of the six moves that place a block the tower is as the real one was.
pub fn placing_disturbs(subject: &Subject) -> Result<Answer, Error> {
    Ok(as_expected(subject, false))
}

fn as_expected(subject: &Subject, take: bool) -> Answer {
    let (unlike, max) = unlike_real(subject.moves, take);
    let max = mm(max);
    if unlike.is_empty() {
        return Answer::new(true, format!("in 6 of 6 moves like the real tower, {max} mm at most"));
    }
    let fell = subject.moves.outcomes.iter().position(|outcome| !outcome.stands);
    let cause = |n: &usize| match fell {
        Some(last) if *n == last + 1 => format!("{n} (falls)"),
        Some(last) if *n > last + 1 => format!("{n} (fallen before)"),
        _ => format!("{n} ({} mm)", mm(subject.moves.outcomes[n - 1].max_displacement)),
    };
    let list = unlike.iter().map(cause).collect::<Vec<_>>().join(", ");
    Answer::new(false, format!("unlike the real tower in moves {list}; {max} mm at most in the others"))
}

/// 3.3: whether a program is simple and intuitive is for its users to say.
pub fn simple(_: &Subject) -> Result<Answer, Error> {
    Ok(Answer::not_judged("no program can say whether another is intuitive"))
}

/// 1.4: the simulators have no camera.
pub fn all_sides(_: &Subject) -> Result<Answer, Error> {
    Ok(Answer::not_judged("the camera is that of the page, whose own tests turn it around a tower"))
}
