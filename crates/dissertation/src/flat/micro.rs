//! Impulses for everything, after Mirtich (section 2.4.2): a body at rest is one that collides very often and very gently.

use super::rigid::{Report, Rigid2D, collide};

/// How near bodies count as touching, m.
const ENVELOPE: f64 = 2e-5;

/// One step: it moves, and every contact that still approaches takes an impulse. One slower than the limit is a micro-collision, which turns
/// the whole velocity round, so that it carries what rests on it.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    for body in world.bodies.iter_mut().filter(|b| b.inverse_mass > 0.0) {
        body.velocity.y -= c.gravity * c.step;
    }
    let touches = world.touches(ENVELOPE);
    let mut report = Report::default();
    // A blow at one point makes others approach: rounds, as long as any does.
    loop {
        let mut found = false;
        for touch in &touches {
            let approach = touch.approach(&world.bodies);
            if approach < -1e-6 {
                found = true;
                report.iterations += 1;
                let micro = approach > -c.rest_velocity;
                // Outside the envelope's inner half nothing has to be pushed further out.
                let restitution =
                    if micro { if touch.point.depth > -0.5 * ENVELOPE { 1.0 } else { 0.0 } } else { c.restitution };
                collide(&mut world.bodies, touch, restitution, c.friction);
            }
        }
        if !found {
            break;
        }
        if report.iterations >= c.max_iterations {
            report.capped = true;
            break;
        }
    }
    for body in world.bodies.iter_mut().filter(|b| b.inverse_mass > 0.0) {
        *body = body.moved(c.step);
    }
    report
}
