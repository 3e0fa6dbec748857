//! The penalty method (section 2.4.2): bodies may be inside each other, and a force in proportion to the depth pushes them apart.

use super::rigid::{Report, Rigid2D};

/// One step of Euler's method. Friction is dynamic and never more than what stops the point within the step.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    let touches = world.touches(0.0);
    // All forces follow from the state at the start of the step.
    let mut impulses = Vec::with_capacity(touches.len());
    for touch in &touches {
        let n = touch.point.normal;
        let t = n.perp();
        let depth = touch.point.depth.max(0.0);
        let push = (c.stiffness * depth - c.damping * touch.approach(&world.bodies)).max(0.0); // Eq. 2.12
        let place = touch.point.place;
        let sliding = (world.bodies[touch.a].velocity_at(place) - world.bodies[touch.b].velocity_at(place)).dot(t);
        let stopping = sliding.abs() / (touch.inverse_mass(&world.bodies, t) * c.step);
        let drag = -sliding.signum() * (c.friction * push).min(0.5 * stopping); // Eq. 2.18
        impulses.push((push * n + drag * t) * c.step);
    }
    for (touch, impulse) in touches.iter().zip(impulses) {
        touch.push(&mut world.bodies, impulse);
    }
    world.fall(c.step);
    Report::default()
}
