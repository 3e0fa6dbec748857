//! Requirements about moves: blocks are removed, placed and moved by the hand.

use glam::DVec3;

use super::subject::{Answer, Subject};
use crate::dissertation::backend::Grasp;
use crate::dissertation::length::mm;
use crate::dissertation::tower::Tower;
use crate::error::Error;

/// Maximum displacement of the tower by a move, m.
const MAX_DISPLACEMENT: f64 = 1e-3;

/// 1.1: the first move takes a block out.
pub fn removes(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[0];
    let evidence = format!("3-3 is out, {} mm from the hand", mm(outcome.error));
    Ok(Answer::new(outcome.stands && outcome.error < 0.02, evidence))
}

/// 1.2: the second move lays it on top.
pub fn lays_on_top(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[1];
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

/// 2.5: removing a loose block moves the others little.
pub fn removal_disturbs(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[0];
    let evidence = format!("taking loose 3-3 moves the others by {} mm at most", mm(outcome.max_displacement));
    Ok(Answer::new(outcome.stands && outcome.max_displacement < MAX_DISPLACEMENT, evidence))
}

/// 2.6: laying a block on top moves the others little.
pub fn placing_disturbs(subject: &Subject) -> Result<Answer, Error> {
    let outcome = subject.moves[1];
    let evidence = format!("laying a block on top moves the others by {} mm at most", mm(outcome.max_displacement));
    Ok(Answer::new(outcome.stands && outcome.max_displacement < MAX_DISPLACEMENT, evidence))
}

/// 3.3: a move needs a block and a target of the hand in each frame, which a mouse provides.
pub fn simple(subject: &Subject) -> Result<Answer, Error> {
    let evidence = "a move is made with one pointer and one modifier; whether it is intuitive no program can measure";
    Ok(Answer::new(subject.moves[..2].iter().all(|outcome| outcome.stands), evidence.into()))
}
