//! Penalty method (section 2.4.2): a force proportional to the penetration separates the bodies.

use super::rigid::{Report, Rigid2D};

/// Advances by one step of Euler's method. Kinetic friction is limited to half of the force that
/// stops the point within the step.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    let contacts = world.contacts(0.0);
    // All forces are functions of the state at the start of the step.
    let mut impulses = Vec::with_capacity(contacts.len());
    for contact in &contacts {
        let n = contact.point.normal;
        let t = n.perp();
        let depth = contact.point.depth.max(0.0);
        let normal_force = (c.stiffness * depth - c.damping * contact.approach_velocity(&world.bodies)).max(0.0); // Eq. 2.12
        let position = contact.point.position;
        let sliding =
            (world.bodies[contact.a].velocity_at(position) - world.bodies[contact.b].velocity_at(position)).dot(t);
        let stopping = sliding.abs() / (contact.inverse_mass(&world.bodies, t) * c.step);
        let drag = -sliding.signum() * (c.friction * normal_force).min(0.5 * stopping); // Eq. 2.18
        impulses.push((normal_force * n + drag * t) * c.step);
    }
    for (contact, impulse) in contacts.iter().zip(impulses) {
        contact.apply_impulse(&mut world.bodies, impulse);
    }
    world.integrate(c.step);
    Report::default()
}
