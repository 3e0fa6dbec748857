//! Micro-collisions, after Mirtich (section 2.4.2): a body at rest collides very often and very
//! gently.

use super::rigid::{Report, Rigid2D};

/// Maximum separation of bodies in contact, m.
const ENVELOPE: f64 = 2e-5;

/// Advances by one step: applies impulses at every approaching contact, then moves the bodies.
///
/// A contact slower than the limit is a micro-collision, which reverses the whole velocity and so
/// carries the weight of resting bodies.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    for body in world.bodies.iter_mut().filter(|b| b.inverse_mass > 0.0) {
        body.velocity.y -= c.gravity * c.step;
    }
    let contacts = world.contacts(ENVELOPE);
    let mut report = Report::default();
    // An impulse at one point makes others approach, so repeat until none does.
    loop {
        let mut found = false;
        for contact in &contacts {
            let approach = contact.approach_velocity(&world.bodies);
            if approach < -1e-6 {
                found = true;
                report.iterations += 1;
                let micro = approach > -c.rest_velocity;
                // Outside of the inner half of the envelope no contact needs further separation.
                let restitution =
                    if micro { if contact.point.depth > -0.5 * ENVELOPE { 1.0 } else { 0.0 } } else { c.restitution };
                contact.collide(&mut world.bodies, restitution, c.friction);
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
        *body = body.advanced(c.step);
    }
    report
}
